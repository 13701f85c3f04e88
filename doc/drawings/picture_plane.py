# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""What lies in the picture: chip, blanks and pixels, field of view, distortion."""

import math

from .svg import GREY, INK, Picture

AXIS_COLOUR, CHIP_COLOUR, TRK_COLOUR, ROS_COLOUR = "#8e24aa", "#1565c0", "#2e7d32", "#c62828"


class Constants:
    """The document's camera constants: pixels and mm."""

    def __init__(self, image, blanks, chip):
        self.W, self.H = image
        self.bl, self.br, self.bt, self.bb = blanks
        self.w, self.h = chip
        self.mx = (self.W - self.bl - self.br) / self.w
        self.my = (self.H - self.bt - self.bb) / self.h

    def fake_chip(self):
        return self.w * self.W / (self.W - self.bl - self.br), self.h * self.H / (self.H - self.bt - self.bb)

    def trk_pixel(self, chip):
        """From the chip (mm from its centre, y up) to pixels from the image's lower left corner, y up."""
        return (self.mx * chip[0] + self.bl + (self.W - self.bl - self.br) / 2,
                self.my * chip[1] + self.bb + (self.H - self.bt - self.bb) / 2)

    def ros_pixel(self, chip):
        """To pixels from the centre of the top left pixel, y down."""
        x, y = self.trk_pixel(chip)
        return x - 0.5, self.H - y - 0.5


def chip():
    """A picture of very few pixels, so that half a pixel shows."""
    c = Constants((16, 10), (2, 1, 1, 0), (6.5, 4.5))
    shift = (0.75, 0.5)
    picture = Picture(980, 450, "Chip, blanks, centre shift and pixel origins")
    size, left, top = 34, 90, 65

    def at(trk):
        return left + size * trk[0], top + size * (c.H - trk[1])

    def region(x0, y0, x1, y1):
        return [at(p) for p in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]

    picture.area(region(0, 0, c.W, c.H), "#c9c9c9")
    picture.area(region(c.bl, c.bb, c.W - c.br, c.H - c.bt), "#eaf2fb", CHIP_COLOUR, 2.5)
    for i in range(c.W + 1):
        picture.line([at((i, 0)), at((i, c.H))], "#a0a0a0", 0.6)
    for i in range(c.H + 1):
        picture.line([at((0, i)), at((c.W, i))], "#a0a0a0", 0.6)
    picture.area(region(0, 0, c.W, c.H), "none", INK, 1.5)

    centre = (0, 0)
    axis = (-shift[0], -shift[1])
    picture.arrow([at(c.trk_pixel(axis)), at(c.trk_pixel(centre))], AXIS_COLOUR, 2.5, 11)
    picture.dot(at(c.trk_pixel(axis)), 5, AXIS_COLOUR)
    picture.dot(at(c.trk_pixel(centre)), 5, "#ffffff", CHIP_COLOUR)
    x, y = at(c.trk_pixel(axis))
    picture.text((x, y + 24), "optical axis", 13, AXIS_COLOUR, "middle", bold=True)
    x, y = at(c.trk_pixel(centre))
    picture.text((x + 4, y - 12), "centre of the chip", 13, CHIP_COLOUR, "middle", bold=True)

    origin = at((0, 0))
    picture.arrow([origin, at((2.6, 0))], TRK_COLOUR, 3, 12)
    picture.arrow([origin, at((0, 2.6))], TRK_COLOUR, 3, 12)
    picture.dot(origin, 5, TRK_COLOUR)
    picture.text((origin[0] + 45, origin[1] + 22), "x''", 14, TRK_COLOUR, "middle", bold=True)
    picture.text((origin[0] - 16, origin[1] - 60), "y''", 14, TRK_COLOUR, "middle", bold=True)
    picture.text((origin[0] + 75, origin[1] + 22), "trk: the lower left corner", 12, TRK_COLOUR)
    origin = at((0.5, c.H - 0.5))
    picture.arrow([origin, at((3.1, c.H - 0.5))], ROS_COLOUR, 3, 12)
    picture.arrow([origin, at((0.5, c.H - 3.1))], ROS_COLOUR, 3, 12)
    picture.dot(origin, 5, ROS_COLOUR)
    picture.text((origin[0] + 100, origin[1] + 5), "u", 14, ROS_COLOUR, "middle", bold=True)
    picture.text((origin[0], origin[1] + 106), "v", 14, ROS_COLOUR, "middle", bold=True)
    picture.text((origin[0] - 17, origin[1] - 52), "ROS: the centre of the first pixel", 12, ROS_COLOUR)

    _span(picture, at((c.bl, c.H)), at((c.W - c.br, c.H)), -14, f"the chip: {c.w:g} x {c.h:g} mm", CHIP_COLOUR, 120)
    _legend(picture, c, shift)
    return picture


