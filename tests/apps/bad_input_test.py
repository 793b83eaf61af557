"""Bad input of every kind gives one clear line and status 2, and writes nothing."""
import os
import shutil
import signal
import subprocess
import time

from harness import FIXTURES, SCRATCH, SERVER, VITRAIL, expect, expect_error, expect_ok, finish, run

# Wrong words.
expect_error()
expect_error("fly")
expect_error("render", "--seed", "1")
expect_error("render", "--seed", "x", "-o", SCRATCH / "a.png")
expect_error("render", "--seed", "1", "--at", "1,2", "--look", "0,0", "-o", SCRATCH / "a.png", mention="--at")
expect_error("render", "--seed", "1", "--at", "1,2,nan", "--look", "0,0", "-o", SCRATCH / "a.png", mention="--at")
expect_error("render", "--seed", "1", "--at", "1,2,3", "--look", "0", "-o", SCRATCH / "a.png", mention="--look")
expect_error("render", "--seed", "1", "--size", "0x5", "--at", "0,80,0", "--look", "0,0", "-o", SCRATCH / "a.png", mention="--size")
expect_error("render", "--seed", "1", "--at", "0,80,0", "--look", "0,0", "--renderer", "magic", "-o", SCRATCH / "a.png", mention="renderer")
expect_error("render", "--seed", "1", "--at", "0,80,0", "--look", "0,0", "-o", SCRATCH / "nowhere/a.png", mention="nowhere")
expect_error("render", "--world", SCRATCH / "none", "--at", "0,80,0", "--look", "0,0", "-o", SCRATCH / "a.png")
expect(not (SCRATCH / "none").exists(), "render made a world folder")
broken_pack = SCRATCH / "pack.zip"
broken_pack.write_bytes(b"PK\x03\x04 this is no zip")
for pack in (SCRATCH / "no_pack.zip", broken_pack, SCRATCH):
    expect_error("render", "--seed", "1", "--at", "0,80,0", "--look", "0,0", "--pack", pack, "-o", SCRATCH / "a.png", mention=str(pack))
expect_error("generate", "--columns", "0,0,1", mention="--columns")
expect_error("generate", "--columns", "5,0,1,1", mention="--columns")
expect_error("generate", "--columns", "0.5,0,1,1", mention="--columns")
expect_error("generate", "--columns", "0,0,1,1", "--device", "abacus", mention="device")
expect_error("generate", "--columns", "0,0,2000,2000", mention="--columns")
expect_error("generate", "--columns", "0,0,134217728,0", mention="--columns")
expect_error("generate", mention="--columns")
for text in ("0", "-1", "x", "1e9"):
    expect_error("generate", "--columns", "0,0,0,0", "--threads", text, mention="--threads")
expect_error("generate", "--columns", "0,0,0,0", "--stats", SCRATCH / "nowhere/s.json", mention="nowhere")
expect_error("generate", "--stations", SCRATCH / "s.json", mention="--script")
expect_error("generate", "--script", SCRATCH / "none.lua", mention="none.lua")
expect_error("generate", "--script", SCRATCH, mention="folder")
script = SCRATCH / "world.lua"
script.write_text("set(0, 0, 0, 'stone')\nset(0, 999, 0, 'stone')\n")
expect_error("generate", "--script", script, "--world", SCRATCH / "made", mention="world.lua:2: y is from")
expect(not (SCRATCH / "made").exists(), "a script with a mistake made a world folder")
script.write_text("while true do end")
expect_error("generate", "--script", script, "--world", SCRATCH / "made", mention="limit")
expect_error("generate", "--script", script, "--seed", "5", mention="--seed")
expect_error("biome-map", mention="--output")
expect_error("biome-map", "-o", SCRATCH / "nowhere/m.png", mention="nowhere")
expect_error("biome-map", "-o", SCRATCH, mention="folder")
for center in ("1", "1,2,3", "0.5,0", "nan,0", "2147483647,0", "x,y"):
    expect_error("biome-map", "--center", center, "-o", SCRATCH / "m.png", mention="--center")
for option, text in (("--size", "0"), ("--size", "-5"), ("--size", "99999999"), ("--scale", "0"), ("--scale", "x"), ("--mode", "magic"), ("--seed", "x")):
    expect_error("biome-map", option, text, "-o", SCRATCH / "m.png", mention=option)
expect_error("biome-map", "--size", "16384", "--scale", "1", "-o", SCRATCH / "m.png", mention="--size")
expect_error("biome-map", "--size", "64", "--scale", "128", "-o", SCRATCH / "m.png", mention="--scale")
expect(not (SCRATCH / "m.png").exists(), "a refused map left a file")
expect_error("bench", "no.such.bench", mention="no.such.bench")
expect_error("serve", "--world", SCRATCH / "none")
expect(not (SCRATCH / "none").exists(), "serve made a world folder")

for text in ("nan", "inf", "1e99", "", "x"):
    expect_error("render", "--seed", "1", "--fov", text, "-o", SCRATCH / "a.png", mention="--fov")
    expect_error("render", "--seed", "1", "--time", text, "-o", SCRATCH / "a.png", mention="--time")
