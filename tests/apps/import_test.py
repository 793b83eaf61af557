"""Real worlds: counts equal the oracle, imports keep every non-air block, damaged files end in reports."""
import json
import sys

from harness import FIXTURES, LONG, SCRATCH, expect, expect_ok, finish, run

if not FIXTURES.is_dir():
    print("skipped: no fixtures")
    sys.exit(77)

AIR = {"minecraft:air", "minecraft:cave_air", "minecraft:void_air"}
cases = []
anvil = FIXTURES / "worlds/anvil-1.8-to-1.21"
for version, oracle in json.loads((anvil / "BLOCK-COUNT-ORACLE.json").read_text()).items():
    cases.append((version, anvil / version, oracle))
for oracle in json.loads((FIXTURES / "worlds/mcregion/BLOCK-COUNT-ORACLE.json").read_text()).values():
    cases.append(("mcregion", FIXTURES / "worlds/mcregion/PyTestWorld", oracle))

for name, source, oracle in cases:
    counts_file = SCRATCH / f"{name}.json"
    expect_ok("import", source, "--count", counts_file)
    counts = json.loads(counts_file.read_text())
    wanted = oracle["counts"]
    expect(counts == wanted, f"{name}: counts differ: " + str([(k, counts.get(k), wanted.get(k))
           for k in sorted(set(counts) | set(wanted)) if counts.get(k) != wanted.get(k)][:5]))
    if not LONG and name not in ("1.18.2", "1.13.2", "mcregion", "1.12.2"):
        continue
    world = SCRATCH / f"world-{name}"
    expect_ok("import", source, "--world", world, "--quiet")
    blocks_file = SCRATCH / f"{name}-blocks.json"
    expect_ok("inspect", "--world", world, "--blocks", blocks_file)
    blocks = json.loads(blocks_file.read_text())
    kept = {k: v for k, v in blocks.items() if k not in AIR}
    if all(not k.startswith("id:") for k in wanted):
        expect(kept == {k: v for k, v in wanted.items() if k not in AIR}, f"{name}: blocks differ after the import: " +
               str([(k, kept.get(k), wanted.get(k)) for k in sorted(set(kept) | set(wanted) - AIR) if kept.get(k) != wanted.get(k)][:5]))
    else: # old ids take modern names: nothing is lost, nothing appears
        solid = sum(v for k, v in wanted.items() if k != "id:0:0")
        expect(sum(kept.values()) == solid, f"{name}: {sum(kept.values())} non-air blocks after the import, {solid} before")
        expect(not any(k.startswith("legacy:") for k in kept), f"{name}: ids without a modern name: "
               + str([k for k in kept if k.startswith("legacy:")]))
    expect_ok("verify", "--world", world)

# Importing damaged files ends, either way, without a crash.
for path in sorted((FIXTURES / "corrupt").iterdir()):
    if path.suffix in (".mca", ".mcr", ".dat"):
        result = run("import", path, "--count", SCRATCH / "corrupt.json")
        expect(result.returncode in (0, 2), f"{path.name}: status {result.returncode}")
finish()
