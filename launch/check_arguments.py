#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Refuses arguments that a launch file does not have. roslaunch ignores them, so that camra:=crane1 would do nothing.

In a launch file: <param name="…" command="python3 $(find trk_bridge)/launch/check_arguments.py $(find trk_bridge)/launch/FILE"/>
roslaunch runs the command while it reads the file, and ends with an error if the command fails. The output, which is the name
of the file, becomes the value of the parameter. If FILE is included by another file, or not started by roslaunch, nothing is
checked: roslaunch itself checks the arguments of includes.
"""

import difflib
import pathlib
import sys
import xml.etree.ElementTree


def command_line_of_parent():
    try:
        status = pathlib.Path("/proc/self/stat").read_text(encoding="utf-8")
        parent = status.rsplit(")", 1)[1].split()[1]
        return pathlib.Path("/proc", parent, "cmdline").read_text(encoding="utf-8").split("\0")
    except OSError:
        return []


def given_to(path, words):
    """Names of the given arguments; none if roslaunch was not started with this file."""
    names = [pathlib.Path(word).name for word in words]
    if "roslaunch" not in names:
        return []
    words = words[names.index("roslaunch") + 1:]
    if not any(":=" not in word and pathlib.Path(word).name == path.name for word in words):
        return []
    return [word.split(":=")[0] for word in words if ":=" in word and not word.startswith(("_", "/"))]


def arguments_of(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    names = [arg.get("name") for arg in root.findall("arg") if arg.get("value") is None]
    for include in root.findall("include"):
        if include.get("pass_all_args") == "true":
            names += arguments_of(path.parent / pathlib.Path(include.get("file")).name)
    return names


def main(path):
    known = arguments_of(path)
    unknown = [name for name in given_to(path, command_line_of_parent()) if name not in known]
    for name in unknown:
        nearest = difflib.get_close_matches(name, known, n=1, cutoff=0)
        print(f"{path.name} has no argument {name}; the nearest is {nearest[0]}", file=sys.stderr)
    if unknown:
        print(f"roslaunch --ros-args trk_bridge {path.name} lists all of them", file=sys.stderr)
        return 1
    print(path.name, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
