"""Bad input of every kind gives one clear line and status 2, and writes nothing."""
import os
import subprocess

from harness import FIXTURES, SCRATCH, expect, expect_error, expect_ok, finish, run

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
expect_error("generate", "--columns", "0,0,1", mention="--columns")
expect_error("generate", "--columns", "5,0,1,1", mention="--columns")
expect_error("generate", "--columns", "0.5,0,1,1", mention="--columns")
expect_error("generate", "--columns", "0,0,1,1", "--device", "abacus", mention="device")
expect_error("bench", "no.such.bench", mention="no.such.bench")
expect_error("serve", "--world", SCRATCH / "none")
expect(not (SCRATCH / "none").exists(), "serve made a world folder")

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
server = subprocess.Popen([os.environ.get("VITRAIL_PROGRAM", __import__("sys").argv[1]), "serve", "--world", str(world)],
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

# No permission (a mount says no to root too) and a full disk, where this machine lets us make them.
small = SCRATCH / "small"
small.mkdir()
if os.geteuid() == 0 and subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", str(small)],
                                        capture_output=True).returncode == 0:
    try:
        expect_error("generate", "--seed", 5, "--columns", "0,0,7,7", "--world", small / "w")
        subprocess.run(["mount", "-o", "remount,ro", str(small)], check=True)
        expect_error("generate", "--seed", 5, "--columns", "0,0,1,1", "--world", small / "x")
    finally:
        subprocess.run(["umount", str(small)], check=False)
else:
    print("no mount here: full disk and read-only folder are tested in tests/store only")
finish()
