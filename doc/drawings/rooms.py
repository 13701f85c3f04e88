"""Which room knows which."""

from .svg import GREY, INK, Picture

# Place (left, top), size of the box and what is in it; arrows go from who uses to who is used.
ROOMS = {
    "nodes": ((60, 30), "nodes and nodelets"),
    "rviz": ((270, 30), "the display"),
    "ros": ((165, 120), "messages, frames, stamps"),
    "tools": ((500, 120), "trk, six test programs"),
    "c_api": ((770, 120), "the document's functions"),
    "presets": ((60, 240), "receivers by name"),
    "camera": ((360, 240), "pose, lens, formats"),
    "transport": ((650, 240), "udp, shm, file"),
    "wire": ((360, 345), "records and their bytes"),
}
SIZE = (180, 52)
USES = [("nodes", "ros"), ("rviz", "ros"), ("ros", "presets"), ("ros", "camera"), ("ros", "transport"),
        ("tools", "presets"), ("tools", "camera"), ("tools", "transport"), ("tools", "c_api"), ("c_api", "transport"),
        ("presets", "wire"), ("camera", "wire"), ("transport", "wire")]


def rooms():
    picture = Picture(980, 415, "The rooms and what they use")
    picture.area([(20, 16), (475, 16), (475, 190), (20, 190)], "none", GREY, 1, "6 4")
    picture.text((32, 180), "needs ROS", 12, GREY)
    for user, used in USES:
        _arrow(picture, user, used)
    for name, ((left, top), what) in ROOMS.items():
        picture.rectangle(left, top, *SIZE, fill="#eaf2fb", stroke="#1565c0")
        picture.text((left + SIZE[0] / 2, top + 22), name, 14, INK, "middle", bold=True)
        picture.text((left + SIZE[0] / 2, top + 41), what, 11, GREY, "middle")
    return picture


def _arrow(picture, user, used):
    """From a border to a border, on the line between the middles."""
    (x0, y0), (x1, y1) = (_middle(name) for name in (user, used))
    picture.arrow([_border((x0, y0), (x1, y1)), _border((x1, y1), (x0, y0))], "#555555", 1.5, 9)


def _middle(name):
    left, top = ROOMS[name][0]
    return left + SIZE[0] / 2, top + SIZE[1] / 2


def _border(start, towards):
    dx, dy = towards[0] - start[0], towards[1] - start[1]
    scale = min(SIZE[0] / 2 / abs(dx) if dx else 9e9, SIZE[1] / 2 / abs(dy) if dy else 9e9)
    return start[0] + dx * scale, start[1] + dy * scale
