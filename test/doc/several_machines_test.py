#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands that a page shows for several machines, each machine in a separate network namespace.

several_machines_test.py --root REPOSITORY --devel DEVEL [PAGE], by default doc/several_machines.md. The names of machines are
in the marks `run on MACHINE` (pages.py); their addresses are those that they export as ROS_IP. They are connected by a bridge
in another namespace: nothing reaches the networks of this machine, and everything ends with the processes that hold the
namespaces. Variables that a block exports are set in all later blocks of its machine. Exits 77 if namespaces cannot be
created.
"""

import argparse
import contextlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import commands_test
import pages
import session

SKIPPED = 77  # SKIP_RETURN_CODE of ctest
PREFIX = 24  # bits of the common network


class CannotMakeNamespaces(Exception):
    """Why namespaces cannot be created."""


class Namespace:
    """A network namespace that has only a loopback interface, and ends with this process."""

    def __init__(self):
        command = ["setpriv", "--pdeathsig", "KILL", "unshare", "--net", "sleep", "infinity"]
        try:
            self._holder = subprocess.Popen(command, stderr=subprocess.PIPE)
        except OSError as error:
            raise CannotMakeNamespaces(f"setpriv, of util-linux: {error}") from error
        self.pid = self._holder.pid
        if not session.wait_for(lambda: self._is_made() or self._holder.poll() is not None, 60) or not self._is_made():
            self.end()
            raise CannotMakeNamespaces(self._holder.stderr.read().decode().strip() or "unshare does not answer")
        self.ip("link set lo up")

    def _is_made(self):
        with contextlib.suppress(OSError):
            return os.readlink(f"/proc/{self.pid}/ns/net") != os.readlink("/proc/self/ns/net")
        return False

    def enter(self):
        """Prefix of commands that run in this namespace."""
        return ["nsenter", f"--net=/proc/{self.pid}/ns/net"]

    def ip(self, *lines):
        subprocess.run([*self.enter(), "ip", "-batch", "-"], input="\n".join(lines) + "\n", text=True, check=True)

    def end(self):
        self._holder.kill()
        self._holder.wait()


class Machine:
    """A namespace with one network interface, a home, and terminals."""

    def __init__(self, name, address, bridge, number, environment, folder):
        self._namespace = Namespace()
        bridge.ip(f"link add port{number} type veth peer name eth0 netns {self._namespace.pid}",
                  f"link set port{number} master br0 up")
        self._namespace.ip(f"address add {address}/{PREFIX} dev eth0", "link set eth0 up", "route add default dev eth0")
        self.folder, logs = folder / name, folder / f"{name}.logs"
        self.folder.mkdir()
        logs.mkdir()
        self.environment = {**environment, "HOME": str(self.folder), "ROS_HOME": str(self.folder / ".ros")}
        self.terminals = session.Terminals(self.environment, self.folder, logs)
        self._exports = ""

    def run(self, block):
        if all(command.startswith("export ") for command in block.commands()):
            self._exports += block.text
        inside = shlex.join([*self._namespace.enter(), "bash", "-e", "-c", self._exports + block.text])
        if block.mark.kind == "background":
            self.terminals.run_in_background(f"exec {inside}", block.mark.text)
        else:
            self.terminals.run(inside, block.mark.prints, block.mark.fails)

    def end(self):
        with contextlib.suppress(session.CommandError):
            self.terminals.end_all()
        self._namespace.end()


def addresses_of(blocks):
    """Machines and their addresses, in the order of the page."""
    found = {}
    for block in blocks:
        if block.mark is not None and block.mark.machine:
            exported = re.search(r"^export ROS_IP=(\S+)$", block.text, re.MULTILINE)
            if exported:
                found.setdefault(block.mark.machine, exported[1])
            elif block.mark.machine not in found:
                raise pages.PageError(block.line, f"{block.mark.machine} has no ROS_IP yet")
    return found


def nodes_of(launch_file, environment):
    """Nodes and the names of the machines on which a launch file starts them."""
    program = ("import json, sys; from roslaunch.config import load_config_default; "
               "config = load_config_default([sys.argv[1]], None, verbose=False); "
               "print(json.dumps({node.namespace + node.name: node.machine.name for node in config.nodes}))")
    read = subprocess.run([sys.executable, "-c", program, str(launch_file)], env=environment, check=False,
                          stdout=subprocess.PIPE)
    if read.returncode != 0:
        raise session.CommandError(f"roslaunch does not read {launch_file.name}")
    return json.loads(read.stdout.splitlines()[-1])


def check_launch_file(path, environment, machines):
    """A launch file for several machines must start nodes on more than one of them, and on no other."""
    nodes = nodes_of(path, environment)
    print(f"ok      {path.name}: {', '.join(f'{node} on {machine}' for node, machine in nodes.items())}", flush=True)
    if not 2 <= len(set(nodes.values())) or not set(nodes.values()) <= set(machines):
        raise session.CommandError(f"{path.name} starts {nodes}, and the machines are {', '.join(machines)}")


def run_page(blocks, machines):
    for block in blocks:
        if block.mark is None:
            continue
        if block.mark.kind == "Ctrl-C":
            for machine in reversed(machines.values()):
                machine.terminals.end_all()
        elif block.mark.kind == "file":
            for machine in machines.values():
                (machine.folder / block.mark.text).write_text(block.text)
            if block.mark.text.endswith(".launch"):
                check_launch_file(machine.folder / block.mark.text, machine.environment, machines)
        elif block.mark.machine:
            machines[block.mark.machine].run(block)
            print(f"ok      line {block.line} on {block.mark.machine}: {block.commands()[0]}", flush=True)
    running = [command for machine in machines.values() for command in machine.terminals.running()]
    if running:
        raise session.CommandError("its text does not say Ctrl-C for background processes: " + "; ".join(running))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--root", type=pathlib.Path, required=True, help="the repository")
    parser.add_argument("--devel", type=pathlib.Path, required=True, help="the devel space of a build of the repository")
    parser.add_argument("page", nargs="?", type=pathlib.Path, help="default: doc/several_machines.md")
    options = parser.parse_args()
    page = options.page or options.root / "doc" / "several_machines.md"
    blocks = pages.blocks_of(page.read_text())
    addresses = addresses_of(blocks)
    environment = commands_test.environment_of(options.devel.parent, options.devel.resolve(), display="")
    del environment["ROS_IP"]  # set by the page's commands

    with tempfile.TemporaryDirectory(prefix="trk_bridge_machines.") as folder, contextlib.ExitStack() as stack:
        try:
            bridge = Namespace()
            stack.callback(bridge.end)
            bridge.ip("link add br0 type bridge", "link set br0 up")
            machines = {}
            for number, (name, address) in enumerate(addresses.items()):
                machines[name] = Machine(name, address, bridge, number, environment, pathlib.Path(folder))
                stack.callback(machines[name].end)
        except CannotMakeNamespaces as error:
            print(f"skipped: no network namespaces here (root is needed): {error}")
            return SKIPPED
        try:
            run_page(blocks, machines)
        except session.CommandError as error:
            print(f"FAILED  {error}", flush=True)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
