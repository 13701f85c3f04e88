#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Compares an installation with the file lists of the Debian packages, debian/*.install.

packages_test.py --prefix PREFIX --debian FOLDER [--without-ros]. Every installed file must be in exactly one package, and
every pattern of a list must find a file: dh_install refuses a pattern without, and dh_missing a file that nobody claims, but
only when packages are made.
"""

import argparse
import pathlib
import re
import sys

MULTIARCH = "usr/lib/ARCHITECTURE"


def packaged_path(path, without_ros):
    """The path of an installed file in the packages; None for catkin's setup files, which are not packaged."""
    parts = path.parts
    if len(parts) == 1:
        return None
    if parts[0] == "lib" and parts[1] != "trk_bridge" and not parts[1].startswith("python"):
        return "/".join((MULTIARCH, *parts[1:]))
    # Debian's catkin installs these here if the prefix is /usr.
    if parts[:3] == ("share", "trk_bridge", "cmake") and not path.name.endswith("-msg-paths.cmake"):
        return "/".join((MULTIARCH, "cmake/trk_bridge", *parts[3:]))
    # Without ROS, debian/rules moves bin, and adds a link usr/bin/trk.
    if without_ros and parts[0] == "bin":
        return "/".join(("usr/lib/trk_bridge", *parts[1:]))
    return "usr/" + path.as_posix()


def packages_of(control, without_ros):
    """The packages that are built."""
    names = []
    for paragraph in control.split("\n\n"):
        name = re.search(r"^Package: (\S+)$", paragraph, re.MULTILINE)
        if name and not (without_ros and "<!pkg.trk-bridge.noros>" in paragraph):
            names.append(name[1])
    return names


def patterns_of(debian, package, without_ros):
    """The patterns in the list of a package. In a line with several words, the last one is the target folder."""
    lists = [debian / f"{package}.install"]
    if without_ros:
        lists.append(debian / f"{package}.install.noros")
    lines = [line.split() for path in lists if path.exists() for line in path.read_text().splitlines()]
    return [word for words in lines for word in (words[:-1] or words)]


def matcher(pattern):
    """A regular expression for a shell pattern; a folder matches all its contents."""
    return re.compile(re.escape(pattern).replace(r"\*", "[^/]*") + "(/.*)?")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--prefix", type=pathlib.Path, required=True)
    parser.add_argument("--debian", type=pathlib.Path, required=True)
    parser.add_argument("--without-ros", action="store_true")
    arguments = parser.parse_args()

    files = {packaged_path(path.relative_to(arguments.prefix), arguments.without_ros)
             for path in arguments.prefix.rglob("*") if path.is_symlink() or not path.is_dir()} - {None}
    if arguments.without_ros:
        files.add("usr/bin/trk")
    claims = {path: [] for path in files}
    faults = []
    for package in packages_of((arguments.debian / "control").read_text(), arguments.without_ros):
        for pattern in patterns_of(arguments.debian, package, arguments.without_ros):
            found = [path for path in files if matcher(pattern).fullmatch(path)]
            for path in found:
                claims[path].append(package)
            if not found:
                faults.append(f"{package}: {pattern} finds no file")
    for path, packages in sorted(claims.items()):
        if len(packages) != 1:
            faults.append(f"{path} is in {' and '.join(packages) or 'no package'}")
    print("\n".join(faults) or f"{len(files)} files, each in one package")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
