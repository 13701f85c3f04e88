# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Ratios of doc/speed.csv, which scripts/bench measures: bars from 1, with the spread and the aim."""

import csv
import math
import pathlib

from .svg import GREY, INK, Picture

FOLDER = pathlib.Path(__file__).resolve().parent.parent
LEFT, RIGHT, TOP, STEP = 420, 900, 64, 22
TICKS = (1 / 20, 1 / 10, 1 / 5, 1 / 2, 1, 2, 5)
BETTER, WORSE, AIM = "#2e7d32", "#ef6c00", "#c62828"


def speed():
    with (FOLDER / "speed.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    height = TOP + STEP * len(rows) + 50
    picture = Picture(940, height, "Times, as parts of the peer's")

    def at(ratio):
        share = math.log(max(min(float(ratio), TICKS[-1]), TICKS[0]) / TICKS[0]) / math.log(TICKS[-1] / TICKS[0])
        return LEFT + share * (RIGHT - LEFT)

    bottom = TOP + STEP * len(rows)
    for tick in TICKS:
        picture.line([(at(tick), TOP - 8), (at(tick), bottom)], INK if tick == 1 else "#dddddd", 1)
        picture.text((at(tick), TOP - 14), f"{tick:g}" if tick >= 1 else f"1/{1 / tick:g}", 11, INK, "middle")
    for i, row in enumerate(rows):
        y = TOP + STEP * (i + 0.5)
        low, high = sorted((at(1), at(row["ratio"])))
        colour = BETTER if float(row["ratio"]) <= 1 else WORSE
        picture.rectangle(low, y - 6, high - low, 12, colour, colour, 0.5)
        picture.line([(at(row["least"]), y), (at(row["most"]), y)], INK, 1)
        if row["aim"]:
            picture.line([(at(row["aim"]), y - 8), (at(row["aim"]), y + 8)], AIM, 2)
        picture.text((LEFT - 12, y + 4), f"{row['what']} / {row['peer is']}", 10, INK, "end")
    picture.line([(LEFT, bottom + 24), (LEFT + 30, bottom + 24)], INK, 1)
    picture.text((LEFT + 38, bottom + 28), "spread", 11, INK)
    picture.line([(LEFT + 120, bottom + 16), (LEFT + 120, bottom + 32)], AIM, 2)
    picture.text((LEFT + 128, bottom + 28), "aim", 11, AIM)
    picture.text((RIGHT, bottom + 28), "ours / peer, logarithmic", 11, GREY, "end")
    return picture
