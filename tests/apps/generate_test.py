"""Generated land from the command line: the same for every number of threads and order, kept in worlds, listed, mapped."""
import json
import struct

from harness import LONG, SCRATCH, expect, expect_error, expect_ok, finish


def hash_of(*words):
    lines = expect_ok("generate", *words, "--hash").stdout.splitlines()
    return next((line for line in lines if line.startswith("hash ")), "no hash")


area = ("--seed", 7, "--columns=-9,-5,6,10")
one = hash_of(*area, "--threads", 1)
expect(one != "no hash" and one != "hash 0000000000000000", f"a hash: {one}")
for threads in (2, 5):
    expect(hash_of(*area, "--threads", threads) == one, f"{threads} threads make another land")
expect(hash_of("--seed", 8, "--columns=-9,-5,6,10") != one, "another seed makes the same land")
# A hash is a sum over columns: two halves make the whole, whatever else was made.
halves = [hash_of("--seed", 7, f"--columns={part}").split()[1] for part in ("-9,-5,-2,10", "-1,-5,6,10")]
expect(f"hash {(int(halves[0], 16) + int(halves[1], 16)) % 2**64:016x}" == one, "two halves are not the whole")
# The last columns of the world.
edge = 2147483136 // 16
hash_of("--seed", 7, f"--columns={edge - 2},{-edge},{edge - 1},{-edge + 1}")

stats_file = SCRATCH / "stats.json"
expect_ok("generate", *area, "--world", SCRATCH / "world", "--stats", stats_file)
stats = json.loads(stats_file.read_text())
expect(stats["columns"] == 256 and stats["chunks"] > 256 and stats["hash"] == one.split()[1], f"stats: {stats}")
expect(set(stats["stages"]) == {"land", "ground", "lattice", "caves", "features", "blocks"}, "stages in the stats")
expect(stats["stages"]["blocks"]["parts"] == 256 and stats["stages"]["ground"]["seconds"] > 0, f"times of stages: {stats['stages']}")
inspected = expect_ok("inspect", "--world", SCRATCH / "world").stdout
expect("256 columns" in inspected, inspected)
expect_ok("verify", "--world", SCRATCH / "world")

listed = expect_ok("generate", "--list").stdout.splitlines()
expect(all(line.strip() for line in listed), "an empty line in the list")


def count(kind):
    return sum(line.startswith(kind + " ") for line in listed)


for kind, least in (("biome", 24), ("layer", 20), ("stage", 6), ("feature", 30), ("decorator", 60), ("block", 100), ("attribute", 6)):
    expect(count(kind) >= least, f"{count(kind)} lines of {kind}")
expect(sum(line.startswith("cave biome ") for line in listed) == 5, "five cave biomes")


def png_size(path):
    head = path.read_bytes()[:24]
    expect(head[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG")
    return struct.unpack(">II", head[16:24])


map_file = SCRATCH / "map.png"
told = expect_ok("biome-map", "--seed", 7, "--size", 256, "-o", map_file).stdout
expect(png_size(map_file) == (256, 256) and "every block" in told, f"a map of blocks: {told}")
expect(map_file.stat().st_size > 10000, "the map shows something")
told = expect_ok("biome-map", "--seed", 7, "--size", 4096, "--scale", 64, "--mode", "biomes", "--center=-100000,200000", "-o", map_file).stdout
expect(png_size(map_file) == (64, 64), "a map of biomes")
legend = [line for line in told.splitlines() if line.startswith("#")]
expect(len(legend) >= 24, f"a legend: {legend}")
expect(99 < sum(float(line.split()[1]) for line in legend) < 101, "shares sum to 1")
expect(len({line.split()[0] for line in legend}) == len(legend), "two biomes of one color")
far = 2147483136 - 64
expect_ok("biome-map", "--seed", 7, "--size", 64, f"--center={far},{-far}", "-o", map_file)
if LONG:
    expect_ok("biome-map", "--seed", 7, "--size", 16384, "-o", map_file)
    expect(png_size(map_file) == (1024, 1024), "a large map")

# A world made by a script.
script, stations_file = SCRATCH / "garden.lua", SCRATCH / "stations.json"
script.write_text("""world { name = "Garden", spawn = { 0, 65, 0 } } fill(-20, 60, -20, 20, 64, 20, "stone") print("hello")
station { name = "a", effect = "water", at = { 1, 66.5, 2 }, look = { 90, 5 }, time = 7000, without = "water.waves=false" }""")
told = expect_ok("generate", "--script", script, "--world", SCRATCH / "garden", "--stations", stations_file, "--stats", stats_file).stdout
expect("hello" in told and "1 stations" in told, told)
stations = json.loads(stations_file.read_text())
expect(stations == [{"name": "a", "effect": "water", "text": "", "at": [1, 66.5, 2], "look": [90, 5], "fov": 70, "time": 7000,
                     "without": ["water.waves=false"]}], f"stations: {stations}")
stats = json.loads(stats_file.read_text())
expect(stats["columns"] == 16 and stats["chunks"] == 32 and stats["stations"] == 1, f"stats of a script: {stats}")
expect("16 columns" in expect_ok("inspect", "--world", SCRATCH / "garden").stdout, "columns of a script")
expect_ok("verify", "--world", SCRATCH / "garden")
expect_error("generate", "--script", script, "--world", SCRATCH / "garden", mention="holds a world already")
to_standard = expect_ok("generate", "--script", script, "--stations", "/dev/stdout").stdout
expect('"effect": "water"' in to_standard, to_standard)
finish()