for text in ("99999999999999999999999", "1.5", "", "nan"):
    expect_error("generate", "--seed", text, "--columns", "0,0,0,0", mention="--seed")
expect_error("render", "--seed", "1", "--spp", "-1", "-o", SCRATCH / "a.png", mention="--spp")
expect_error("render", "--seed", "1", "--size", "16384x16384", "-o", SCRATCH / "a.png", mention="--size")
expect_error("render", "--seed", "1", "-o", "", mention="--output")
expect_error("render", "--seed", "1", "-o", SCRATCH, mention="folder")
expect_error("inspect", "--world", "", mention="--world")
expect_error("generate", "--columns", "0,0,0,0", "--world", "", mention="--world")
expect_error("inspect", "--world", "two\nlines")
expect_error("--world", "two\nlines", program=SERVER)
expect_error("generate", "--columns", "0,0,0,0", "--world", SCRATCH / ("long" * 100))
expect_error("import", SCRATCH / ("long" * 100), "--world", SCRATCH / "w")

# Content that is not there, is empty or does not run.
expect_error("generate", "--columns", "0,0,0,0", env={"VITRAIL_CONTENT": "/nonexistent"}, mention="VITRAIL_CONTENT")
content = SCRATCH / "content"
(content / "base").mkdir(parents=True)
spoiled = {"VITRAIL_CONTENT": str(content)}
expect_error("generate", "--columns", "0,0,0,0", env=spoiled, mention="script")
for script in ("define_block{", "while true do end", "local t = {} while true do t[#t + 1] = ('x'):rep(100000) .. #t end", "\x1bLua\x54\x00",
               "error('two\\nlines')", "error({})", "os.exit(0)", "define_block(nil)", "define_block{name = 'a b'}"):
    (content / "base/first.lua").write_text(script)
    expect_error("generate", "--columns", "0,0,0,0", env=spoiled, mention="first.lua")

