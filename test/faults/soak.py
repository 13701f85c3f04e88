#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""16 cameras at 120 Hz over all endpoints and protocols into ROS and out again, with faults from time to time. Checks what
arrives, and that memory, descriptors, threads and latency do not grow (doc/faults.md)."""

import argparse
import contextlib
import os
import pathlib
import random
import statistics
import sys
import tempfile
import threading
import time
import traceback
from dataclasses import dataclass

import sandbox
import verdict
from faults import ROOT, aligned
from processes import free_port, wait_for, wait_until_still
from sets import FREE_D_ERROR, Arrivals
from trackers import Tracker

RATE = 120  # Hz
PERIOD = 10  # s, of samples
GROUP = "udp://239.9.9.9:7000?interface=" + sandbox.INTERFACE
FREE_D = "freed://127.0.0.1:{port}?lens={lens}"


@dataclass(frozen=True)
class Way:
    """A transport into ROS. `{port}`, `{lens}` and `{folder}` in URLs are replaced."""
    cameras: tuple  # ids
    node: str  # that reads
    sink: str  # of the relay behind the tracker; empty: there is none
    source: str


WAYS = {
    "ascii": Way((1, 2, 3, 4), "network", "", "udp://127.0.0.1:{port}"),
    "binary": Way((5, 6), "network", "udp://127.0.0.1:{port}?binary=1", "udp://127.0.0.1:{port}"),
    "multicast": Way((7, 8), "network", GROUP, GROUP),
    "opentrackio": Way((9, 10), "network", "opentrackio://127.0.0.1:{port}?encoding=cbor", "opentrackio://127.0.0.1:{port}"),
    "freed": Way((11, 12), "network", FREE_D, FREE_D),
    "shm1": Way((13,), "local", "shm:1", "shm:1"),
    "shm2": Way((14,), "local", "shm:2", "shm:2"),
    "fifo1": Way((15,), "local", "file:{folder}/fifo1", "file:{folder}/fifo1?speed=0&time=now"),
    "fifo2": Way((16,), "local", "file:{folder}/fifo2", "file:{folder}/fifo2?speed=0&time=now"),
}


class Ages:
    """The age of messages when they arrive: s since their stamp, which is the time of receipt."""

    def __init__(self):
        self._ages, self._lock = [], threading.Lock()

    def add(self, stamp):
        age = time.time() - stamp
        with self._lock:
            self._ages.append(age)

    def take(self):
        with self._lock:
            taken, self._ages = self._ages, []
        return sorted(taken)


class Studio(contextlib.ExitStack):
    """All processes: tracker, relays, nodes and receivers."""

    def __init__(self, testbed):
        super().__init__()
        from ros_side import Listener  # needs ROS

        self.testbed = testbed
        programs, log, folder = testbed.programs, testbed.log, testbed.new_folder()
        sandbox.add_interface()
        self.callback(sandbox.remove_interface)
        os.mkfifo(folder / "fifo1")
        os.mkfifo(folder / "fifo2")
        self.entrance, self._sinks = {}, {}
        cameras, targets = {"network": {}, "local": {}}, []
        self.ages, self.arrivals, self._listeners = Ages(), {}, []
        for name, way in WAYS.items():
            filled_in = {"port": free_port(), "lens": testbed.lens, "folder": folder}
            self.entrance[name] = free_port() if way.sink else filled_in["port"]
            self._sinks[name] = way.sink.format(**filled_in)
            for number in way.cameras:
                camera = f"camera{number}"
                cameras[way.node][camera] = {"id": number, "source": way.source.format(**filled_in)}
                targets.append(f"{self.entrance[name]}:{number}")
                is_freed = name == "freed"
                one = self.arrivals[camera] = Arrivals(number, not is_freed, FREE_D_ERROR if is_freed else None)
                self._listeners.append(Listener(f"/{way.node}/{camera}/params", self._taking(one)))
        self.nodes = {}
        for node, its_cameras in cameras.items():
            testbed.set_parameters(f"/{node}/trk_to_ros", stamp="arrival", cameras=its_cameras)
            self.nodes[node] = programs.node("trk_to_ros", f"/{node}/trk_to_ros", log(node))
        out, self.arrivals["back"] = free_port(), Arrivals(1)
        testbed.set_parameters("/network/camera1/ros_to_trk", sinks=[f"udp://127.0.0.1:{out}", "shm:3"])
        self.nodes["out"] = programs.node("ros_to_trk", "/network/camera1/ros_to_trk", log("out"))
        self.nodes["dump"] = programs.dump(f"udp://127.0.0.1:{out}", self.arrivals["back"], log("dump"))
        self.relays = {}
        for name, sink in self._sinks.items():
            if sink:
                self.start_relay(name)
        self._sent = []
        self.tracker = programs.tracker(RATE, 1, targets, log("tracker"), self._sent.append)

    def _taking(self, arrivals):
        def take(camera, counter, found, stamp):
            self.ages.add(stamp)
            arrivals.add(camera, counter, found)
        return take

    def start_relay(self, way):
        self.relays[way] = self.testbed.programs.relay(f"udp://127.0.0.1:{self.entrance[way]}", self._sinks[way],
                                                          log=self.testbed.log(way))

    def counts(self):
        return {name: one.count for name, one in self.arrivals.items()}

    def end(self):
        """In order. What is wrong."""
        self.tracker.end()
        wait_until_still(self.counts, 2)
        wrong = []
        for relay in self.relays.values():
            relay.end()  # it fails where the interface was gone
        for name, process in self.nodes.items():
            if process.end() != 0:
                wrong.append(f"{name} ended with {process.code()}: {process.output()[-500:]}")
        for listener in self._listeners:
            listener.close()
        sent = int(self._sent[0])
        for name, one in self.arrivals.items():
            wrong += [f"{name}: {text}" for text in one.wrong]
            if one.newest.get(1, 0) > sent:
                wrong.append(f"{name}: {one.newest} came, {sent} were sent")
        return wrong, sent

    def kill_all(self):
        for process in [*self.relays.values(), *self.nodes.values(), self.tracker]:
            process.kill()


def kill_relay(studio, rng):
    # The reader of a take ends when the writer dies.
    way = rng.choice([way for way in studio.relays if not way.startswith("fifo")])
    studio.relays[way].kill()
    time.sleep(rng.random())
    studio.start_relay(way)
    return f"kill -9 of the relay of {way}"


def stop_relay(studio, rng):
    way = rng.choice(list(studio.relays))
    studio.relays[way].pause(rng.random())
    return f"the relay of {way} is stopped for a moment"


def send_flood(studio, rng):
    testbed, printed = studio.testbed, []
    testbed.programs.flood(studio.entrance["ascii"], 100000, 2, rng.randrange(1000), testbed.log("flood"),
                                printed.append).wait()
    return f"{printed[0].split()[0]} random datagrams"


def recreate_interface(_, rng):
    sandbox.remove_interface()
    time.sleep(rng.random())
    sandbox.add_interface()
    return "the interface of the group is recreated"


def second_sender(studio, rng):
    tracker = Tracker([(studio.entrance["ascii"], rng.choice(WAYS["ascii"].cameras))], RATE, 2)
    time.sleep(2)
    tracker.stop()
    return "a second sender of a camera"


FAULTS = (kill_relay, stop_relay, send_flood, recreate_interface, second_sender)


def disturb(studio, rng, ends, done):
    while not ends.wait(rng.uniform(15, 25)):
        try:
            done.append(rng.choice(FAULTS)(studio, rng))
        except Exception as error:  # the soak goes on, and fails at its end
            traceback.print_exc()
            done.append(f"FAILED: {error}")


def run(studio, minutes, rng, on_sample):
    """Samples until the end. Returns the faults that were made."""
    ends, done = threading.Event(), []
    disturber = threading.Thread(target=disturb, args=(studio, rng, ends, done), daemon=True)
    disturber.start()
    begin = last = time.monotonic()
    before = studio.counts()
    studio.ages.take()
    while last - begin < 60 * minutes:
        time.sleep(max(0.0, last + PERIOD - time.monotonic()))
        now, counts, ages = time.monotonic(), studio.counts(), studio.ages.take()
        row = {"time": now - begin, "load": os.getloadavg()[0]}
        for name, count in counts.items():
            row[f"rate {name}"] = (count - before[name]) / (now - last)
        # Milliseconds. A sample without messages is checked at the end.
        row["latency median"] = 1e3 * statistics.median(ages) if ages else float("nan")
        row["latency 99 %"] = 1e3 * ages[len(ages) * 99 // 100] if ages else float("nan")
        for name, process in studio.nodes.items():
            row.update({f"{key} {name}": value for key, value in process.usage().items()})
        # If the test itself was stopped, its sample says nothing about the programs.
        if now - last < 1.5 * PERIOD:
            on_sample(row)
        last, before = now, counts
    ends.set()
    disturber.join()
    return done


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("minutes", metavar="MINUTES", type=float)
    sandbox.add_build_arguments(parser, ROOT / "build")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/soak", help="folder of the table, CSV and plot")
    parser.add_argument("--seed", type=int, help="of the faults; default: another one each time")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    sandbox.enter(options, ROOT, options.out)
    # They import ROS, which --help does not need.
    from testbed import Testbed

    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(1 << 32)
    print(f"seed {seed}", flush=True)
    rows = []
    with tempfile.TemporaryDirectory() as folder, (options.out / "soak.csv").open("w", encoding="utf-8") as file:
        testbed = Testbed(options.devel, ROOT, pathlib.Path(folder))

        def on_sample(row):
            if not rows:
                print(",".join(row), file=file)
            rows.append(row)
            print(",".join(f"{value:.3f}" for value in row.values()), file=file, flush=True)

        left = []
        with testbed.leaving_nothing(left):
            with Studio(testbed) as studio:
                try:
                    wait_for(lambda: all(studio.counts().values()), f"every camera arrives; now {studio.counts()}")
                    done = run(studio, options.minutes, random.Random(seed), on_sample)
                    wrong, sent = studio.end()
                finally:
                    studio.kill_all()
        wrong += left + [fault for fault in done if fault.startswith("FAILED")]
    if len(rows) < 6:
        print(f"{len(rows)} samples are too few: give it a minute or more")
        return 1
    lines, is_flat = verdict.classify(rows)
    arrived = sum(studio.counts().values())
    wrong += verdict.stopped(rows)
    summary = (f"{options.minutes:g} minutes, {len(rows)} samples, {len(done)} faults; {sent} sets of each of 16 cameras "
               f"were sent; {arrived} arrived in all, with the camera that is sent out again counted twice")
    text = "\n".join([summary, *aligned(lines, left=(0, -1)), *(f"wrong: {one}" for one in wrong)])
    (options.out / "soak.txt").write_text(text + "\n", encoding="utf-8")
    (options.out / "soak.svg").write_text(verdict.plot(rows), encoding="utf-8")
    print(text)
    is_good = is_flat and not wrong
    print("flat" if is_good else "NOT flat, or wrong")
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
