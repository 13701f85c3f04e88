# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""The modules of the code and what each may use: drawn by modules.py, compared with the code by modules_test.py."""

import typing


class Module(typing.NamedTuple):
    """A folder of src/ and, if it has public headers, of include/trk_bridge/."""
    what: str
    uses: tuple = ()
    # Needs ROS; the other modules build without it.
    ros: bool = False
    # Modules that it uses only in a build with ROS.
    uses_with_ros: tuple = ()


MODULES = {
    "base": Module("counters, times, snapshots"),
    "wire": Module("records and their bytes"),
    "camera": Module("pose, lens, formats", ("wire",)),
    "transport": Module("sources and sinks, sockets", ("base", "wire")),
    "trk": Module("trk over UDP", ("transport", "wire")),
    "lens": Module("lens tables", ("base", "camera", "wire")),
    "freed": Module("Free-D", ("camera", "lens", "transport", "wire")),
    "shm": Module("trk in shared memory", ("base", "transport", "wire")),
    "file": Module("trk in files", ("base", "transport", "wire")),
    "opentrackio": Module("OpenTrackIO over UDP", ("base", "camera", "transport", "wire")),
    "endpoints": Module("URLs, presets",
                        ("base", "file", "freed", "opentrackio", "shm", "transport", "trk", "wire")),
    "c_api": Module("functions of the document", ("base", "file", "shm", "transport", "trk", "wire")),
    "bridge": Module("pipelines, stamps, diagnostics", ("base", "camera", "transport", "wire")),
    "plot": Module("plots as SVG", ("base",)),
    "delay": Module("measures delay of video", ("base", "camera", "plot", "wire")),
    "ros": Module("messages, frames, parameters", ("base", "bridge", "camera", "endpoints", "transport", "wire"), ros=True),
    "nodes": Module("nodes and nodelets", ("base", "bridge", "camera", "delay", "ros", "transport"), ros=True),
    "demo": Module("crane and test card", ("base", "camera", "nodes", "ros", "wire"), ros=True),
    "rviz": Module("the display", ("base", "camera", "ros"), ros=True),
    "cli": Module("shared by programs", ("base", "endpoints", "transport", "wire")),
    "monitor": Module("trk monitor", ("base", "bridge", "camera", "cli", "transport", "wire")),
    "bag": Module("trk bag", ("base", "bridge", "camera", "cli", "delay", "file", "ros", "transport", "wire"), ros=True),
    "tools": Module("trk", ("base", "bridge", "camera", "cli", "endpoints", "lens", "monitor", "plot", "transport", "wire"), uses_with_ros=("bag",)),
    "programs": Module("six test programs", ("base", "c_api", "camera", "cli", "wire")),
}


def used_by(module):
    return MODULES[module].uses + MODULES[module].uses_with_ros


def reachable_from(module):
    """Every module that it uses, directly or indirectly; itself only if there is a cycle."""
    seen, ahead = set(), list(used_by(module))
    while ahead:
        used = ahead.pop()
        if used not in seen:
            seen.add(used)
            ahead.extend(used_by(used))
    return seen


def level_of(module):
    """0 for a module that uses no other, else one more than the highest level that it uses."""
    return 1 + max((level_of(used) for used in used_by(module)), default=-1)


def arrows():
    """Pairs (user, used), without those that follow from others."""
    return [(module, used) for module in MODULES for used in used_by(module)
            if not any(used in reachable_from(other) for other in used_by(module))]
