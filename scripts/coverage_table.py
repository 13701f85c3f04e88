#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Turns gcovr's JSON into lines and branches per module: coverage_table.py COVERAGE.json UNCOVERED.txt

Writes doc/coverage.csv and the table in doc/coverage.md, and to UNCOVERED.txt every line of code that no test reached.
Exits with 1 if a module is below its limit.
"""

import collections
import csv
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- measured: written by scripts/coverage -->", "<!-- end of what was measured -->"
# Percent of lines.
LIMIT, LIMITS = 95.0, {"wire": 97.0, "camera": 97.0}


class Count:
    def __init__(self):
        self.lines = self.lines_reached = self.branches = self.branches_reached = 0

    def add(self, line):
        self.lines += 1
        self.lines_reached += line["count"] > 0
        branches = line["branches"]
        self.branches += len(branches)
        self.branches_reached += sum(branch["count"] > 0 for branch in branches)


def percent(part, whole):
    return 100.0 * part / whole if whole else 100.0


def module_of(name):
    """The module of a file such as src/wire/text.cpp or include/trk_bridge/wire/codec.h."""
    parts = pathlib.PurePath(name).parts
    if parts[0] == "src":
        return parts[1]
    return parts[2] if parts[1] == "trk_bridge" else "c_api"


def measured(files):
    """(module -> Count, the lines that no test reached as text)"""
    modules, uncovered = collections.defaultdict(Count), []
    for file in files:
        source = (ROOT / file["file"]).read_text(encoding="utf-8").splitlines()
        for line in file["lines"]:
            if line.get("gcovr/noncode"):
                continue
            modules[module_of(file["file"])].add(line)
            if line["count"] == 0:
                number = line["line_number"]
                uncovered.append(f"{file['file']}:{number}: {source[number - 1].strip()}")
    return dict(sorted(modules.items())), uncovered


def write_csv(modules):
    with (ROOT / "doc" / "coverage.csv").open("w", newline="", encoding="utf-8") as out:
        rows = csv.writer(out, lineterminator="\n")
        rows.writerow(["module", "lines", "lines reached", "branches", "branches reached"])
        for name, count in modules.items():
            rows.writerow([name, count.lines, count.lines_reached, count.branches, count.branches_reached])


def write_table(modules):
    rows = ["| module | lines | reached | branches | reached |", "|---|---|---|---|---|"]
    for name, c in modules.items():
        rows.append(f"| `{name}` | {c.lines} | {percent(c.lines_reached, c.lines):.1f} % | {c.branches} | "
                    f"{percent(c.branches_reached, c.branches):.1f} % |")
    page = ROOT / "doc" / "coverage.md"
    before, rest = page.read_text(encoding="utf-8").split(BEGIN)
    page.write_text(before + BEGIN + "\n" + "\n".join(rows) + "\n" + END + rest.split(END)[1], encoding="utf-8")
    print("\n".join(rows))


def main():
    report, uncovered_file = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    modules, uncovered = measured(json.loads(report.read_text())["files"])
    write_csv(modules)
    write_table(modules)
    uncovered_file.write_text("\n".join(uncovered) + "\n", encoding="utf-8")
    print(f"{len(uncovered)} lines that no test reached: {uncovered_file}")
    low = []
    for name, count in modules.items():
        limit = LIMITS.get(name, LIMIT)
        reached = percent(count.lines_reached, count.lines)
        if reached < limit:
            low.append(f"coverage of {name}: {reached:.1f} % of lines, must be at least {limit:g} %")
    for line in low:
        print(line, file=sys.stderr)
    return 1 if low else 0


if __name__ == "__main__":
    sys.exit(main())