def _span(picture, start, end, offset, text, colour, nudge):
    a, b = (start[0], start[1] + offset), (end[0], end[1] + offset)
    middle = ((a[0] + b[0]) / 2, a[1])
    picture.arrow([middle, a], colour, 1.2, 8)
    picture.arrow([middle, b], colour, 1.2, 8)
    picture.text((middle[0] + nudge, a[1] - 8), text, 13, colour, "middle")


def _legend(picture, c, shift):
    axis = (-shift[0], -shift[1])
    trk, ros = c.trk_pixel(axis), c.ros_pixel(axis)
    fake = c.fake_chip()
    lines = [
        (f"image {c.W} x {c.H} pixels", INK),
        (f"blanks {c.bl} left, {c.br} right, {c.bt} top (grey)", GREY),
        (f"mx = {c.mx:g}, my = {c.my:g} pixels per mm", INK),
        (f"fake chip {fake[0]:g} x {fake[1]:g} mm", INK),
        ("", INK),
        (f"centre shift ({shift[0]:g}, {shift[1]:g}) mm:", AXIS_COLOUR),
        ("from the axis to the chip's centre", AXIS_COLOUR),
        ("", INK),
        ("the optical axis is at", INK),
        (f"x'', y'' = {trk[0]:g}, {trk[1]:g} (trk)", TRK_COLOUR),
        (f"u, v = {ros[0]:g}, {ros[1]:g} (ROS, in K)", ROS_COLOUR),
    ]
    for i, (text, colour) in enumerate(lines):
        if text:
            picture.text((665, 90 + 26 * i), text, 13, colour)


def field_of_view():
    c = Constants((720, 576), (12, 12, 0, 0), (8.8, 6.6))
    d = 8.0
    picture = Picture(980, 400, "Image distance and field of view, from above")
    scale, origin = 34, (300, 350)

    def at(x, y):
        return origin[0] + scale * x, origin[1] - scale * y

    fake = c.fake_chip()[0]
    angle, fake_angle = (2 * math.degrees(math.atan(side / (2 * d))) for side in (c.w, fake))
    picture.area([at(0, 0), at(-c.w / 2, d), at(c.w / 2, d)], "#eaf2fb")
    for side in (-1, 1):
        picture.line([at(0, 0), at(side * c.w / 2 * 1.13, d * 1.13)], CHIP_COLOUR, 1.5)
        picture.line([at(side * c.w / 2, d), at(side * fake / 2, d)], "#9a9a9a", 7)
    picture.line([at(-c.w / 2, d), at(c.w / 2, d)], CHIP_COLOUR, 5)
    picture.arrow([at(0, 0), at(0, d * 1.18)], AXIS_COLOUR, 2, 11)
    picture.text((at(0, d * 1.18)[0] + 12, at(0, d * 1.18)[1] + 10), "optical axis (y)", 13, AXIS_COLOUR)
    picture.dot(at(0, 0), 5)
    picture.text((at(0, 0)[0], at(0, 0)[1] + 26), "centre of projection", 13, INK, "middle")
    radius = 2.2
    arc = [at(radius * math.sin(math.radians(angle * (i / 20 - 0.5))),
              radius * math.cos(math.radians(angle * (i / 20 - 0.5)))) for i in range(21)]
    picture.line(arc, INK, 1.5)
    picture.text(_beside(arc[5], -2, -8), "angle", 13, INK, "middle")
    picture.arrow([at(-6.2, d / 2), at(-6.2, 0)], GREY, 1.2, 8)
    picture.arrow([at(-6.2, d / 2), at(-6.2, d)], GREY, 1.2, 8)
    picture.line([at(-6.4, 0), at(-0.3, 0)], GREY, 0.8, "3 3")
    picture.line([at(-6.4, d), at(-5.0, d)], GREY, 0.8, "3 3")
    picture.text((at(-6.35, 0)[0], at(0, d / 2)[1]), "d", 16, INK, "end", bold=True)
    picture.text((at(2.2, d)[0], at(0, d)[1] - 12), "r", 16, CHIP_COLOUR, "middle", bold=True)
    lines = [
        ("angle = 2 atan(r / 2d)", INK),
        ("d: image distance, mm", INK),
        ("r: width, height or diagonal of the chip, mm", CHIP_COLOUR),
        ("grey: blanks; with ignore_blank, r is the fake chip's", GREY),
        ("", INK),
        (f"here, horizontal: d = {d:g} mm, chip {c.w:g} mm,", INK),
        (f"blanks {c.bl} + {c.br} of {c.W} pixels, fake chip {fake:.4f} mm", INK),
        (f"consider_blank: {angle:.3f} degrees", CHIP_COLOUR),
        (f"ignore_blank: {fake_angle:.3f} degrees", GREY),
    ]
    for i, (text, colour) in enumerate(lines):
        if text:
            picture.text((560, 110 + 26 * i), text, 13, colour)
    return picture


