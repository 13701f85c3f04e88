# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""A sandbox for a test: private networks, shared memory, processes and /tmp.

It consists of namespaces of the kernel, which end with the test, whichever way it ends.
"""

import os
import pathlib
import subprocess
import sys

SKIPPED = 77  # SKIP_RETURN_CODE of ctest
TEMPORARY = pathlib.Path("/tmp")
HOME = TEMPORARY / "home"  # where ROS programs write their logs
_MARK = "TRK_BRIDGE_SANDBOX"
_UNSHARE = ["unshare", "--net", "--ipc", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]


def run(*command, **more):
    return subprocess.run([str(word) for word in command], check=True, text=True, **more)


def ip(*lines):
    run("ip", "-batch", "-", input="\n".join(lines) + "\n")


def add_build_arguments(parser, default):
    """--build and --devel, for enter()."""
    parser.add_argument("--build", type=pathlib.Path, default=default, help="the build whose programs are tested")
    parser.add_argument("--devel", type=pathlib.Path, help="its devel space; default: devel in BUILD")


def enter(options, *kept):
    """Starts this program again in a sandbox, and returns there; then the messages of the devel space can be imported.
    `kept`: folders that stay visible, also below /tmp; apart from them and the build, /tmp is empty. Without the right to
    make namespaces, it ends the program with SKIPPED."""
    options.devel = (options.devel or options.build / "devel").resolve()
    if not options.devel.is_dir():
        sys.exit(f"no {options.devel}: build first, or say --build or --devel")
    kept += (options.build, options.devel)
    if os.environ.get(_MARK) is None:
        probe = subprocess.run([*_UNSHARE, "true"], capture_output=True, text=True, check=False)
        if probe.returncode != 0:
            print(f"skipped: no namespaces here (root is needed): {probe.stderr.strip()}")
            sys.exit(SKIPPED)
        os.environ[_MARK] = "1"
        os.execvp(_UNSHARE[0], [*_UNSHARE, sys.executable, "-B", *sys.argv])
    del os.environ[_MARK]
    _hide_temporary({pathlib.Path(folder).resolve() for folder in kept})
    sys.path += map(str, options.devel.glob("lib/python3*/dist-packages"))
    HOME.mkdir()
    os.environ.update(HOME=str(HOME), ROS_HOME=str(HOME / ".ros"), ROS_IP="127.0.0.1", TMPDIR=str(TEMPORARY))
    os.environ.pop("ROS_HOSTNAME", None)
    # If a URL names no interface, groups are joined on the loopback interface.
    ip("link set lo up multicast on", "route add 224.0.0.0/4 dev lo")


def _hide_temporary(kept):
    outside = pathlib.Path("/mnt")
    run("mount", "--bind", TEMPORARY, outside)
    run("mount", "-t", "tmpfs", "-o", "mode=1777", "none", TEMPORARY)
    # A folder comes before what is in it.
    for folder in sorted(kept):
        if TEMPORARY in folder.parents:
            folder.mkdir(parents=True, exist_ok=True)
            run("mount", "--bind", outside / folder.relative_to(TEMPORARY), folder)
    run("umount", outside)


INTERFACE = "trk0"  # of add_interface()


def add_interface():
    """Adds an interface with an address and a peer, for multicast."""
    ip(f"link add {INTERFACE} type veth peer name far0", f"link set {INTERFACE} up", "link set far0 up",
       f"addr add 10.9.0.1/24 dev {INTERFACE}")


def remove_interface():
    ip(f"link del {INTERFACE}")


def everything():
    """All that a test can leave behind, as a set of texts."""
    return _segments() | _files() | _processes() | _interfaces()


def _segments():
    lines = pathlib.Path("/proc/sysvipc/shm").read_text(encoding="ascii").splitlines()[1:]
    return {f"shared memory segment {line.split()[1]}" for line in lines}


def _files():
    return {f"file {path}" for path in TEMPORARY.iterdir()}


def _processes():
    found = set()
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            line = (process / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace").strip()
        except OSError:
            continue  # it has just ended
        if line and int(process.name) != os.getpid():
            found.add(f"process {line}")
    return found


def _interfaces():
    lines = run("ip", "-o", "link", capture_output=True).stdout.splitlines()
    return {"interface " + line.split(": ")[1].split("@")[0] for line in lines}
