"""The modules of the code and what each may use: drawn by rooms.py, compared with the code by test/doc/rooms_test.py."""

import typing


class Room(typing.NamedTuple):
    """A folder of src/ and, where it has public headers, of include/trk_bridge/."""
    what: str
    uses: tuple = ()
    # Knows ROS; the others build without it.
    ros: bool = False
    # What it uses only in a build with ROS.
    uses_with_ros: tuple = ()


ROOMS = {
    "base": Room("counters, times, snapshots"),
    "wire": Room("records and their bytes"),
    "camera": Room("pose, lens, formats", ("wire",)),
    "transport": Room("sources and sinks, sockets", ("base", "wire")),
    "trk": Room("trk over UDP", ("transport", "wire")),
    "lens": Room("lens tables", ("base", "camera", "wire")),
    "freed": Room("Free-D", ("camera", "lens", "transport", "wire")),
    "shm": Room("trk in shared memory", ("base", "transport", "wire")),
    "file": Room("trk in files", ("base", "transport", "wire")),
    "opentrackio": Room("OpenTrackIO over UDP", ("base", "camera", "transport", "wire")),
    "endpoints": Room("URLs, presets",
                      ("base", "file", "freed", "opentrackio", "shm", "transport", "trk", "wire")),
    "c_api": Room("functions of the document", ("base", "file", "shm", "transport", "trk", "wire")),
    "bridge": Room("pipelines, stamps, diagnostics", ("base", "camera", "transport", "wire")),
    "plot": Room("plots as SVG"),
    "delay": Room("measures delay of video", ("camera", "plot", "wire")),
    "ros": Room("messages, frames, parameters", ("base", "bridge", "camera", "endpoints", "transport", "wire"), ros=True),
    "nodes": Room("nodes and nodelets", ("base", "bridge", "camera", "delay", "ros", "transport"), ros=True),
    "demo": Room("crane and test card", ("camera", "nodes", "ros", "wire"), ros=True),
    "rviz": Room("the display", ("camera", "ros"), ros=True),
    "cli": Room("shared by programs", ("base", "endpoints", "transport", "wire")),
    "monitor": Room("trk monitor", ("base", "bridge", "camera", "cli", "transport", "wire")),
    "bag": Room("trk bag", ("base", "bridge", "camera", "cli", "delay", "file", "ros", "transport", "wire"), ros=True),
    "tools": Room("trk", ("base", "bridge", "camera", "cli", "endpoints", "lens", "monitor", "plot", "transport", "wire"), uses_with_ros=("bag",)),
    "programs": Room("six test programs", ("base", "c_api", "camera", "cli", "wire")),
}


def used_by(room):
    return ROOMS[room].uses + ROOMS[room].uses_with_ros


def reachable_from(room):
    """Every module that it uses, directly or indirectly; itself only where there is a cycle."""
    seen, ahead = set(), list(used_by(room))
    while ahead:
        used = ahead.pop()
        if used not in seen:
            seen.add(used)
            ahead.extend(used_by(used))
    return seen


def floor_of(room):
    """0 for a module that uses none, else one above the highest that it uses."""
    return 1 + max((floor_of(used) for used in used_by(room)), default=-1)


def arrows():
    """(user, used) without those that other dependencies imply."""
    return [(room, used) for room in ROOMS for used in used_by(room)
            if not any(used in reachable_from(other) for other in used_by(room))]