# No OpenGL, no display.
expect_error("render", "--seed", "1", "-o", SCRATCH / "a.png", env={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"}, mention="OpenGL")
no_display = {"DISPLAY": "", "WAYLAND_DISPLAY": "", "XDG_RUNTIME_DIR": "", "SDL_VIDEODRIVER": ""}
expect_error("play", "--world", SCRATCH / "played", env=no_display, mention="display")
expect(not (SCRATCH / "played").exists(), "play without a display made a world")

# Wrong files.
text = SCRATCH / "text.txt"
text.write_text("this is no world")
for command in ("inspect", "verify"):
    expect_error(command, "--world", SCRATCH / "none")
    expect_error(command, "--world", text)
empty = SCRATCH / "empty"
empty.mkdir()
expect_error("inspect", "--world", empty)
expect(not list(empty.iterdir()), "inspect wrote into an empty folder")
broken = SCRATCH / "broken"
broken.mkdir()
(broken / "world.sqlite").write_bytes(b"SQLite format 3\0" + bytes(range(256)) * 40)
expect_error("inspect", "--world", broken)
expect_error("verify", "--world", broken)
expect_error("backup", "--world", broken, "--target", SCRATCH / "copy")
expect_error("import", SCRATCH / "none", "--world", SCRATCH / "w")
expect_error("import", text, "--world", SCRATCH / "w")
expect_error("import", empty, "--world", SCRATCH / "w")
expect(not (SCRATCH / "w").exists(), "a failed import left a world behind")
expect_error("import", text, "--count", SCRATCH / "c.json")
expect(not (SCRATCH / "c.json").exists(), "a failed count left a file behind")
expect_error("import", text, mention="--world")

# A world to spoil.
world = SCRATCH / "world"
expect_ok("generate", "--seed", 5, "--columns", "0,0,1,1", "--world", world)
expect_error("generate", "--seed", 6, "--columns", "0,0,1,1", "--world", world)
expect_error("backup", "--world", world, "--target", world)
file = world / "world.sqlite"
whole = file.read_bytes()
cut = SCRATCH / "cut"
cut.mkdir()
(cut / "world.sqlite").write_bytes(whole[: len(whole) // 3])
result = run("verify", "--world", cut)
expect(result.returncode == 2, f"verify of a cut world: status {result.returncode}")

# A second process on one world.
server = subprocess.Popen([VITRAIL, "serve", "--world", str(world)],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
expect("serving" in server.stdout.readline(), "serve says when it is ready")
expect_error("serve", "--world", world)
expect_ok("inspect", "--world", world)
expect_ok("backup", "--world", world, "--target", SCRATCH / "live")
server.terminate()
server.wait(30)
expect(server.returncode == 0, f"serve ends cleanly on SIGTERM, status {server.returncode}")
expect_ok("verify", "--world", SCRATCH / "live")
expect_ok("verify", "--world", world)

# Names that are no text, links, folders in place of files.
odd = os.fsdecode(os.fsencode(SCRATCH) + b"/odd \xff\xfe %?#name")
expect_ok("generate", "--seed", 5, "--columns", "0,0,1,1", "--world", odd)
expect_ok("verify", "--world", odd)
link = SCRATCH / "link"
link.symlink_to(world)
expect_ok("verify", "--world", link)
loop = SCRATCH / "loop"
loop.symlink_to(loop)
expect_error("inspect", "--world", loop)
expect_error("generate", "--columns", "0,0,1,1", "--world", loop)
folder_for_file = SCRATCH / "folder_for_file"
(folder_for_file / "world.sqlite").mkdir(parents=True)
expect_error("inspect", "--world", folder_for_file)
expect_error("serve", "--world", folder_for_file)


# Interrupted: one line and status 2, and what was done is kept or gone as a whole.
def interrupt(words, number, ready, wait=20):
    process = subprocess.Popen([VITRAIL, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    end = time.monotonic() + wait
    while process.poll() is None and not ready() and time.monotonic() < end:
        time.sleep(0.005)
    process.send_signal(number)
    process.stderr_text = process.communicate(timeout=wait)[1]
    return process


def size_of(path):
    return path.stat().st_size if path.exists() else 0


begun = SCRATCH / "begun"
for number in (signal.SIGINT, signal.SIGTERM):
    done = interrupt(["generate", "--seed", 5, "--columns", "0,0,99,99", "--world", begun], number,
                     lambda: size_of(begun / "world.sqlite-wal") > 100_000)
    lines = [line for line in done.stderr_text.splitlines() if not line.startswith("vitrail: info:")]
    expect(done.returncode == 2 and len(lines) == 1 and "interrupted" in lines[0], f"interrupted generate: {done.returncode} {lines}")
interrupt(["generate", "--seed", 5, "--columns", "0,0,99,99", "--world", begun], signal.SIGKILL,
          lambda: size_of(begun / "world.sqlite-wal") > 100_000)
expect_ok("verify", "--world", begun)
expect_ok("generate", "--seed", 5, "--columns", "0,0,3,3", "--world", begun)

region = FIXTURES / "worlds/anvil-1.8-to-1.21/1.18.2/r.0.0.mca"
region = region if region.is_file() else None
if region:
    many = SCRATCH / "many"
    many.mkdir()
    raw = region.read_bytes()
    for x in range(24): # chunks at a wrong place are read and reported, which takes as long
        (many / f"r.{x}.0.mca").write_bytes(raw)
    imported = SCRATCH / "imported"
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        done = interrupt(["import", many, "--world", imported, "--quiet"], number, lambda: size_of(imported / "world.sqlite-wal") > 800_000)
        if number != signal.SIGKILL:
            expect(done.returncode in (0, 2), f"interrupted import: status {done.returncode}")
            if done.returncode == 2:
                expect("interrupted" in done.stderr_text and not imported.exists(), f"interrupted import left a world: {done.stderr_text}")
            shutil.rmtree(imported, ignore_errors=True)
    if done.returncode == -signal.SIGKILL: # else it was quicker
        expect_error("inspect", "--world", imported, mention="unfinished")
        expect_error("verify", "--world", imported)
        expect_error("serve", "--world", imported, mention="unfinished")
        expect_error("generate", "--columns", "0,0,1,1", "--world", imported, mention="unfinished")
        expect_error("render", "--world", imported, "--at", "0,80,0", "--look", "0,0", "-o", SCRATCH / "a.png", mention="unfinished")
        expect_ok("import", region, "--world", imported, "--quiet")
        expect_ok("verify", "--world", imported)
    expect_error("import", region, "--world", imported, mention="holds a world")

# No permission (a mount says no to root too) and a full disk, where this machine lets us make them.
small = SCRATCH / "small"
small.mkdir()
if os.geteuid() == 0 and subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", str(small)],
                                        capture_output=True).returncode == 0:
    try:
        expect_error("generate", "--seed", 5, "--columns", "0,0,7,7", "--world", small / "w")
        expect_error("backup", "--world", world, "--target", small / "b")
        expect(not (small / "b").exists(), "a failed backup left something behind")
        if region:
            expect_error("import", region, "--world", small / "i")
            expect(not (small / "i").exists(), "a failed import left something behind")
        try:
            with open(small / "filler", "wb", buffering=0) as filler: # to the last byte
                while filler.write(bytes(4096)):
                    pass
        except OSError:
            pass
        expect_error("inspect", "--world", world, "--blocks", small / "blocks.json", mention="blocks.json")
        expect(not list(small.glob("blocks*")), "a failed inspect left something behind")
        subprocess.run(["mount", "-o", "remount,ro", str(small)], check=True)
        expect_error("generate", "--seed", 5, "--columns", "0,0,1,1", "--world", small / "x")
        expect_error("backup", "--world", world, "--target", small / "x")
        expect_error("render", "--seed", "1", "-o", small / "a.png", mention="a.png")
        if region:
            expect_error("import", region, "--world", small / "x")
            expect_error("import", region, "--count", small / "c.json", mention="c.json")
    finally:
        subprocess.run(["umount", str(small)], check=False)
else:
    print("no mount here: full disk and read-only folder are tested in tests/store only")
finish()
