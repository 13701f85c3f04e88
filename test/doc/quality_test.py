#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Checks the evidence in QUALITY_DECLARATION.md: quality_test.py [ROOT] [BUILD].

A figure is followed by the command that gives it, `12 files <!-- = ls test | wc -l -->`: the number before must be what the
command prints. Tests that the page names as `ctest -R NAME` must exist in BUILD, files and scripts in backticks in ROOT.
Every source file must have a copyright statement. The table in doc/coverage.md must have the modules of src/, each with the
part of lines that scripts/coverage asks for, and the files that the page names must exist. Links are checked by links_test.py.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

FIGURE = re.compile(r"(?P<number>\d[\d,.]*)(?P<words>[^|\d]*?)<!-- = (?P<command>.+?) -->")
TEST = re.compile(r"`ctest -R (?P<pattern>[^`]+)`")
PATH = re.compile(r"`(?P<path>(?:scripts|test|doc|include|src|\.ci)/[\w./-]*)`")
COPYRIGHT = re.compile(r"Copyright \(c\) \d{4},? trk_bridge maintainers")
SOURCES = ("*.h", "*.c", "*.cpp", "*.py", "*.sh", "*.zsh", "*.cmake", "scripts/*", ".ci/run", "test/rviz/with_display")
# Lists without code.
NO_CODE = {"scripts/cppcheck_suppressions.txt"}


def stale_figures(root, text):
    for match in FIGURE.finditer(text):
        # In a table, a page writes a pipe as \\|.
        command = match["command"].replace("\\|", "|")
        done = subprocess.run(["bash", "-c", command], cwd=root, capture_output=True, text=True, check=False)
        printed = done.stdout.strip()
        if done.returncode != 0 or printed != match["number"]:
            yield f"{match['number']}{match['words']}: `{command}` prints {printed or done.stderr.strip()!r}"


def tests_of(build):
    """What `ctest -N` lists. In BUILD itself it would overwrite the log of the ctest that runs this test."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "CTestTestfile.cmake").write_text(f'subdirs("{build}")\n', encoding="utf-8")
        return subprocess.run(["ctest", "-N"], cwd=folder, capture_output=True, text=True, check=True).stdout


def missing_tests(build, text):
    listed = tests_of(build)
    names = re.findall(r"^\s*Test\s+#\d+: (\S+)", listed, re.MULTILINE)
    for pattern in TEST.findall(text):
        if not any(re.search(pattern, name) for name in names):
            yield f"no test has {pattern} in its name"


def missing_paths(root, text):
    for path in PATH.findall(text):
        if not (root / path).exists():
            yield f"{path} does not exist"


def coverage_faults(root, text):
    sys.path.insert(0, str(root / "scripts"))
    from coverage_table import limit_of  # the one of this root

    table = dict(re.findall(r"^(\w+) +\d+ +([\d.]+) %", text, re.MULTILINE))
    modules = {folder.name for folder in (root / "src").iterdir() if folder.is_dir()}
    for name in sorted(modules ^ (table.keys() - {"all"})):
        yield f"{name} is a module without a row in the table, or a row without a module"
    for name in sorted(modules & table.keys()):
        if float(table[name]) < limit_of(name):
            yield f"{name}: {table[name]} % of the lines run, {limit_of(name)} % must"


def without_copyright(root):
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z", *SOURCES], capture_output=True, check=False)
    if listed.returncode != 0:  # no clone
        return
    for name in filter(None, listed.stdout.decode().split("\0")):
        if name in NO_CODE:
            continue
        begin = (root / name).read_text(encoding="utf-8", errors="replace")[:400]
        if not COPYRIGHT.search(begin):
            yield f"{name}: no copyright statement"


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]
    build = (pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else root / "build").resolve()
    declaration = (root / "QUALITY_DECLARATION.md").read_text(encoding="utf-8")
    coverage = (root / "doc" / "coverage.md").read_text(encoding="utf-8")
    faults = [f"QUALITY_DECLARATION.md: {fault}" for fault in (
        *stale_figures(root, declaration), *missing_tests(build, declaration), *missing_paths(root, declaration))]
    faults += [f"doc/coverage.md: {fault}" for fault in (
        *coverage_faults(root, coverage), *missing_tests(build, coverage), *missing_paths(root, coverage))]
    faults += without_copyright(root)
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
