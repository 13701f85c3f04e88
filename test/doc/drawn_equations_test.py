#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Checks the equations of the drawings with the 256 worked cases."""

import json
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "doc"))

from drawings import picture_plane, space  # noqa: E402

EULER, STUDIO_TO_CAMERA, CAMERA_Y_UP, STUDIO_Y_UP, FIELD_OF_VIEW = 0x001, 0x002, 0x004, 0x008, 0x010
VERTICAL, DIAGONAL, IGNORE_BLANK, KEEP_ASPECT = 0x020, 0x040, 0x080, 0x100


def is_near(actual, expected, tolerance=1e-9):
    return all(abs(a - b) <= tolerance * max(1, abs(b)) for a, b in zip(actual, expected, strict=True))


def sender_matrix(mask, rotation, position):
    """Rows of the sender's matrix without the last one."""
    studio = space.TO_Y_UP if mask & STUDIO_Y_UP else space.IDENTITY
    camera = space.TO_Y_UP if mask & CAMERA_Y_UP else space.IDENTITY
    linear = space.product(space.product(studio, rotation), space.transposed(camera))
    translation = space.times(studio, position)
    if mask & STUDIO_TO_CAMERA:
        linear = space.transposed(linear)
        translation = tuple(-c for c in space.times(linear, translation))
    return linear, translation


def check_pose(case):
    rows = case["expect"]["studio_T_camera_rows"]
    angles = case["expect"]["euler"]
    rotation = space.rotation_of(angles["pan"], angles["tilt"], angles["roll"])
    yield "rotation", is_near(sum(rotation, ()), rows[0:3] + rows[4:7] + rows[8:11])
    if case["mask"] & EULER:
        return
    linear, translation = sender_matrix(case["mask"], rotation, (rows[3], rows[7], rows[11]))
    columns = case["params"]["matrix_columns"]
    actual = [value for column in (*space.transposed(linear), translation) for value in column]
    yield "matrix of the format", is_near(actual, [columns[4 * j + i] for j in range(4) for i in range(3)], 1e-8)


def check_chip(case):
    given, expect = case["constants"], case["expect"]
    constants = picture_plane.Constants(
        (given["imageWidth"], given["imageHeight"]),
        (given["blankLeft"], given["blankRight"], given["blankTop"], given["blankBottom"]),
        (given["chipWidth"], given["chipHeight"]))
    d, (cx, cy) = expect["image_distance_mm"], expect["center_shift_mm"]
    yield "K", is_near([constants.mx * d, constants.my * d, *constants.ros_pixel((-cx, -cy))],
                       [expect["K"][i] for i in (0, 4, 2, 5)])
    for point in expect["points"]:
        x, y, z = point["camera"]
        seen = (d * x / y - cx, d * z / y - cy)
        yield "pinhole's pixel", is_near(constants.ros_pixel(seen), point["pixel_pinhole"])
        radius = math.hypot(seen[0] + cx, seen[1] + cy)
        ratio = picture_plane.distorted_radius(radius, case["params"]["k1"], case["params"]["k2"]) / radius
        bent = ((seen[0] + cx) * ratio - cx, (seen[1] + cy) * ratio - cy)
        yield "distorted pixel", is_near(constants.ros_pixel(bent), point["pixel_distorted"], 1e-7)
    if case["mask"] & FIELD_OF_VIEW:
        width, height = constants.w, constants.h
        if case["mask"] & IGNORE_BLANK:
            fake = constants.fake_chip()
            width, height = fake[0], height * fake[0] / width if case["mask"] & KEEP_ASPECT else fake[1]
        side = height if case["mask"] & VERTICAL else math.hypot(width, height) if case["mask"] & DIAGONAL else width
        yield "angle", is_near([2 * math.degrees(math.atan(side / (2 * d)))], [case["params"]["fov"]], 1e-6)


def main():
    cases = (ROOT / "test" / "data" / "camera_cases.jsonl").read_text(encoding="utf-8").splitlines()
    checks = 0
    faults = []
    for number, line in enumerate(cases):
        case = json.loads(line)
        for check in (check_pose, check_chip):
            for what, holds in check(case):
                checks += 1
                if not holds:
                    faults.append(f"case {number} (mask {case['mask']:#x}): {what}")
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{checks} checks over {len(cases)} cases")
    return 1 if faults or checks < 256 * 14 else 0


if __name__ == "__main__":
    sys.exit(main())
