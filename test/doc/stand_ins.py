# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Replacements in the commands of a page, for resources that a test machine cannot share. Nothing else is changed."""

import contextlib
import ctypes
import dataclasses
import fcntl
import os
import pathlib
import re
import shlex
import socket

_SLOT_NAMES = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"


@dataclasses.dataclass(frozen=True)
class StandIn:
    pattern: str
    replacement: str
    why: str


_reserved_ports = []  # locks, held until this process ends


def free_port():
    """A port below the range of ephemeral ports, free for UDP and TCP, which no other test gets while this process runs
    (test/support/reserved_port.h)."""
    for port in range(20000, 30000):
        with contextlib.ExitStack() as lock, contextlib.suppress(OSError):
            file = lock.enter_context(open(f"/tmp/trk_bridge_test_port.{port}", "a"))
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp, socket.socket() as tcp:
                udp.bind(("", port))
                tcp.bind(("127.0.0.1", port))
            _reserved_ports.append(lock.pop_all())
            return port
    raise RuntimeError("no port of 20000 to 29999 is free")


class FreeSlot:
    """An unused shared memory slot; its file and its segment are removed at the end."""

    def __init__(self):
        # From the end: existing programs use low slots. The locks are those of the unit tests.
        for number in range(61, -1, -1):
            lock = os.open(f"/tmp/trk_bridge_test_slot.{number}", os.O_CREAT | os.O_RDWR | os.O_CLOEXEC, 0o666)
            with contextlib.suppress(BlockingIOError):
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if not self._path_of(number).exists():
                    self.number, self._lock = number, lock
                    return
            os.close(lock)
        raise RuntimeError("no shared memory slot is free")

    @staticmethod
    def _path_of(number):
        return pathlib.Path(f"/tmp/dmc_tracking_buffer.{_SLOT_NAMES[number]}")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        path = self._path_of(self.number)
        if path.exists():
            libc = ctypes.CDLL(None, use_errno=True)
            segment = libc.shmget(libc.ftok(os.fsencode(path), 0), 0, 0)
            if segment >= 0:
                libc.shmctl(segment, 0, None)  # IPC_RMID
            path.unlink()
        os.close(self._lock)


def stand_ins(root, build, slot):
    """The replacements for one page. A fixed port has the same replacement everywhere in the page."""
    build = shlex.quote(str(build))
    ports = [StandIn(rf"\b{port}\b", str(free_port()), "ports that others may use here") for port in range(7000, 7004)]
    return ports + [
        StandIn(r"://:", "://127.0.0.1:", "tests are not reached from outside"),
        StandIn(r"\b(?:192\.0\.2|198\.51\.100|203\.0\.113)\.\d+\b", "127.0.0.1", "stand for the reader's own"),
        StandIn(r"\b239(?:\.\d+){3}\b", "127.0.0.1", "multicast would leave the machine"),
        StandIn(r"\bshm:7\b", f"shm:{slot}", "a slot that others may use on this machine"),
        StandIn(r"\b(read_mem|write_mem) 7\b", rf"\1 {slot}", "the same"),
        StandIn(r"/path/to/trk_bridge\b", shlex.quote(str(root)), "where the reader has the repository"),
        StandIn(r"(?<![\w/.])\./scripts/", shlex.quote(str(root)) + "/scripts/", "commands run in an empty folder"),
        StandIn(r"(?<![\w/.])doc/(?=\w+\.py)", shlex.quote(str(root)) + "/doc/", "commands run in an empty folder"),
        StandIn(r"(?<![\w/.])test/(?=data/|rviz/)", shlex.quote(str(root)) + "/test/", "the same"),
        StandIn(r"(?<![\w/.])build/(?=devel/|doc/)", f"{build}/", "the build that is tested"),
        StandIn(r"(?<=--install )build\b", build, "the same"),
        StandIn(r"(?<=--build )build\b", build, "the same"),
        StandIn(r"(?m)^roscore$", 'roscore -p "${ROS_MASTER_URI##*:}"', "the page's master; roscore ignores ROS_MASTER_URI"),
        # One target is enough: only that catkin finds, configures and builds the package in a workspace is special.
        StandIn(r"(?m)^catkin_make$", "catkin_make trk_bridge_wire", "a complete build takes minutes"),
    ]


def replace_all(text, table):
    for stand_in in table:
        text = re.sub(stand_in.pattern, stand_in.replacement, text)
    return text
