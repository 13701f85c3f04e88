#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Compares the tables of doc/lens_fit.md with the results of lens_fit: lens_fit_test.py LENS_FIT DOC."""

import csv
import io
import pathlib
import re
import subprocess
import sys

ABSOLUTE, RELATIVE = 2e-5, 0.05  # pixels; nearly exact fits depend on the machine's rounding


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def is_near(a, b):
    try:
        a, b = float(a), float(b)
    except ValueError:
        return a == b
    return abs(a - b) <= ABSOLUTE + RELATIVE * max(abs(a), abs(b))


def differences(program, doc):
    for table in ("there", "back"):
        path = doc / f"lens_fit_{table}.csv"
        stated = rows_of(path.read_text(encoding="utf-8"))
        measured = rows_of(subprocess.run([program, table], check=True, capture_output=True, text=True).stdout)
        if len(stated) != len(measured):
            yield f"{path}: {len(stated)} rows, measured were {len(measured)}"
        for line, (old, new) in enumerate(zip(stated, measured), start=2):
            for column, value in new.items():
                if not is_near(old.get(column, ""), value):
                    yield f"{path}:{line}: {column} is {old.get(column)}, measured was {value}"


def page_differences(doc):
    """The table of the page agrees with the worked lenses of the file, to its number of digits."""
    page = (doc / "lens_fit.md").read_text(encoding="utf-8")
    for lens in rows_of((doc / "lens_fit_there.csv").read_text(encoding="utf-8")):
        if lens["lens"] != "worked":
            continue
        name = f"| {lens['u_at_corner']}, {float(lens['share_of_k1']) * 100:.0f} % |"
        row = next((line for line in page.splitlines() if line.startswith(name)), None)
        if row is None:
            yield f"lens_fit.md: no row {name}"
            continue
        stated = re.findall(r"([0-9.]+) px", row)
        for text, column in zip(stated, ("plumb_bob_2", "plumb_bob_3", "rational_polynomial")):
            digits = len(text.partition(".")[2])
            if abs(float(text) - float(lens[column])) > 0.5001 * 10 ** -digits:
                yield f"lens_fit.md: {column} of {name} is {text} px, measured was {lens[column]}"


def main():
    program, doc = sys.argv[1], pathlib.Path(sys.argv[2])
    found = [*differences(program, doc), *page_differences(doc)]
    for text in found:
        print(text, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
