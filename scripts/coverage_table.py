#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Prints a table of the lines and branches that ran, a row for each module; see scripts/coverage.

Usage: coverage_table.py [--limits] ROOT BUILD. BUILD has the files of gcc's --coverage. Writes the lines that did not run to
BUILD/uncovered.txt, as `src/lens/table.cpp: 12, 40-44`. With --limits, the exit code is 1 if the lines of a module are below
its limit.

A line that is compiled more than once (in headers, as a template) has run if one of them has; so has a branch. The
branches that only exceptions take are not counted.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "test" / "support"))
from text_table import aligned  # noqa: E402


def limit_of(module):
    """The least part of its lines that must run, in percent."""
    return 97 if module in ("wire", "camera") else 95


class Counts:
    """Of lines and branches, all and those that ran."""

    def __init__(self):
        self.lines = self.run_lines = self.branches = self.run_branches = 0

    def add(self, lines):
        for count, branches in lines.values():
            self.lines += 1
            self.run_lines += count > 0
            self.branches += len(branches)
            self.run_branches += sum(branch > 0 for branch in branches)

    def lines_percent(self):
        return 100.0 * self.run_lines / self.lines if self.lines else 100.0

    def branches_percent(self):
        return 100.0 * self.run_branches / self.branches if self.branches else 100.0


def reports_of(notes):
    """gcov's reports on an object file: one for each source file in it."""
    done = subprocess.run(["gcov", "--json-format", "--branch-probabilities", "--stdout", notes],
                          capture_output=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"gcov cannot read {notes}: {done.stderr.decode(errors='replace')}")
    for text in done.stdout.splitlines():
        report = json.loads(text)
        for file in report["files"]:
            yield os.path.normpath(os.path.join(report["current_working_directory"], file["file"])), file["lines"]


def merge(into, lines):
    """`into`: line number -> [how often it ran, [how often each branch was taken]]. Of lists of branches that cannot be
    added, because a template has more of them for another type, the longest counts."""
    for line in lines:
        branches = [branch["count"] for branch in line["branches"] if not branch["throw"]]
        known = into.setdefault(line["line_number"], [0, []])
        known[0] += line["count"]
        if len(known[1]) == len(branches):
            known[1] = [a + b for a, b in zip(known[1], branches)]
        elif len(known[1]) < len(branches):
            known[1] = branches


def lines_of(root, build):
    """Source file, relative -> what merge() makes of it."""
    files = collections.defaultdict(dict)
    sources = (f"{root}/src/", f"{root}/include/")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for reports in pool.map(lambda notes: [each for each in reports_of(notes) if each[0].startswith(sources)],
                                sorted(build.rglob("*.gcno"))):
            for file, lines in reports:
                merge(files[os.path.relpath(file, root)], lines)
    return files


def module_of(path):
    """"lens" of src/lens/table.cpp and include/trk_bridge/lens/table.h; the headers of the C interface are c_api's."""
    folder, *rest = pathlib.PurePath(path).parts
    if folder == "src":
        return rest[0]
    return rest[1] if rest[0] == "trk_bridge" and len(rest) > 2 else "c_api"


def ranges(numbers):
    """[12, 40, 41, 42] as "12, 40-42"."""
    groups = []
    for number in sorted(numbers):
        if groups and groups[-1][1] == number - 1:
            groups[-1][1] = number
        else:
            groups.append([number, number])
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in groups)


def main():
    parser = argparse.ArgumentParser(prog="coverage_table.py")
    parser.add_argument("--limits", action="store_true")
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    given = parser.parse_args()
    files = lines_of(given.root.resolve(), given.build.resolve())
    if not files:
        sys.exit(f"coverage_table: {given.build} has no .gcno file of a source in {given.root}")
    modules, total = collections.defaultdict(Counts), Counts()
    with (given.build / "uncovered.txt").open("w", encoding="utf-8") as uncovered:
        for file, lines in sorted(files.items()):
            modules[module_of(file)].add(lines)
            total.add(lines)
            missing = [number for number, (count, _) in lines.items() if count == 0]
            if missing:
                uncovered.write(f"{file}: {ranges(missing)}\n")
    rows = [["module", "lines", "run", "branches run"]]
    below = []
    for name, counts in [*sorted(modules.items()), ("all", total)]:
        rows.append([name, str(counts.lines), f"{counts.lines_percent():.1f} %", f"{counts.branches_percent():.1f} %"])
        if name != "all" and counts.lines_percent() < limit_of(name):
            below.append(f"{name}: {counts.lines_percent():.2f} % of the lines run, {limit_of(name)} % must")
    print("\n".join(aligned(rows)))
    if given.limits:
        print("\n".join(below) or "no module is below its limit")
    return int(given.limits and bool(below))


if __name__ == "__main__":
    sys.exit(main())
