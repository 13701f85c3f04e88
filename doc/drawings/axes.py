# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""A plot's frame: a grid with numbers, and where a point of the data is on the page."""

from .svg import INK


class Axes:
    """A box of the picture, in pixels: `left`, `top`, `width`, `height`. `ticks` are the numbers along x, from its first to
    its last; along y there are four from `lowest` to `highest`, with so many digits behind the point."""

    def __init__(self, picture, box, ticks, lowest, highest, title, digits=0):
        self._left, self._top, self._width, self._height = box
        self._ticks, self._lowest, self._highest = ticks, lowest, highest
        left, top, width, height = box
        for tick in ticks:
            x = self.at(tick, lowest)[0]
            picture.line([(x, top), (x, top + height)], "#dddddd", 0.8)
            picture.text((x, top + height + 16), f"{tick:g}", 11, INK, "middle")
        for step in range(4):
            value = lowest + (highest - lowest) * step / 3
            y = self.at(ticks[0], value)[1]
            picture.line([(left, y), (left + width, y)], "#dddddd", 0.8)
            picture.text((left - 6, y + 4), f"{value:.{digits}f}", 11, INK, "end")
        picture.rectangle(left, top, width, height, line_width=1)
        picture.text((left, top - 10), title, 13, INK)

    def at(self, x, y):
        """What is above or below is drawn at the edge."""
        share = (min(max(y, self._lowest), self._highest) - self._lowest) / (self._highest - self._lowest)
        x = self._left + self._width * (x - self._ticks[0]) / (self._ticks[-1] - self._ticks[0])
        return (x, self._top + self._height * (1 - share))
