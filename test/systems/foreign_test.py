#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Processes of another machine and our programs send each other records, exactly.

foreign_test.py --machine NAME --programs FOLDER --trk PROGRAM. In FOLDER are NAME_document and NAME_identified, which foreign.c
became with a compiler for that machine, and native_identified of this one's. Where the kernel does not run them,
qemu's user emulation does. Exits 77, with the reason, where they were not built or cannot be run.
"""

import argparse
import contextlib
import errno
import fcntl
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import unittest

SKIPPED = 77  # SKIP_RETURN_CODE of ctest
DEADLINE = 600  # seconds for a process that has nothing to wait for
GENERATIONS = ("document", "identified")
SLOT_NAMES = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
EULER = 1

# Per machine: qemu's name, the layout in the words of endpoints, the bytes of parameters, constants and segment of each
# generation (doc/wire_formats.md), and whether its shared memory has a layout that our programs know.
MACHINES = {
    "native": (None, "lp64_le", ((200, 56, 528), (200, 64, 544)), True),
    "i386": ("qemu-i386", "i386_le", ((192, 56, 508), (196, 60, 524)), True),
    "powerpc": ("qemu-ppc", "llp64_be", ((200, 56, 528), (200, 64, 544)), False),
    "s390x": ("qemu-s390x", "lp64_be", ((200, 56, 528), (200, 64, 544)), False),
}

PARAMS = ("fov", "center_x", "center_y", "k1", "k2", "focdist", "aperture")
CONSTANTS = ("imageWidth", "imageHeight", "blankLeft", "blankRight", "blankTop", "blankBottom",
             "chipWidth", "chipHeight", "fakeChipWidth", "fakeChipHeight")


def rotation(generator):
    """Of a random axis and angle, as the matrix of a record: column by column."""
    x, y, z = (generator.gauss(0, 1) for _ in range(3))
    length = math.sqrt(x * x + y * y + z * z)
    x, y, z, angle = x / length, y / length, z / length, generator.uniform(0.1, 3)
    c, s = math.cos(angle), math.sin(angle)
    return [c + x * x * (1 - c), y * x * (1 - c) + z * s, z * x * (1 - c) - y * s, 0.0,
            x * y * (1 - c) - z * s, c + y * y * (1 - c), z * y * (1 - c) + x * s, 0.0,
            x * z * (1 - c) + y * s, y * z * (1 - c) - x * s, c + z * z * (1 - c), 0.0,
            *(generator.uniform(-20, 20) for _ in range(3)), 1.0]


def records_of(generation, seed, count=12):
    """Constants, then parameters with Euler angles and matrices by turns: (kind, id, whole numbers and doubles)."""
    generator = random.Random(seed)
    camera = 7 if generation == "identified" else 0
    pixels = [1920, 1080, 14, 2, 12, 4]
    result = [("constants", camera, pixels + [generator.uniform(4, 30) for _ in range(4)])]
    for i in range(count):
        euler = i % 2 == 0
        transform = [generator.uniform(-180, 180) for _ in range(6)] + [0.0] * 10 if euler else rotation(generator)
        lens = [generator.uniform(5, 100), generator.uniform(-1, 1), -0.0, generator.uniform(-1e-3, 1e-3),
                generator.uniform(-1e-6, 1e-6), generator.uniform(1, 50), generator.uniform(1, 22)]
        result.append(("params", camera, [EULER if euler else 0, *transform, *lens, 4_000_000_000 + i]))
    return result


def line_of(record):
    kind, camera, values = record
    return f"{kind} {camera} " + " ".join(v.hex() if isinstance(v, float) else str(v) for v in values) + "\n"


def from_line(line):
    """What foreign prints. Of Euler angles only the six numbers say anything."""
    kind, camera, *words = line.split()
    values = [float.fromhex(word) if "x" in word else int(word) for word in words]
    if kind == "params" and values[0] & EULER:
        values[7:17] = [0.0] * 10
    return kind, int(camera), values


def from_json(line):
    """What trk dump --json prints."""
    o = json.loads(line)
    if o["type"] == "constants":
        return "constants", o["id"], [o[key] for key in CONSTANTS]
    transform = [o["euler"][key] for key in ("x", "y", "z", "pan", "tilt", "roll")] + [0] * 10 if "euler" in o else o["matrix"]
    return "params", o["id"], [o["format"], *transform, *(o[key] for key in PARAMS), o["counter"]]


def bits_of(record):
    """Comparable, with the sign of zeros."""
    kind, camera, values = record
    return kind, camera, [float(value).hex() for value in values]


class Slot:
    """A slot that no other test uses, as test/support/free_slot.h has it."""

    def __init__(self):
        for number in range(60, -1, -1):
            self._lock = open(f"/tmp/trk_bridge_test_slot.{number}", "a", encoding="ascii")
            self.file = pathlib.Path(f"/tmp/dmc_tracking_buffer.{SLOT_NAMES[number]}")
            with contextlib.suppress(OSError):
                fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if not self.file.exists():
                    self.number = number
                    return
            self._lock.close()
        raise RuntimeError("no shared memory slot is free")

    def close(self):
        self._lock.close()


class Process:
    """Lines in, lines out."""

    def __init__(self, words, **environment):
        self._process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                         text=True, env={**os.environ, **environment})

    def write(self, text):
        self._process.stdin.write(text)
        self._process.stdin.flush()

    def line(self):
        return self._process.stdout.readline()

    def port(self):
        """That trk names on its standard error."""
        line = self._process.stderr.readline()
        return re.search(r"udp port (\d+)", line)[1]

    def end(self):
        """Closes its input, or, where it does not read that, interrupts it; and waits."""
        self._process.communicate(timeout=DEADLINE)
        return self._process.returncode

    def stop(self):
        if self._process.poll() is None:
            self._process.terminate()
        self._process.communicate(timeout=DEADLINE)


class Foreign(unittest.TestCase):
    trk = programs = machine = None
    runner = ()

    def setUp(self):
        self.layout, self.sizes = MACHINES[self.machine][1:3]

    def start(self, words, **environment):
        process = Process(words, **environment)
        self.addCleanup(process.stop)
        return process

    def foreign(self, generation, *words, **environment):
        return self.start([*self.runner, self.programs / f"{self.machine}_{generation}", *words], **environment)

    def slot(self):
        if not MACHINES[self.machine][3]:
            self.skipTest("shared memory of another byte order has no layout")
        slot = Slot()
        self.addCleanup(slot.close)
        return slot

    def assert_same(self, got, sent):
        self.assertEqual(bits_of(got), bits_of(sent))

    def test_its_structures_have_the_sizes_of_the_layout(self):
        for generation, sizes in zip(GENERATIONS, self.sizes):
            self.assertEqual(self.foreign(generation, "sizes").line().split(), [str(size) for size in sizes])

    def test_trk_reads_its_datagrams(self):
        for generation in GENERATIONS:
            # Detected, and with every layout that was chosen.
            for layout in ("auto", generation, f"{generation}_{self.layout}"):
                with self.subTest(generation=generation, layout=layout):
                    records = records_of(generation, layout)
                    dump = self.start([self.trk, "dump", f"udp://127.0.0.1:0?layout={layout}", "--json",
                                       "--count", str(len(records))])
                    sender = self.foreign(generation, "send", dump.port())
                    for record in records:
                        sender.write(line_of(record))
                        self.assert_same(from_json(dump.line()), record)

    def test_it_reads_datagrams_of_trk(self):
        for generation in GENERATIONS:
            with self.subTest(generation=generation):
                records = records_of(generation, 5)
                receiver = self.foreign(generation, "receive", COUNT=str(len(records)))
                relay, sender = self.relay_to(f"udp://127.0.0.1:{receiver.line().strip()}"
                                              f"?binary=1&constants_period=0&layout={generation}_{self.layout}")
                for record in records:
                    sender.write(line_of(record))
                    self.assert_same(from_line(receiver.line()), record)
                relay.stop()

    def relay_to(self, sink):
        """trk, and a process of this machine that sends to it."""
        relay = self.start([self.trk, "relay", "udp://127.0.0.1:0", sink])
        return relay, self.start([self.programs / "native_identified", "send", relay.port()])

    def test_trk_reads_its_shared_memory(self):
        slot = self.slot()
        for generation in GENERATIONS:
            with self.subTest(generation=generation):
                records = records_of(generation, 6)
                writer = self.foreign(generation, "write", slot.file)
                self.assertEqual(writer.line(), "open\n")
                # What was written before a reader came is constants alone.
                writer.write(line_of(records[0]))
                writer.line()
                dump = self.start([self.trk, "dump", f"shm:{slot.number}", "--json", "--count", str(len(records))])
                for record in records:
                    if record is not records[0]:
                        writer.write(line_of(record))
                    self.assert_same(from_json(dump.line()), record)
                self.assertEqual(dump.end(), 0)
                self.assertEqual(writer.end(), 0)
                self.assertFalse(slot.file.exists())

    def test_it_reads_shared_memory_of_trk(self):
        slot = self.slot()
        for generation in GENERATIONS:
            with self.subTest(generation=generation):
                records = records_of(generation, 7)
                reader = self.foreign(generation, "read", slot.file, COUNT=str(len(records)))
                relay, sender = self.relay_to(f"shm:{slot.number}?layout={generation}_{self.layout[:-3]}")
                self.assertEqual(reader.line(), "open\n")
                for record in records:
                    sender.write(line_of(record))
                    self.assert_same(from_line(reader.line()), record)
                self.assertEqual(reader.end(), 0)
                relay.stop()
                self.assertFalse(slot.file.exists())


def runner_of(machine, program):
    """What has to stand before the program's name; a text where it cannot be run."""
    if not program.exists():
        return (f"no compiler for {machine} was there when the tests were configured: "
                "scripts/install_deps --with-linters installs all")
    try:
        subprocess.run([program, "sizes"], stdout=subprocess.DEVNULL, check=True)
        return ()
    except OSError as error:
        if error.errno != errno.ENOEXEC:
            raise
    emulator = MACHINES[machine][0]
    if shutil.which(emulator) is None:
        return f"this kernel runs no programs of {machine}, and {emulator} is not installed (package qemu-user)"
    return (emulator,)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--machine", choices=MACHINES, required=True)
    parser.add_argument("--programs", type=pathlib.Path, required=True)
    parser.add_argument("--trk", required=True)
    arguments, rest = parser.parse_known_args()
    runner = runner_of(arguments.machine, arguments.programs / f"{arguments.machine}_document")
    if isinstance(runner, str):
        print(f"skipped: {runner}")
        sys.exit(SKIPPED)
    Foreign.machine, Foreign.programs, Foreign.trk = arguments.machine, arguments.programs, arguments.trk
    Foreign.runner = runner
    print(f"{arguments.machine}: run by {runner[0] if runner else 'this kernel'}")
    unittest.main(argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
