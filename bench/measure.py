#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Measures the speed of this package compared with other code: each pair in one run, alternating, several rounds.

Prints a table of ratios and writes doc/speed.csv, the table in doc/speed.md, and doc/images/speed.svg.
Needs only Python and the programs of a build with -DTRK_BRIDGE_BENCH=ON.
"""

import argparse
import csv
import json
import os
import pathlib
import platform
import re
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from typing import Optional

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOC = ROOT / "doc"
BEGIN, END = "<!-- measured: written by scripts/bench -->", "<!-- end of what was measured -->"
COLUMNS = ["group", "what", "unit", "ours", "peer", "peer is", "ratio", "least", "most", "aim"]


@dataclass(frozen=True)
class Row:
    """A comparison of two metrics of the same run. The ratio is ours divided by the peer's; aim is None if there is no goal
    for it."""
    group: str
    what: str
    unit: str
    ours: str
    peer: str
    peer_is: str
    aim: Optional[float]


# Google-benchmark programs: their times are in ns. The names are those of the benchmarks.
CODECS = ("wire_bench", [
    Row("codec", f"{verb} ASCII {form}", "ns", f"BM_{name}_{form}{detail}/ours", f"BM_{name}_{form}{detail}/peer",
        function, aim)
    for verb, name, detail, function in (("parse", "parse", "_field_digits", "sscanf"), ("write", "print", "", "sprintf"))
    for form, aim in (("euler", 1 / 8), ("matrix", 1 / 7))
] + [
    Row("codec", "decode binary", "ns", "BM_decode_euler/ours", "BM_decode_euler/peer", "two memcpy of 200 bytes", 4),
    Row("codec", "encode binary", "ns", "BM_encode_euler/ours", "BM_encode_euler/peer", "two memcpy of 200 bytes", 3),
])
FILES = ("file_bench", [
    Row("take", "read a take", "ms", "BM_PlayATake/ours", "BM_PlayATake/peer", "fgets and sscanf", 1),
])
BAGS = ("bag_bench", [
    Row("take", "take to bag", "ms", "BM_TakeToBag/ours", "BM_TakeToBag/peer", "rosbag::Bag", 1),
    Row("take", "bag to take", "ms", "BM_BagToTake/ours", "BM_BagToTake/peer", "rosbag::View, reading alone", None),
])


def end_to_end(direction, topic, rate):
    what = {"in": f"UDP to {topic}", "out": "topic to UDP"}[direction]
    for kind in ("node", "nodelet"):
        key = f"{direction} {kind} {rate} {topic}"
        yield Row("end to end", f"{kind}: {what}, {rate} Hz", "us", f"{key} ours", f"{key} floor", "a bare relay", 1.1)


def run(command, **more):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, text=True, check=False, **more)
    if done.returncode != 0:
        raise SystemExit(f"bench: {command[0]} ended with {done.returncode}")
    return done.stdout


class Programs:
    """The programs of a build."""

    def __init__(self, build):
        self.folder = pathlib.Path(build) / "devel/lib/trk_bridge"

    def path(self, name):
        path = self.folder / name
        if not path.exists():
            raise SystemExit(f"bench: no {path}: build with -DTRK_BRIDGE_BENCH=ON")
        return path

    def google(self, name, rows):
        """Metrics of one round: name and time."""
        wanted = sorted({metric for row in rows for metric in (row.ours, row.peer)})
        pattern = "^(" + "|".join(re.escape(one) for one in wanted) + ")(/real_time)?$"
        text = run([self.path(name), f"--benchmark_filter={pattern}", "--benchmark_format=json",
                    "--benchmark_min_time=0.2"], stderr=subprocess.DEVNULL)
        return {one["name"].replace("/real_time", ""): one["real_time"] for one in json.loads(text)["benchmarks"]}


def free_port(kind):
    with socket.socket(socket.AF_INET, kind) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Master:
    """A private ROS master, from entering to leaving."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        port = free_port(socket.SOCK_STREAM)
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_LOG_DIR=self.folder.name)
        self.process = subprocess.Popen(["roscore", "-p", str(port)], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 30
        while subprocess.run(["rosparam", "list"], capture_output=True, check=False).returncode != 0:
            if time.monotonic() > deadline:
                raise SystemExit("bench: no ROS master within 30 s")
            time.sleep(0.2)
        return self

    def __exit__(self, *_):
        end(self.process)
        self.folder.cleanup()


def end(process):
    process.send_signal(signal.SIGINT)
    process.wait(timeout=30)


class EndToEnd:
    """Latencies through a node or a nodelet, and through a minimal relay in roscpp."""

    def __init__(self, programs, rate, seconds):
        self.programs, self.rate, self.seconds = programs, rate, seconds

    def measure(self, direction, kind, who):
        """Medians of the topics, us."""
        port = free_port(socket.SOCK_DGRAM)
        latency = [self.programs.path("latency"), direction, "--port", port, "--rate", self.rate,
                   "--seconds", self.seconds]
        if kind == "nodelet":
            text = run(latency + ["--nodelet", who], stderr=subprocess.DEVNULL)
        else:
            node = subprocess.Popen(self.node(direction, who, port), stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL)
            try:
                text = run(latency, stderr=subprocess.DEVNULL)
            finally:
                end(node)
        lines = [line.split(",") for line in text.splitlines() if line.count(",") == 4]
        return {f"{direction} {kind} {self.rate} {name} {who}": float(median) for name, median, *_ in lines}

    def node(self, direction, who, port):
        name = "__name:=measured"
        subprocess.run(["rosparam", "delete", "/measured"], capture_output=True, check=False)
        if who == "floor":
            return [str(self.programs.path("floor_relay")), direction, f"_port:={port}", name]
        key, value, program = (("source", f"udp://127.0.0.1:{port}", "trk_to_ros") if direction == "in" else
                               ("sinks", f"[udp://127.0.0.1:{port}]", "ros_to_trk"))
        run(["rosparam", "set", f"/measured/{key}", value])
        return [str(self.programs.path(program)), name]

    def round(self):
        metrics = {}
        for direction in ("in", "out"):
            for kind in ("nodelet", "node"):
                for who in ("ours", "floor"):
                    metrics.update(self.measure(direction, kind, who))
        return metrics

    def rows(self):
        for topic in ("params", "camera_info", "tf"):
            yield from end_to_end("in", topic, self.rate)
        yield from end_to_end("out", "datagram", self.rate)
        nodelet, node = (f"in {kind} {self.rate} params ours" for kind in ("nodelet", "node"))
        yield Row("end to end", f"UDP to params, {self.rate} Hz: nodelet", "us", nodelet, node, "our own node", 0.55)


class SharedMemory:
    """A program that prints its own comparisons."""

    def __init__(self, programs):
        self.programs = programs
        self.found = {}

    def round(self):
        metrics = {}
        for name, ours, peer, unit in csv.reader(run([self.programs.path("shm_bench"), 2, 1]).splitlines()[1:]):
            metrics[f"{name} ours"], metrics[f"{name} peer"] = float(ours), float(peer)
            self.found[name] = unit
        return metrics

    def rows(self):
        for name, unit in self.found.items():
            what, _, measure = name.partition(": ")
            case, _, peer = what.partition(" against ")
            yield Row("shared memory", f"{case}: " + measure.replace("reader", "time of the reader"), unit, f"{name} ours", f"{name} peer", peer, None)


def measured(rounds, rows):
    """Rows of the table from the metrics of all rounds."""
    for row in rows:
        pairs = [(one[row.ours], one[row.peer]) for one in rounds]
        ratios = [ours / peer for ours, peer in pairs if peer > 0] or [float("nan")]
        yield {"group": row.group, "what": row.what, "unit": row.unit,
               "ours": f"{statistics.median(ours for ours, _ in pairs):.4g}",
               "peer": f"{statistics.median(peer for _, peer in pairs):.4g}", "peer is": row.peer_is,
               "ratio": f"{statistics.median(ratios):.3g}", "least": f"{min(ratios):.3g}", "most": f"{max(ratios):.3g}",
               "aim": "" if row.aim is None else f"{row.aim:.3g}"}


def table(rows):
    lines = ["| what | ours | compared with | | ratio | spread | aim |", "|---|---|---|---|---|---|---|"]
    for row in rows:
        lines.append(f"| {row['what']} | {row['ours']} {row['unit']} | {row['peer']} {row['unit']} | {row['peer is']} | "
                     f"{row['ratio']} | {row['least']} to {row['most']} | {row['aim']} |")
    return "\n".join(lines)


def machine():
    model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    compiler = run(["c++", "--version"]).splitlines()[0]
    return (f"{model.group(1) if model else platform.machine()}, {os.cpu_count()} cores, Linux {platform.release()}, "
            f"{compiler}, {time.strftime('%Y-%m-%d')}")


def page_with(text, rows, note):
    """doc/speed.md with the table and the machine between its marks."""
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    return f"{before}{BEGIN}\n{table(rows)}\n\n{note}\n{END}{after}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True, help="the build folder")
    parser.add_argument("--rounds", type=int, default=5, help="how often everything is measured (5)")
    parser.add_argument("--seconds", type=float, default=10, help="of one latency measurement (10)")
    parser.add_argument("--rate", type=int, default=100, help="of sets in latency measurements, Hz (100)")
    parser.add_argument("--only", choices=["codec", "take", "shared memory", "end to end"], help="one group; writes nothing")
    parser.add_argument("--dry-run", action="store_true", help="write nothing to doc")
    options = parser.parse_args()
    if options.rounds < 1:
        parser.error("--rounds: at least 1")

    programs = Programs(options.build)
    google, shared_memory = [CODECS, FILES, BAGS], SharedMemory(programs)
    latencies = EndToEnd(programs, options.rate, options.seconds)

    def wants(group):
        return options.only in (None, group)

    rounds = []
    with Master():
        for number in range(options.rounds):
            print(f"bench: round {number + 1} of {options.rounds}", file=sys.stderr)
            metrics = {}
            for name, rows in google:
                if wants(rows[0].group):
                    metrics.update(programs.google(name, rows))
            if wants("shared memory"):
                metrics.update(shared_memory.round())
            if wants("end to end"):
                metrics.update(latencies.round())
            rounds.append(metrics)

    rows = [row for _, some in google for row in some if wants(row.group)]
    rows += list(shared_memory.rows())
    rows += list(latencies.rows()) if wants("end to end") else []
    rows = list(measured(rounds, rows))
    note = f"Medians of {options.rounds} rounds, the spread of their ratios, on: {machine()}."
    print(f"{table(rows)}\n\n{note}")
    if options.dry_run or options.only:
        return
    with (DOC / "speed.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    page = DOC / "speed.md"
    page.write_text(page_with(page.read_text(encoding="utf-8"), rows, note), encoding="utf-8")
    run([sys.executable, "-B", DOC / "make_drawings.py"])


if __name__ == "__main__":
    main()
