#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Checks that the pages show all programs of doc/examples, unchanged."""

import pathlib
import sys

import pages


def main():
    doc = pathlib.Path(__file__).resolve().parents[2] / "doc"
    # The first line is the copyright statement, which pages leave out.
    examples = {path.read_text(encoding="utf-8").split("\n", 1)[1]: path.name
                for path in sorted((doc / "examples").glob("*.c"))}
    shown, faults = set(), []
    for page in sorted(doc.glob("*.md")):
        for block in pages.blocks_of(page.read_text(encoding="utf-8")):
            if block.language != "c":
                continue
            if block.text in examples:
                shown.add(examples[block.text])
            else:
                faults.append(f"{page.name}:{block.line}: not a program of doc/examples, or an old version of one")
    faults += [f"doc/examples/{name}: no page shows it" for name in sorted(set(examples.values()) - shown)]
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
