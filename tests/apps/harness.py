"""Shared by the command-line tests: runs the program, checks the contract of errors (one line, status 2)."""
import os
import pathlib
import subprocess
import sys
import tempfile

VITRAIL, SERVER, SOURCE = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
FIXTURES = pathlib.Path(os.environ.get("VITRAIL_FIXTURES", SOURCE / "../shared/fixtures"))
LONG = bool(os.environ.get("VITRAIL_LONG"))
_scratch = tempfile.TemporaryDirectory(prefix="vitrail_cli_")
SCRATCH = pathlib.Path(_scratch.name)
faults = []


def run(*words, timeout=300, env=None, program=VITRAIL):
    return subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=timeout,
                          env={**os.environ, **(env or {})}, stdin=subprocess.DEVNULL)


def expect(condition, what):
    if not condition:
        faults.append(what)
        print("FAULT:", what)


def expect_ok(*words, **options):
    result = run(*words, **options)
    expect(result.returncode == 0, f"{' '.join(map(str, words))}: status {result.returncode}: {result.stderr.strip()[-500:]}")
    return result


def errors_of(result):
    """Lines that are no log lines of level info."""
    return [line for line in result.stderr.splitlines() if line.strip() and not line.startswith("vitrail: info:")]


def expect_error(*words, mention=None, **options):
    """Status 2 and exactly one clear line on standard error."""
    result = run(*words, **options)
    name = " ".join(map(str, words))
    expect(result.returncode == 2, f"{name}: status {result.returncode}, wanted 2: {result.stderr.strip()[-300:]}")
    lines = errors_of(result)
    expect(len(lines) == 1 and lines[0].startswith("vitrail"), f"{name}: wanted one line, got {lines}")
    if mention and lines:
        expect(mention.lower() in lines[0].lower(), f"{name}: '{lines[0]}' does not mention '{mention}'")
    return result


def finish():
    if faults:
        sys.exit(f"{len(faults)} faults")
    print("ok")
