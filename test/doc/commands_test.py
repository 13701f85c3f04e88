#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of all pages as their marks say (see pages.py).

A page is one session from top to bottom: commands find the files, parameters and background processes of earlier commands.
Background processes run until the text says Ctrl-C. Each page has a separate folder, which is also its home, and the address
of a ROS master that is not yet running. stand_ins.py lists what is changed in the commands. Windows open on a virtual
display.
"""

import argparse
import contextlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

import pages
import session
import stand_ins


@contextlib.contextmanager
def invisible_display():
    """The name of a separate X display."""
    read, write = os.pipe()
    try:
        command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"]
        server = subprocess.Popen(command, pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    finally:
        os.close(write)
    try:
        with open(read) as display:
            number = display.readline().strip()
        if not number:
            raise RuntimeError("Xvfb does not start")
        yield f":{number}"
    finally:
        server.terminate()
        server.wait()


def environment_of(build, devel, display):
    """The environment of a terminal after `. build/devel/setup.bash`."""
    basic = {name: value for name, value in os.environ.items() if name in ("LANG", "USER", "LOGNAME", "TERM", "TMPDIR")}
    basic["PATH"] = "/usr/sbin:/usr/bin:/sbin:/bin"
    noetic = pathlib.Path("/opt/ros/noetic/setup.bash")
    setup = f'{f". {noetic} && " if noetic.exists() else ""}. "$0/setup.bash" && env -0'
    entered = subprocess.run(["bash", "-c", setup, str(devel)], env=basic, check=True, stdout=subprocess.PIPE).stdout
    found = dict(entry.split("=", 1) for entry in entered.decode().split("\0") if entry)
    own = {
        "TRK_BRIDGE_BUILD": str(build),
        "DISPLAY": display,
        "LIBGL_ALWAYS_SOFTWARE": "1",
        "ROS_IP": "127.0.0.1",
        # Output to a file is unbuffered, like to a terminal.
        "PYTHONUNBUFFERED": "1",
        "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1",
    }
    return {**found, **own}


def is_scripts_build(root, build):
    """Whether it is a build of the project's scripts, which they may then use."""
    cache = build / "CMakeCache.txt"
    lines = cache.read_text().splitlines() if cache.exists() else []
    return {f"CMAKE_HOME_DIRECTORY:INTERNAL={root}", "CMAKE_GENERATOR:INTERNAL=Ninja"} <= set(lines)


def script_text(path):
    """A script's text, including the scripts of its folder that it sources."""
    text = path.read_text()
    for name in re.findall(r'^\. "\$\(dirname "\$0"\)/([^"]+)"$', text, re.MULTILINE):
        text += (path.parent / name).read_text()
    return text


class Skipped(Exception):
    """Why a block cannot be run here."""


class PageRun:
    """Runs the blocks of one page, one after another."""

    def __init__(self, root, build, environment, folder, logs, table):
        self._root = root
        self._build = build
        self._folder = folder
        self._table = table
        own = {
            "HOME": str(folder),
            "ROS_HOME": str(folder / ".ros"),
            "ROS_MASTER_URI": f"http://127.0.0.1:{stand_ins.free_port()}",
        }
        self.terminals = session.Terminals({**environment, **own}, folder, logs)

    def run(self, block):
        if block.mark is None:
            return
        if block.mark.kind == "Ctrl-C":
            self.terminals.end_all()
            return
        for command in block.commands() if block.is_command() else []:
            unknown = pages.unknown_arguments(command, self._root / "launch")
            if unknown:
                raise session.CommandError(f"the launch file has no argument {', '.join(unknown)}: {command}")
        if block.mark.machine:
            self.terminals.check_syntax(block.text)
            return
        text = stand_ins.replace_all(block.text, self._table)
        if block.mark.kind == "file":
            (self._folder / block.mark.text).write_text(text)
            return
        if re.search(r"\./scripts/|cmake .*build", block.text) and block.mark.kind in ("run", "background"):
            if not is_scripts_build(self._root, self._build):
                raise Skipped("it would build into a workspace's build folder")
        if block.mark.kind == "run":
            self.terminals.run(text, stand_ins.replace_all(block.mark.prints, self._table), block.mark.fails)
        elif block.mark.kind == "background":
            self.terminals.run_in_background(text, stand_ins.replace_all(block.mark.text, self._table))
        elif block.mark.kind == "needs hardware":
            self.terminals.check_syntax(block.text)
        else:
            lacking = pages.has_commands(script_text(self._root / block.mark.text), block.commands())
            if lacking:
                raise session.CommandError(f"{block.mark.text} does not run: {'; '.join(lacking)}")


