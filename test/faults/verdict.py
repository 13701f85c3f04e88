# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Judges the samples of a soak: a table and a plot."""

import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "doc"))
from drawings.axes import Axes  # noqa: E402
from drawings.svg import INK, Picture  # noqa: E402

WARM_UP = 0.15  # of the time, while caches fill
# How much a quantity may grow: a share of its first value, or the second number if that is more.
ALLOWED = {"rss": (0.02, 1.0), "pss": (0.02, 1.0), "descriptors": (0, 0.5), "threads": (0, 0.5), "latency": (0.5, 3.0)}
UNITS = {"rss": "MiB", "pss": "MiB", "descriptors": "", "threads": "", "latency": "ms"}
COLOURS = ("#1565c0", "#ef6c00", "#2e7d32", "#8e24aa", "#c62828")


def slope(points):
    """The median of the slopes between all pairs, which outliers do not change."""
    slopes = [(b[1] - a[1]) / (b[0] - a[0]) for i, a in enumerate(points) for b in points[i + 1:]]
    return statistics.median(slopes) if slopes else 0.0


def series(rows, key):
    return [(row["time"], row[key]) for row in rows if not math.isnan(row[key])]


def classify(rows):
    """Rows of the table, and whether all is flat. Growth is slope times duration."""
    lines, all_flat = [("quantity", "begin", "end", "slope", "growth", "allowed", "verdict")], True
    counted = [row for row in rows if row["time"] >= WARM_UP * rows[-1]["time"]]
    for key in rows[0]:
        kind = key.split()[0]
        if kind not in ALLOWED and kind != "load":
            continue
        points = series(counted, key)
        part = max(1, len(points) // 5)
        begin, end = (statistics.median(value for _, value in some) for some in (points[:part], points[-part:]))
        per_second = slope(points)
        growth = per_second * (points[-1][0] - points[0][0])
        if kind == "load":
            lines.append(("load of the machine", f"{begin:.2f}", f"{end:.2f}", "", "", "", ""))
            continue
        share, least = ALLOWED[kind]
        allowed = max(share * begin, least)
        is_flat = growth <= allowed and end - begin <= allowed
        all_flat = all_flat and is_flat
        unit = UNITS[kind]
        lines.append((f"{key} ({unit})" if unit else key, f"{begin:.2f}", f"{end:.2f}", f"{3600 * per_second:+.2f}/h",
                      f"{growth:+.2f}", f"{allowed:.2f}", "flat" if is_flat else "NOT flat"))
    return lines, all_flat


def stopped(rows):
    """Cameras that sent nothing in two consecutive samples or in the last one."""
    for key in rows[0]:
        if key.startswith("rate "):
            rates = [row[key] for row in rows]
            if rates[-1] == 0 or any(a == b == 0 for a, b in zip(rates, rates[1:])):
                yield f"{key[5:]} stopped"


def plot(rows):
    """An SVG picture."""
    panels = [("memory (PSS)", "MiB", "pss "), ("descriptors", "", "descriptors "), ("threads", "", "threads "),
              ("latency", "ms", "latency "), ("sets a second, of each camera", "Hz", "rate "),
              ("load of the machine", "", "load")]
    picture = Picture(960, 40 + 220 * len(panels), "Soak")
    last = max(1.0, rows[-1]["time"] / 60)
    step = max(1, round(last / 10))
    ticks = [*range(0, math.ceil(last / step) * step + 1, step)]
    for index, (title, unit, prefix) in enumerate(panels):
        keys = [key for key in rows[0] if key.startswith(prefix)]
        top = max(value for key in keys for _, value in series(rows, key)) or 1
        box = (70, 40 + 220 * index, 640, 150)
        axes = Axes(picture, box, ticks, 0, 1.1 * top, f"{title} {f'({unit})' if unit else ''}, over minutes", 1)
        for number, key in enumerate(keys):
            colour = COLOURS[number % len(COLOURS)]
            picture.line([axes.at(time / 60, value) for time, value in series(rows, key)], colour, 1.2)
            if len(keys) <= len(COLOURS):
                picture.text((725, box[1] + 14 + 18 * number), key[len(prefix):], 12, colour)
    picture.text((70, picture.height - 8), f"{len(rows)} samples", 11, INK)
    return picture.svg()
