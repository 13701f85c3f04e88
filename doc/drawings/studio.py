# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Frames and signs in space: studio, camera, optical frame, angles, y-up."""

from . import space
from .svg import GREY, INK, Picture


def frames():
    picture = Picture(980, 400, "Studio, camera and optical frame")
    _studio(picture)
    _on_camera(picture, (535, 225), "camera frame", space.IDENTITY,
               ("x right", "y forward", "z up"), "y is the optical axis", ((0, 0), (0, 0), (0, 0)))
    _on_camera(picture, (785, 225), "camera optical frame", space.CAMERA_R_OPTICAL,
               ("x right", "y down", "z forward"), "as REP 103 has it", ((0, 0), (0, 0), (0, 0)))
    return picture


def _studio(picture):
    viewer = space.Viewer(22, 24, 88, (160, 292))
    left, right, near, far, high = -1.0, 1.6, -0.6, 2.4, 1.8
    picture.area([viewer(p) for p in ((left, far, 0), (right, far, 0), (right, far, high), (left, far, high))],
                 "#e6edf5", GREY)
    picture.area([viewer(p) for p in ((right, near, 0), (right, far, 0), (right, far, high), (right, near, high))],
                 "#dfe6ee", GREY)
    space.draw_ground(picture, viewer, left, right, near, far)
    place = (0.55, 0.5, 1.1)
    pose = space.rotation_of(pan=55, tilt=-8)
    foot = (place[0], place[1], 0)
    picture.line([viewer((0, 0, 0)), viewer((place[0], 0, 0)), viewer(foot), viewer(place)], GREY, 1.2, "4 3")
    space.draw_camera(picture, viewer, pose, place, size=0.6)
    space.draw_axes(picture, viewer, pose, place, ("", "", ""), 0.45)
    space.draw_axes(picture, viewer, space.IDENTITY, (0, 0, 0), ("x", "y", "z"), 0.85)
    picture.text((20, 24), "studio frame", 15, bold=True)
    picture.text((20, 44), "x to the right wall, y to the back wall, z up", 12, GREY)
    picture.text(_moved(viewer(((left + right) / 2, far, high)), -60, 30), "back wall", 12, GREY, "middle")
    picture.text(_moved(viewer((right, (near + far) / 2, high)), 0, 60), "right wall", 12, GREY, "middle")
    picture.text((20, 382), "the camera here: pan +55, tilt -8; (x, y, z) is its centre of projection", 11, GREY)


def _on_camera(picture, at, title, axes, names, below, nudges):
    viewer = space.Viewer(28, 24, 150, at)
    space.draw_camera(picture, viewer, space.IDENTITY)
    space.draw_axes(picture, viewer, axes, (0, 0, 0), names, 0.75, nudges)
    picture.text((at[0], 24), title, 15, anchor="middle", bold=True)
    picture.text((at[0], 44), below, 12, GREY, "middle")


def _moved(point, dx, dy):
    return (point[0] + dx, point[1] + dy)


def signs():
    picture = Picture(980, 400, "Positive pan, tilt and roll")
    _turn(picture, space.Viewer(12, 42, 160, (165, 245)), "pan +30", "to the left (about the vertical axis)",
          lambda a: space.rotation_of(pan=a), 30, (0, 0.95, 0), space.Z_COLOUR, (0, -14))
    _turn(picture, space.Viewer(62, 12, 175, (480, 255)), "tilt +25", "lens upwards (about the camera's x axis)",
          lambda a: space.rotation_of(tilt=a), 25, (0, 0.95, 0), space.X_COLOUR, (0, -16))
    _turn(picture, space.Viewer(0, 14, 290, (815, 190)), "roll +20", "clockwise as the operator sees it",
          lambda a: space.rotation_of(roll=a), 20, (0, -0.85, 0.4), space.Y_COLOUR, (16, 4))
    picture.text((12, 388), "dashed: all angles 0", 12, GREY)
    picture.text((815, 382), "seen from behind the camera", 12, GREY, "middle")
    return picture


def _turn(picture, viewer, title, meaning, rotation_at, degrees, start, colour, nudge):
    centre = viewer.origin[0]
    space.draw_camera(picture, viewer, space.IDENTITY, ghost=True)
    space.draw_camera(picture, viewer, rotation_at(degrees))
    if start[1] > 0:
        for rotation, dash in ((space.IDENTITY, "5 4"), (rotation_at(degrees), "")):
            ray = [viewer((0, 0, 0)), viewer(space.times(rotation, (0, 1.15 * start[1], 0)))]
            picture.line(ray, GREY if dash else INK, 1.5, dash)
    else:
        for rotation, dash in ((space.IDENTITY, "5 4"), (rotation_at(degrees), "")):
            up = [viewer(space.times(rotation, (0, start[1], z))) for z in (0, 1.15 * start[2])]
            picture.line(up, GREY if dash else INK, 1.5, dash)
    way = space.draw_arc(picture, viewer, rotation_at, start, degrees, colour)
    picture.text(_moved(way[-1], *nudge), "+", 22, colour, "middle", bold=True)
    picture.text((centre, 28), title, 16, colour, "middle", bold=True)
    picture.text((centre, 50), meaning, 12, GREY, "middle")


def y_up():
    picture = Picture(980, 350, "z-up and y-up axes")
    a_transposed = space.transposed(space.TO_Y_UP)
    point = (1.0, 0.6, 0.8)
    told = space.times(space.TO_Y_UP, point)
    for at, title, axes, names, values in (
            (100, "studio_z_up", space.IDENTITY, ("x", "y", "z"), point),
            (335, "studio_y_up", a_transposed, ("x", "y", "z"), told)):
        viewer = space.Viewer(24, 24, 110, (at, 200))
        space.draw_ground(picture, viewer, -0.4, 1.4, -0.9, 1.0, 0.2)
        space.draw_axes(picture, viewer, axes, (0, 0, 0), names, 0.75)
        foot = (point[0], point[1], 0)
        picture.line([viewer((0, 0, 0)), viewer((point[0], 0, 0)), viewer(foot), viewer(point)], GREY, 1.2, "4 3")
        picture.dot(viewer(point), 4.5, "#8e24aa")
        numbers = ", ".join(f"{v:g}" for v in values)
        picture.text(_moved(viewer(point), 0, -12), f"({numbers})", 13, "#8e24aa", "middle", bold=True)
        picture.text((at + 15, 28), title, 15, anchor="middle", bold=True)
    for at, title, axes, names, looks in (
            (625, "camera_z_up", space.IDENTITY, ("x", "y", "z"), "looks along +y"),
            (855, "camera_y_up", a_transposed, ("x", "y", "z"), "looks along -z")):
        viewer = space.Viewer(28, 24, 140, (at, 195))
        space.draw_camera(picture, viewer, space.IDENTITY)
        space.draw_axes(picture, viewer, axes, (0, 0, 0), names, 0.7)
        picture.text((at, 28), title, 15, anchor="middle", bold=True)
        picture.text((at, 48), looks, 12, GREY, "middle")
    picture.text((20, 332), "(x, y, z) z-up is (x, z, -y) y-up: the same point, the same camera, other names of the axes",
                 12, GREY)
    return picture
