"""Looks at the source as text: file sizes, include guards, tabs, trailing blanks, docs and decisions that are named exist."""
import pathlib
import re
import statistics
import sys

root = pathlib.Path(sys.argv[1])
faults = []
sizes = []
LONG_WITH_REASON = "file-size:"  # a file over 600 lines says why in a comment with this word
for folder in ("src", "tests", "bench", "fuzz"):
    for path in sorted((root / folder).rglob("*")):
        if path.suffix not in (".h", ".cpp", ".cu", ".glsl", ".py"):
            continue
        text = path.read_text()
        lines = text.splitlines()
        if path.suffix in (".h", ".cpp"):
            sizes.append(len(lines))
        if len(lines) > 600 and LONG_WITH_REASON not in text:
            faults.append(f"{path}: {len(lines)} lines, over 600 without a reason ('{LONG_WITH_REASON} ...')")
        if path.suffix == ".h" and "#pragma once" not in text:
            faults.append(f"{path}: no #pragma once")
        if "\t" in text and path.suffix != ".py":
            faults.append(f"{path}: holds a tab")
        for number, line in enumerate(lines, 1):
            if line.rstrip() != line:
                faults.append(f"{path}:{number}: blank at the end of the line")
                break
for path in list(root.glob("*.md")) + list((root / "docs").rglob("*.md")):
    for target in re.findall(r"\]\(([^)#]+)\)", path.read_text()):
        if "://" not in target and not (path.parent / target).exists():
            faults.append(f"{path}: links to {target}, which is not there")
for path in (root / "src").rglob("*.h"):
    for name in re.findall(r"docs/[\w/.-]+\.md", path.read_text()):
        if not (root / name).exists():
            faults.append(f"{path}: names {name}, which is not there")
if statistics.median(sizes) > 200:
    faults.append(f"median file has {statistics.median(sizes)} lines, over 200")
print(f"{len(sizes)} files, median {statistics.median(sizes)} lines, {len(faults)} faults")
if faults:
    sys.exit("\n".join(faults))
