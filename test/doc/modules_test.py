#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Checks that modules include exactly what the table doc/drawings/module_table.py allows: modules_test.py [ROOT].

Every folder of src/ must be a module in the table, and every module a folder. Every include of another module must be
declared, and every declared one used. There must be no cycle. Modules without ROS must not include headers of ROS, or of
modules that use ROS.
"""

import pathlib
import re
import sys

DOC = pathlib.Path(__file__).resolve().parents[2] / "doc"
sys.path.insert(0, str(DOC))

from drawings.module_table import MODULES, reachable_from, used_by  # noqa: E402

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
# Folders of headers of the system and of libraries that do not belong to ROS.
WITHOUT_ROS = {"CLI", "Eigen", "arpa", "fast_float", "fmt", "linux", "net", "netinet", "nlohmann", "opencv2",
               "rapidjson", "sys", "tl", "yaml-cpp"}


def modules_on_disk(root):
    return {path.relative_to(root / base).parts[0]
            for base in ("src", "include/trk_bridge")
            for path in (root / base).glob("*/*") if path.suffix in (".h", ".cpp")}


def sources_of(root, module):
    folders = [root / "src" / module, root / "include" / "trk_bridge" / module]
    if module == "c_api":
        folders.append(root / "include" / "trk")
    return sorted(path for folder in folders for path in folder.rglob("*") if path.suffix in (".h", ".cpp"))


def owner_of(root, included):
    """The module of this header; None for a header of another package."""
    first, _, rest = included.partition("/")
    if (root / "include" / included).exists():
        return rest.partition("/")[0] if first == "trk_bridge" else "c_api"
    return first if (root / "src" / included).exists() else None


def is_ros(included):
    folder, slash, _ = included.partition("/")
    return (folder not in WITHOUT_ROS) if slash else included.startswith("XmlRpc")


def faults_of(root):
    on_disk = modules_on_disk(root)
    for module in sorted(on_disk - set(MODULES)):
        yield f"src/{module} is not a module in the table"
    for module in sorted(set(MODULES) - on_disk):
        yield f"the module {module} of the table has no source"
    unknown = {(module, used) for module in MODULES for used in used_by(module) if used not in MODULES}
    if unknown:
        yield from (f"{module} -> {used}: there is no module {used}" for module, used in sorted(unknown))
        return
    for module in MODULES:
        if module in reachable_from(module):
            yield f"{module} uses itself indirectly"
        for used in MODULES[module].uses:
            if MODULES[used].ros and not MODULES[module].ros:
                yield f"{module} is without ROS, but the table allows it to use {used}, which needs ROS"
    for module in sorted(on_disk & set(MODULES)):
        included_modules = {}
        for path in sources_of(root, module):
            for included in INCLUDE.findall(path.read_text(encoding="utf-8")):
                owner = owner_of(root, included)
                if owner is None:
                    beside = path.parent / included
                    if not MODULES[module].ros and not beside.exists() and is_ros(included):
                        yield f"{path.relative_to(root)} includes {included}, but {module} is without ROS"
                elif owner != module:
                    included_modules.setdefault(owner, f"{path.relative_to(root)} includes {included}")
        for used in sorted(set(included_modules) - set(used_by(module))):
            yield f"{module} -> {used} is not in the table: {included_modules[used]}"
        for used in sorted(set(used_by(module)) - set(included_modules)):
            yield f"{module} -> {used} is in the table, but nothing in {module} includes it"


def main(arguments):
    root = pathlib.Path(arguments[0]).resolve() if arguments else DOC.parent
    faults = list(faults_of(root))
    print("\n".join(faults), file=sys.stderr, end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
