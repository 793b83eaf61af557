"""The path tracer and camera paths on the command line: EXR with its layers, the same picture for the same seed, numbered frames, videos."""
import json
import shutil
import subprocess

from harness import SCRATCH, expect, expect_error, expect_ok, finish

PLACE = ("--seed", "7", "--view-distance", "2", "--quality", "low", "--size", "32x18", "--at", "434.5,146,440.5", "--look", "20,30")
TRACE = ("render", *PLACE, "--renderer", "trace", "--device", "cpu", "--spp", "2", "--bounces", "2")


def bytes_of(name):
    path = SCRATCH / name
    return path.read_bytes() if path.exists() else b""


# Pictures.
stats = SCRATCH / "stats.json"
expect_ok(*TRACE, "--denoise", "off", "-o", SCRATCH / "a.png", "--stats", stats)
figures = json.loads(stats.read_text())
expect(figures["device"] == "CPU" and figures["rays"] > 32 * 18 * 2, f"figures of the tracer: {figures}")
expect_ok(*TRACE, "--denoise", "off", "-o", SCRATCH / "b.png")
expect_ok(*TRACE, "--denoise", "off", "--trace-seed", "1", "-o", SCRATCH / "c.png")
expect(bytes_of("a.png") == bytes_of("b.png") != b"", "the same seed gives the same picture")
expect(bytes_of("a.png") != bytes_of("c.png"), "another seed gives other noise")
expect_ok(*TRACE, "-o", SCRATCH / "a.exr")
exr = bytes_of("a.exr")
expect(exr[:4] == b"\x76\x2f\x31\x01", "an EXR begins as one")
for name in (b"R", b"G", b"B", b"albedo.R", b"albedo.B", b"normal.X", b"normal.Z"):
    expect(b"\0" + name + b"\0\x01\0\0\0" in exr[:600], f"EXR: {name} of halves")
expect(b"\0depth.Z\0\x02\0\0\0" in exr[:600], "EXR: depth of floats")
for name in (b"spp\0int\0", b"device\0string\0", b"seed\0int\0", b"timeOfDay\0float\0"):
    expect(name in exr[:2000], f"EXR: says {name}")
expect_error("render", *PLACE, "-o", SCRATCH / "raster.exr", mention="--renderer trace")
expect_error(*TRACE, "-o", SCRATCH / "nowhere/a.exr", mention="nowhere")
expect_error(*TRACE, "-o", SCRATCH / "video.mp4", mention="--path")
expect_error(*TRACE, "--denoise", "perhaps", "-o", SCRATCH / "no.png", mention="--denoise")
expect_error(*TRACE, "--device", "abacus", "-o", SCRATCH / "no.png", mention="--device")

# Paths.
path = SCRATCH / "path.json"
path.write_text(json.dumps({"keys": [{"seconds": 0, "at": [434.5, 146, 440.5], "look": [350, 30], "time": 6000},
                                     {"seconds": 1, "at": [464.5, 149, 440.5], "look": [20, 20], "time": 7000}]}))
WALK = (*TRACE, "--path", path, "--fps", "3")
expect_ok(*WALK, "-o", SCRATCH / "f-%03d.png", "--stats", stats)
frames = sorted(p.name for p in SCRATCH.glob("f-*"))
expect(frames == ["f-000.png", "f-001.png", "f-002.png"], f"frames: {frames}")
expect(len({bytes_of(name) for name in frames}) == 3, "frames differ")
expect(json.loads(stats.read_text())["frames"] == 3, "figures count the frames")
expect_ok(*WALK, "--seconds", "0.3", "-o", SCRATCH / "g%d.exr")
expect(bytes_of("g0.exr")[:4] == exr[:4], "a frame of EXR")
expect_ok("render", *PLACE, "--path", path, "--fps", "2", "-o", SCRATCH / "r%02d.png")
expect(bytes_of("r00.png") != b"" and bytes_of("r00.png") != bytes_of("r01.png") != b"", "paths are drawn by the raster renderer too")
for name in ("one.png", "a%sb.png", "a%d-%d.png", "%0d%.png", "%99d.png", "a%nb.png"):
    expect_error(*WALK, "-o", SCRATCH / name, mention="--output")
for text in ("", "{", '{"keys": []}', '{"keys": [{"seconds": 0, "fow": 3}]}', '{"keys": [{"seconds": 1}, {"seconds": 1}]}'):
    (SCRATCH / "bad.json").write_text(text)
    expect_error(*TRACE, "--path", SCRATCH / "bad.json", "-o", SCRATCH / "x%d.png", mention="bad.json")
expect_error(*TRACE, "--path", SCRATCH / "none.json", "-o", SCRATCH / "x%d.png", mention="none.json")
expect_error(*TRACE, "--fps", "5", "-o", SCRATCH / "x.png", mention="--path")
for text in ("0", "nan", "-3", "1e9"):
    expect_error(*WALK, "--fps", text, "-o", SCRATCH / "x%d.png", mention="--fps")

# Videos.
expect_error(*WALK, "-o", SCRATCH / "no.mp4", env={"PATH": str(SCRATCH)}, mention="ffmpeg")
fake = SCRATCH / "bin"
fake.mkdir()
(fake / "ffmpeg").write_text("#!/bin/sh\necho 'no such codec' >&2\nexit 1\n")
(fake / "ffmpeg").chmod(0o755)
expect_error(*WALK, "-o", SCRATCH / "no.mp4", env={"PATH": f"{fake}:/usr/bin:/bin"}, mention="no such codec")
if shutil.which("ffmpeg"):
    odd = SCRATCH / "-odd name;%.mkv" # no option, no shell
    for name in (SCRATCH / "v.mp4", odd):
        expect_ok(*WALK, "-o", name)
    count = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries", "stream=nb_read_frames,width,height",
                            "-of", "json", str(SCRATCH / "v.mp4")], capture_output=True, text=True, timeout=60)
    video = json.loads(count.stdout or "{}").get("streams", [{}])[0]
    expect((video.get("nb_read_frames"), video.get("width"), video.get("height")) == ("3", 32, 18), f"the video: {video} {count.stderr}")
    expect(odd.exists() and odd.stat().st_size > 500, "a video of an odd name")
left = [p.name for p in SCRATCH.iterdir() if ".part" in p.name or p.name.startswith(("no", "x", "raster", "one"))]
expect(not left, f"refused commands leave nothing: {left}")
finish()