def _beside(point, dx, dy):
    return point[0] + dx, point[1] + dy


def distorted_radius(undistorted, k1, k2):
    """Newton on r (1 + k1 r^2 + k2 r^4) = undistorted; the polynomial must rise as far as that."""
    radius = undistorted
    for _ in range(50):
        square = radius * radius
        slope = 1 + 3 * k1 * square + 5 * k2 * square * square
        if slope <= 0:
            raise ValueError("the lens folds")
        radius -= (radius * (1 + square * (k1 + square * k2)) - undistorted) / slope
    return radius


def distortion():
    picture = Picture(980, 330, "Signs of k1 and of the centre shift")
    for centre, k1, shift, title, meaning in (
            (170, 0.006, (0, 0), "k1 > 0: barrel", "points are nearer to the axis than a pinhole's"),
            (490, -0.003, (0, 0), "k1 < 0: pincushion", "points are farther from the axis"),
            (810, 0.006, (0.9, 0.5), "k1 > 0, shift (+, +)", "bent about the axis (violet)")):
        _bent_grid(picture, centre, 165, k1, shift)
        picture.text((centre, 28), title, 15, anchor="middle", bold=True)
        picture.text((centre, 312), meaning, 12, GREY, "middle")
    return picture


def _bent_grid(picture, x, y, k1, shift):
    half_width, half_height, scale = 4.4, 3.3, 29

    def at(undistorted):
        """A pinhole's point on the chip, as the lens shows it."""
        px, py = undistorted[0] + shift[0], undistorted[1] + shift[1]
        radius = math.hypot(px, py)
        ratio = distorted_radius(radius, k1, 0) / radius if radius else 1
        return x + scale * (px * ratio - shift[0]), y - scale * (py * ratio - shift[1])

    chip_corners = [(x + sx * scale * half_width, y + sy * scale * half_height)
                    for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    picture.area(chip_corners, "#eaf2fb", CHIP_COLOUR, 1.5, "4 3")
    steps = [i / 24 for i in range(-24, 25)]
    for i in range(-4, 5):
        picture.line([at((half_width * i / 4, half_height * t)) for t in steps], INK, 1.1)
        picture.line([at((half_width * t, half_height * i / 4)) for t in steps], INK, 1.1)
    picture.dot((x - scale * shift[0], y + scale * shift[1]), 5, AXIS_COLOUR)
    picture.dot((x, y), 4, "#ffffff", CHIP_COLOUR)
