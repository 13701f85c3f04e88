# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""The accuracy of the lens fit, from the tables that lens_fit.cpp measures."""

import csv
import math
import pathlib

from .svg import GREY, INK, Picture

FOLDER = pathlib.Path(__file__).resolve().parent.parent
LOWEST, HIGHEST = 1e-6, 20.0  # pixels

MODELS = [("plumb_bob_2", "plumb_bob k1 k2", "#ef6c00"),
          ("plumb_bob_3", "plumb_bob k1 k2 k3", "#1565c0"),
          ("rational_polynomial", "rational_polynomial", "#2e7d32")]


def table(name):
    with (FOLDER / name).open(newline="", encoding="utf-8") as file:
        return [{key: value if key == "lens" else float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]


class Plot:
    """A logarithmic plot of pixels over a ratio."""

    def __init__(self, picture, left, top, width, height, first, last):
        self.picture, self.left, self.top, self.width, self.height = picture, left, top, width, height
        self.first, self.last = first, last

    def at(self, x, y):
        low, high = math.log10(LOWEST), math.log10(HIGHEST)
        share = (math.log10(max(y, LOWEST)) - low) / (high - low)
        return (self.left + self.width * (x - self.first) / (self.last - self.first),
                self.top + self.height * (1 - share))

    def frame(self, ticks, label):
        for exponent in range(-6, 2):
            y = self.at(self.first, 10.0 ** exponent)[1]
            self.picture.line([(self.left, y), (self.left + self.width, y)], "#dddddd", 0.8)
            text = f"{10.0 ** exponent:.6f}".rstrip("0").rstrip(".")
            self.picture.text((self.left - 8, y + 4), text, 12, INK, "end")
        for tick in ticks:
            x = self.at(tick, LOWEST)[0]
            self.picture.line([(x, self.top), (x, self.top + self.height)], "#dddddd", 0.8)
            self.picture.text((x, self.top + self.height + 18), f"{tick:g}", 12, INK, "middle")
        self.picture.rectangle(self.left, self.top, self.width, self.height, line_width=1)
        self.picture.text((self.left + self.width / 2, self.top + self.height + 40), label, 13, INK, "middle")
        self.picture.text((self.left - 68, self.top - 14), "worst error, pixels", 13, INK)

    def curve(self, rows, x, y, colour, dash=""):
        """Not drawn across 1, where there is nothing to fit."""
        for side in (lambda v: v < 1, lambda v: v > 1):
            self.picture.line([self.at(row[x], row[y]) for row in rows if side(row[x])], colour, 2, dash)


def there():
    picture = Picture(980, 470, "Residual of ROS's distortion models")
    rows = [row for row in table("lens_fit_there.csv") if row["lens"] == "sweep"]
    plot = Plot(picture, 90, 40, 560, 360, 0.8, 1.32)
    plot.frame([0.8, 0.9, 1.0, 1.1, 1.2, 1.3], "u in the corner: undistorted over distorted radius")
    tolerance = plot.at(0.8, 0.01)[1]
    picture.line([(plot.left, tolerance), (plot.left + plot.width, tolerance)], "#c62828", 1.5, "6 3")
    for column, _, colour in MODELS:
        for share, dash in ((1.0, ""), (0.5, "5 3")):
            plot.curve([row for row in rows if row["share_of_k1"] == share], "u_at_corner", column, colour, dash)
    y = 90
    for _, name, colour in MODELS:
        picture.line([(680, y - 4), (720, y - 4)], colour, 3)
        picture.text((732, y), name, 13)
        y += 28
    for dash, text in (("", "distortion by k1 alone"), ("5 3", "half of it by k2")):
        picture.line([(680, y - 4), (720, y - 4)], GREY, 2, dash)
        picture.text((732, y), text, 13, GREY)
        y += 28
    picture.line([(680, y - 4), (720, y - 4)], "#c62828", 1.5, "6 3")
    picture.text((732, y), "plumb_bob up to here", 13, "#c62828")
    picture.text((680, y + 50), "1920 x 1080 pixels", 12, GREY)
    picture.text((680, y + 70), "chip 9.59 x 5.39 mm", 12, GREY)
    return picture


def back():
    picture = Picture(980, 470, "Residual of the way back from plumb_bob")
    plot = Plot(picture, 90, 40, 560, 360, 0.75, 1.25)
    plot.frame([0.8, 0.9, 1.0, 1.1, 1.2], "distorted over undistorted radius in the corner")
    plot.curve(table("lens_fit_back.csv"), "distorted_over_undistorted", "residual", "#1565c0")
    rows = [row for row in table("lens_fit_there.csv") if row["lens"] == "sweep"]
    for row in rows:
        row["distorted_over_undistorted"] = 1 / row["u_at_corner"]
    for share, dash in ((1.0, ""), (0.5, "5 3")):
        chosen = [row for row in rows if row["share_of_k1"] == share]
        plot.curve(chosen, "distorted_over_undistorted", "there_and_back", "#2e7d32", dash)
    for y, colour, dash, text in ((90, "#1565c0", "", "plumb_bob with k1 alone,"), (146, "#2e7d32", "", "trk to ROS and back,"),
                                  (202, "#2e7d32", "5 3", "the same,")):
        picture.line([(680, y - 4), (720, y - 4)], colour, 3, dash)
        picture.text((732, y), text, 13)
    for y, text in ((112, "as a calibration gives it"), (168, "distortion by k1 alone"), (224, "half of it by k2")):
        picture.text((732, y), text, 13, GREY)
    picture.text((680, 290), "0.000001 stands for all below", 12, GREY)
    return picture