class Report:
    """Prints the progress, and writes the JUnit file."""

    def __init__(self):
        self.failed = self.skipped = 0
        self._suite = xml.etree.ElementTree.Element("testsuite", name="doc_commands")

    def add(self, page, block, seconds, error):
        name = f"{page}:{block.line} {block.heading}" if block else str(page)
        what = f"  [{block.mark.kind}] {block.commands()[0]}" if block and block.is_command() else ""
        result = "ok" if not error else "skipped" if isinstance(error, Skipped) else "FAILED"
        print(f"{result:7} {seconds:5.1f} s  {name}{what}", flush=True)
        case = xml.etree.ElementTree.SubElement(self._suite, "testcase", classname="doc_commands", name=name,
                                                time=f"{seconds:.3f}")
        if result == "skipped":
            self.skipped += 1
            xml.etree.ElementTree.SubElement(case, "skipped", message=str(error))
        elif error:
            self.failed += 1
            print(error, flush=True)
            text = re.sub(r"[^\t\n\x20-\ud7ff]", "?", str(error))
            xml.etree.ElementTree.SubElement(case, "failure", message=text.splitlines()[0]).text = text

    def write(self, path):
        self._suite.set("tests", str(len(self._suite)))
        self._suite.set("failures", str(self.failed))
        self._suite.set("errors", "0")
        self._suite.set("skipped", str(self.skipped))
        path.parent.mkdir(parents=True, exist_ok=True)
        xml.etree.ElementTree.ElementTree(self._suite).write(path, encoding="utf-8", xml_declaration=True)


def run_page(options, path, environment, report):
    name = os.path.relpath(path, options.root)
    begin = time.monotonic()
    try:
        blocks = pages.blocks_of(path.read_text())
    except pages.PageError as error:
        report.add(name, None, time.monotonic() - begin, f"{name}: {error}")
        return
    if options.section:
        blocks = [block for block in blocks if options.section in block.heading]
    with tempfile.TemporaryDirectory(prefix="trk_bridge_page.") as folder, stand_ins.FreeSlot() as slot:
        home, logs = pathlib.Path(folder, "home"), pathlib.Path(folder, "logs")
        home.mkdir()
        logs.mkdir()
        table = stand_ins.stand_ins(options.root, options.build, slot.number)
        page = PageRun(options.root, options.build, environment, home, logs, table)
        broken = False  # later commands depend on it
        for block in blocks:
            begin, error = time.monotonic(), None
            try:
                if block.mark is not None and block.mark.kind == "Ctrl-C":
                    broken = False
                if broken:
                    raise session.CommandError("not run: an earlier one has failed")
                page.run(block)
            except Skipped as reason:
                error = reason
            except session.CommandError as failure:
                error, broken = failure, True
                with contextlib.suppress(session.CommandError):
                    page.terminals.end_all()
            if block.is_command() or error:
                report.add(name, block, time.monotonic() - begin, error)
        running = page.terminals.running()
        if running and not options.section:
            report.add(name, None, 0, "its text does not say Ctrl-C for background processes: " + "; ".join(running))
        with contextlib.suppress(session.CommandError):
            page.terminals.end_all()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--root", type=pathlib.Path, required=True, help="the repository")
    parser.add_argument("--build", type=pathlib.Path, required=True, help="its build")
    parser.add_argument("--devel", type=pathlib.Path, required=True, help="that build's devel space")
    parser.add_argument("--junit", type=pathlib.Path, help="where results are written to")
    parser.add_argument("--section", help="only sections whose heading contains this")
    parser.add_argument("--all-but", action="store_true", help="all pages but those that are given")
    parser.add_argument("pages", nargs="*", type=pathlib.Path, help="relative to the repository; default: all pages")
    options = parser.parse_args()
    options.root, options.build = options.root.resolve(), options.build.resolve()
    given = [(options.root / page).resolve() for page in options.pages]
    every_page = pages.page_files(options.root)
    for page in given:
        if page not in every_page:
            parser.error(f"{page} is not a page of {options.root}")
    paths = [page for page in every_page if page not in given] if options.all_but else given or every_page

    report = Report()
    with invisible_display() as display:
        environment = environment_of(options.build, options.devel.resolve(), display)
        for path in paths:
            run_page(options, path, environment, report)
    if options.junit:
        report.write(options.junit)
    return 1 if report.failed else 0


if __name__ == "__main__":
    sys.exit(main())
