"""vitrail-server links no graphics, window or sound library."""
import subprocess

from harness import SERVER, expect, finish

needed = subprocess.run(["ldd", SERVER], capture_output=True, text=True, check=True).stdout
for word in ("libGL", "libEGL", "libSDL", "libepoxy", "libopenal", "libX11", "libimgui"):
    expect(word not in needed, f"vitrail-server needs {word}")
finish()
