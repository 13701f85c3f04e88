# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""SVG pictures, written so that equal numbers give equal bytes. Labels that lie on each other are an error."""

import math

FONT = "DejaVu Sans, Verdana, Helvetica, sans-serif"
INK = "#222222"
GREY = "#777777"


def number(value):
    """Two decimals at most; never -0."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def points(sequence):
    return " ".join(f"{number(x)},{number(y)}" for x, y in sequence)


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


class Picture:
    """A white page of `width` by `height` pixels, y down."""

    def __init__(self, width, height, title):
        self.width, self.height, self.title = width, height, title
        self.elements = []
        self.labels = []

    def _style(self, stroke, width, fill, dash, opacity):
        style = f'fill="{fill}" stroke="{stroke}" stroke-width="{number(width)}" stroke-linejoin="round"'
        if dash:
            style += f' stroke-dasharray="{dash}"'
        if opacity < 1:
            style += f' opacity="{number(opacity)}"'
        return style

    def line(self, sequence, stroke=INK, width=1.5, dash="", opacity=1):
        self.elements.append(
            f'<polyline points="{points(sequence)}" {self._style(stroke, width, "none", dash, opacity)}/>')

    def area(self, sequence, fill, stroke="none", width=1, dash="", opacity=1):
        self.elements.append(
            f'<polygon points="{points(sequence)}" {self._style(stroke, width, fill, dash, opacity)}/>')

    def rectangle(self, x, y, width, height, fill="none", stroke=INK, line_width=1.5, dash=""):
        corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
        self.area(corners, fill, stroke, line_width, dash)

    def dot(self, at, radius=3.5, fill=INK, stroke="none"):
        self.elements.append(
            f'<circle cx="{number(at[0])}" cy="{number(at[1])}" r="{number(radius)}" '
            f'{self._style(stroke, 1.5, fill, "", 1)}/>')

    def arrow(self, sequence, stroke=INK, width=2, head=9, dash=""):
        """A line with a head at its last point."""
        (x0, y0), (x1, y1) = sequence[-2], sequence[-1]
        length = math.hypot(x1 - x0, y1 - y0)
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        back = (x1 - head * ux, y1 - head * uy)
        side = 0.4 * head
        self.line(list(sequence[:-1]) + [back], stroke, width, dash)
        self.area([(x1, y1), (back[0] - side * uy, back[1] + side * ux), (back[0] + side * uy, back[1] - side * ux)],
                  stroke)

    def text(self, at, text, size=14, fill=INK, anchor="start", bold=False, italic=False):
        """`at` is on the base line: its start, middle or end."""
        width = 0.6 * size * len(text)
        left = at[0] - {"start": 0, "middle": 0.5, "end": 1}[anchor] * width
        self.labels.append((left, at[1] - 0.75 * size, left + width, at[1] + 0.15 * size, text))
        style = ' font-weight="bold"' if bold else ""
        style += ' font-style="italic"' if italic else ""
        self.elements.append(
            f'<text x="{number(at[0])}" y="{number(at[1])}" font-size="{number(size)}" fill="{fill}" '
            f'text-anchor="{anchor}"{style} paint-order="stroke" stroke="#ffffff" stroke-width="3">'
            f'{escaped(text)}</text>')

    def check(self):
        """Whether every label is on the page and on no other one. Widths are estimates on the safe side."""
        for i, (left, top, right, bottom, text) in enumerate(self.labels):
            if left < 0 or top < 0 or right > self.width or bottom > self.height:
                raise ValueError(f"{self.title}: label '{text}' leaves the page")
            for other in self.labels[i + 1:]:
                if left < other[2] and other[0] < right and top < other[3] and other[1] < bottom:
                    raise ValueError(f"{self.title}: labels '{text}' and '{other[4]}' overlap")

    def svg(self):
        self.check()
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}" '
                f'viewBox="0 0 {self.width} {self.height}" font-family="{FONT}">')
        page = f'<rect width="{self.width}" height="{self.height}" fill="#ffffff"/>'
        return "\n".join([head, f"<title>{escaped(self.title)}</title>", page, *self.elements, "</svg>", ""])
