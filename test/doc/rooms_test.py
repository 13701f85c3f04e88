#!/usr/bin/env python3
"""Whether the rooms include what the table of doc/drawings/room_table.py allows and nothing else: rooms_test.py [ROOT].

Every folder of src/ is a room of the table and the other way round. What a room includes of another one is declared, and
what is declared is included. No arrow leads back. Rooms without ROS include no header of ROS or of a room that has it.
"""

import pathlib
import re
import sys

DOC = pathlib.Path(__file__).resolve().parents[2] / "doc"
sys.path.insert(0, str(DOC))

from drawings.room_table import ROOMS, reachable_from, used_by  # noqa: E402

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
# Folders of headers that come with the system or with a library that has nothing to do with ROS.
WITHOUT_ROS = {"CLI", "Eigen", "arpa", "fast_float", "fmt", "linux", "net", "netinet", "nlohmann", "opencv2",
               "rapidjson", "sys", "tl", "yaml-cpp"}


def rooms_on_disk(root):
    return {path.relative_to(root / base).parts[0]
            for base in ("src", "include/trk_bridge")
            for path in (root / base).glob("*/*") if path.suffix in (".h", ".cpp")}


def sources_of(root, room):
    folders = [root / "src" / room, root / "include" / "trk_bridge" / room]
    if room == "c_api":
        folders.append(root / "include" / "trk")
    return sorted(path for folder in folders for path in folder.rglob("*") if path.suffix in (".h", ".cpp"))


def owner_of(root, included):
    """The room whose header this is; None for a header of somebody else."""
    first, _, rest = included.partition("/")
    if (root / "include" / included).exists():
        return rest.partition("/")[0] if first == "trk_bridge" else "c_api"
    return first if (root / "src" / included).exists() else None


def is_ros(included):
    folder, slash, _ = included.partition("/")
    return (folder not in WITHOUT_ROS) if slash else included.startswith("XmlRpc")


def faults_of(root):
    on_disk = rooms_on_disk(root)
    for room in sorted(on_disk - set(ROOMS)):
        yield f"src/{room} is no room of the table"
    for room in sorted(set(ROOMS) - on_disk):
        yield f"the table's room {room} has no source"
    unknown = {(room, used) for room in ROOMS for used in used_by(room) if used not in ROOMS}
    if unknown:
        yield from (f"{room} -> {used}: there is no room {used}" for room, used in sorted(unknown))
        return
    for room in ROOMS:
        if room in reachable_from(room):
            yield f"{room} uses itself through others"
        for used in ROOMS[room].uses:
            if ROOMS[used].ros and not ROOMS[room].ros:
                yield f"{room} has no ROS, and the table lets it use {used}, which has"
    for room in sorted(on_disk & set(ROOMS)):
        included_rooms = {}
        for path in sources_of(root, room):
            for included in INCLUDE.findall(path.read_text(encoding="utf-8")):
                owner = owner_of(root, included)
                if owner is None:
                    beside = path.parent / included
                    if not ROOMS[room].ros and not beside.exists() and is_ros(included):
                        yield f"{path.relative_to(root)} includes {included}, and {room} has no ROS"
                elif owner != room:
                    included_rooms.setdefault(owner, f"{path.relative_to(root)} includes {included}")
        for used in sorted(set(included_rooms) - set(used_by(room))):
            yield f"{room} -> {used} is not in the table: {included_rooms[used]}"
        for used in sorted(set(used_by(room)) - set(included_rooms)):
            yield f"{room} -> {used} is in the table, and nothing in {room} includes it"


def main(arguments):
    root = pathlib.Path(arguments[0]).resolve() if arguments else DOC.parent
    faults = list(faults_of(root))
    print("\n".join(faults), file=sys.stderr, end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
