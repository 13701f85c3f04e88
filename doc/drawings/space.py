# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Things in space: rotations of the camera model, a camera's body, and how a viewer sees them."""

import math

from .svg import GREY, INK

X_COLOUR, Y_COLOUR, Z_COLOUR = "#c62828", "#2e7d32", "#1565c0"

IDENTITY = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
# Rows of A, which takes z-up coordinates to y-up ones: (x, y, z) -> (x, z, -y).
TO_Y_UP = ((1, 0, 0), (0, 0, 1), (0, -1, 0))
# Columns are the optical frame's axes (REP 103) in the camera frame.
CAMERA_R_OPTICAL = ((1, 0, 0), (0, 0, 1), (0, -1, 0))


def transposed(m):
    return tuple(zip(*m))


def times(m, v):
    return tuple(sum(row[i] * v[i] for i in range(3)) for row in m)


def product(a, b):
    return transposed(tuple(times(a, column) for column in transposed(b)))


def added(a, b):
    return tuple(p + q for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def rotation_of(pan=0.0, tilt=0.0, roll=0.0):
    """studio_R_camera = Rz(pan) Rx(tilt) Ry(roll), degrees."""
    (sp, cp), (st, ct), (sr, cr) = ((math.sin(math.radians(a)), math.cos(math.radians(a))) for a in (pan, tilt, roll))
    rz = ((cp, -sp, 0), (sp, cp, 0), (0, 0, 1))
    rx = ((1, 0, 0), (0, ct, -st), (0, st, ct))
    ry = ((cr, 0, sr), (0, 1, 0), (-sr, 0, cr))
    return product(product(rz, rx), ry)


class Viewer:
    """Looks into the studio from far away, turned to the left by `azimuth` and down by `elevation` degrees. `scale` is
    in pixels a metre; the studio's origin is seen at `origin`."""

    def __init__(self, azimuth, elevation, scale, origin):
        self.origin, self.scale = origin, scale
        self.right, self.forward, self.up = transposed(rotation_of(azimuth, -elevation))

    def __call__(self, point):
        return (self.origin[0] + self.scale * dot(point, self.right), self.origin[1] - self.scale * dot(point, self.up))

    def depth(self, point):
        return dot(point, self.forward)


def prism(outline, near, far):
    """Faces of the solid between an outline (x, z; clockwise seen from behind) at y = near and at y = far, each
    anticlockwise seen from outside."""
    front = [(x, far, z) for x, z in outline]
    back = [(x, near, z) for x, z in outline]
    faces = [back[::-1], front]
    for i in range(len(outline)):
        j = (i + 1) % len(outline)
        faces.append([back[i], back[j], front[j], front[i]])
    return faces


def box(left, right, near, far, low, high):
    return prism([(left, low), (left, high), (right, high), (right, low)], near, far)


def circle(radius, count=24):
    return [(radius * math.sin(2 * math.pi * i / count), radius * math.cos(2 * math.pi * i / count))
            for i in range(count)]


# In the camera frame, m. The centre of projection is inside the lens hood.
CAMERA_PARTS = [
    box(-0.16, 0.16, -0.85, -0.25, -0.17, 0.17),
    box(-0.26, -0.16, -0.62, -0.42, 0.02, 0.16),  # the viewfinder, on the operator's left
    box(-0.04, 0.04, -0.75, -0.35, 0.17, 0.24),
    prism(circle(0.12), -0.25, 0.05),
]


def normal(face):
    a = added(face[1], tuple(-c for c in face[0]))
    b = added(face[2], tuple(-c for c in face[1]))
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def draw_camera(picture, viewer, rotation, position=(0, 0, 0), ghost=False, size=1.0):
    """A camera of the pose, solid or only as a faint outline."""

    def placed(point):
        return added(times(rotation, tuple(size * c for c in point)), position)

    parts = [[[placed(p) for p in face] for face in part] for part in CAMERA_PARTS]
    parts.sort(key=lambda part: -sum(viewer.depth(p) for face in part for p in face) / sum(len(f) for f in part))
    for part in parts:
        for face in part:
            outward = normal(face)
            if dot(outward, viewer.forward) >= 0:
                continue
            seen = [viewer(p) for p in face]
            if ghost:
                picture.area(seen, "#ffffff", "#b0b0b0", 1, dash="3 3")
            else:
                light = dot(outward, (-0.4, -0.5, 0.77)) / math.sqrt(dot(outward, outward))
                level = round(165 + 55 * light)
                picture.area(seen, f"#{level:02x}{level:02x}{level + 6:02x}", "#555555", 0.8)


def draw_axes(picture, viewer, rotation, position, names, length=1.0, nudges=((0, 0), (0, 0), (0, 0)), size=14):
    """Axes whose directions are the columns of `rotation`; the farthest from the viewer is drawn first."""
    axes = list(zip(transposed(rotation), (X_COLOUR, Y_COLOUR, Z_COLOUR), names, nudges))
    axes.sort(key=lambda axis: -viewer.depth(axis[0]))
    start = viewer(position)
    for direction, colour, name, nudge in axes:
        end = viewer(added(position, tuple(length * c for c in direction)))
        picture.arrow([start, end], colour, 2.5, 11)
        reach = math.hypot(end[0] - start[0], end[1] - start[1])
        ux, uy = (end[0] - start[0]) / reach, (end[1] - start[1]) / reach
        at = (end[0] + 12 * ux + nudge[0], end[1] + 14 * uy + 5 + nudge[1])
        anchor = "start" if ux > 0.4 else "end" if ux < -0.4 else "middle"
        if name:
            picture.text(at, name, size, colour, anchor, bold=True)
    picture.dot(start, 3.5, INK)


def draw_arc(picture, viewer, rotation_at, start, degrees, colour, steps=24):
    """The way of the point `start` as rotation_at(angle) turns it from 0 to `degrees`, with an arrow head."""
    way = [viewer(times(rotation_at(degrees * i / steps), start)) for i in range(steps + 1)]
    picture.arrow(way, colour, 3, 13)
    return way


def draw_ground(picture, viewer, left, right, near, far, step=0.5):
    corners = [viewer(p) for p in ((left, near, 0), (right, near, 0), (right, far, 0), (left, far, 0))]
    picture.area(corners, "#f1efe9", GREY, 1)
    for i in range(1, round((right - left) / step)):
        picture.line([viewer((left + i * step, near, 0)), viewer((left + i * step, far, 0))], "#d8d4c8", 0.8)
    for i in range(1, round((far - near) / step)):
        picture.line([viewer((left, near + i * step, 0)), viewer((right, near + i * step, 0))], "#d8d4c8", 0.8)
