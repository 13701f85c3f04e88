# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Arrivals and stamps, from the table that stamp_figures.py measures."""

import csv
import pathlib

from .axes import Axes
from .svg import GREY, Picture

FOLDER = pathlib.Path(__file__).resolve().parent.parent
ARRIVAL, STAMP = "#ef6c00", "#1565c0"
WIDTH, HEIGHT = 390, 190

# Of each case: its title, ticks in s, and the lowest and highest lateness in ms.
PANELS = [("start", "the first 12 seconds", (0, 2, 4, 6, 8, 10, 12), 20, 50),
          ("stall", "a stall of 0.3 s at 60 s", (59, 60, 61, 62), 20, 340),
          ("step", "a path that becomes 5 ms longer at 60 s", (58, 60, 62, 64, 66, 68, 70), 20, 50),
          ("restart", "a tracker that restarts at 60 s", (58, 60, 62, 64, 66, 68, 70), 20, 50)]


def rows_of(case):
    with (FOLDER / "stamps_plot.csv").open(newline="", encoding="utf-8") as file:
        return [{key: float(row[key]) for key in ("time", "arrival", "stamp")}
                for row in csv.DictReader(file) if row["case"] == case]


def panel(picture, left, top, case, title, ticks, lowest, highest):
    axes = Axes(picture, (left, top, WIDTH, HEIGHT), ticks, lowest, highest, title)
    rows = rows_of(case)
    for row in rows[::1 if len(rows) < 200 else 3]:
        picture.dot(axes.at(row["time"], row["arrival"]), 1.3, ARRIVAL)
    picture.line([axes.at(row["time"], row["stamp"]) for row in rows], STAMP, 1.5)


def stamps():
    picture = Picture(940, 560, "Arrivals and stamps by the counter")
    for i, values in enumerate(PANELS):
        panel(picture, 60 + 470 * (i % 2), 40 + 250 * (i // 2), *values)
    picture.dot((60, 541), 2.5, ARRIVAL)
    picture.text((70, 545), "arrivals (every third where there are many)", 12, ARRIVAL)
    picture.line([(400, 541), (430, 541)], STAMP, 2)
    picture.text((438, 545), "stamps", 12, STAMP)
    picture.text((900, 545), "ms after the sample was taken, over s", 12, GREY, "end")
    return picture
