# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""kill -9 of every process between a tracker and its receivers, at random moments, over one transport."""

import contextlib
import os
import sys
import time

import sets
from testbed import Result
from processes import Failure, free_port, wait_for, wait_until_still
from ros_side import Listener
from trackers import Tracker


class Places:
    """Endpoints of a transport, as pairs: the URL of a sink, and of the source that reads from it."""

    def __init__(self, transport, folder):
        self._transport, self._folder, self._count = transport, folder, 0

    def next(self):
        self._count += 1
        if self._transport == "udp":
            url = f"udp://127.0.0.1:{free_port()}"
            return url, url
        if self._transport == "shm":
            return f"shm:{self._count}", f"shm:{self._count}"
        path = f"{self._folder}/fifo{self._count}"
        os.mkfifo(path)
        return f"file:{path}", f"file:{path}?speed=0&time=now&lenient=1"


class Chain(contextlib.AbstractContextManager):
    """tracker -> writer -> relay -> reader, and relay -> trk_to_ros -> ros_to_trk -> receiver; all arrows except the
    first and the topic use the transport. What arrives is checked at the reader, on the topic and at the receiver."""

    def __init__(self, testbed, transport):
        self._testbed, self._transport = testbed, transport
        self._folder = testbed.new_folder()
        places = Places(transport, self._folder)
        to_relay, of_writer = places.next()
        to_reader, of_relay = places.next()
        to_node, of_node_relay = places.next()
        to_receiver, of_ros = places.next()
        port, name = free_port(), testbed.next_name()
        self._node_status = f"{name}/trk_to_ros: {name}"
        self.arrivals = {where: sets.Arrivals(1) for where in ("reader", "topic", "receiver")}
        programs, log = testbed.programs, testbed.log
        testbed.set_parameters(f"/{name}/trk_to_ros", source=of_node_relay)
        testbed.set_parameters(f"/{name}/ros_to_trk", sinks=[to_receiver])
        self._starts = {
            "writer": lambda: programs.relay(f"udp://127.0.0.1:{port}", to_relay, log=log("writer")),
            "relay": lambda: programs.relay(of_writer, to_reader, to_node, log=log("relay")),
            "reader": lambda: programs.dump(of_relay, self.arrivals["reader"], log("reader")),
            "trk_to_ros": lambda: programs.node("trk_to_ros", f"/{name}/trk_to_ros", log("trk_to_ros")),
            "ros_to_trk": lambda: programs.node("ros_to_trk", f"/{name}/ros_to_trk", log("ros_to_trk")),
            "receiver": lambda: programs.dump(of_ros, self.arrivals["receiver"], log("receiver")),
        }
        self._listener = Listener(f"/{name}/params", self.arrivals["topic"].add)
        self.victims = list(self._starts)
        self._running = {}
        for which in self.victims:
            self.start(which)
        self.tracker = Tracker([(port, 1)])

    def __exit__(self, *details):
        self.tracker.stop()
        self._listener.close()
        for process in self._running.values():
            process.kill()

    def start(self, which):
        self._running[which] = self._starts[which]()

    def kill(self, which):
        self._running[which].kill()

    def end(self):
        """Ends all processes with SIGINT, the receivers last."""
        for process in self._running.values():
            process.end()

    def passed(self, number):
        """Whether all receivers have a set after this number."""
        self._heal()
        return all(one.has_passed(self.tracker.run, number) for one in self.arrivals.values())

    def _heal(self):
        """Restarts the readers of a take, which end when its writer dies. No other process may end."""
        for which, process in self._running.items():
            if process.code() is None:
                continue
            if self._transport != "file":
                raise Failure(f"{which} has ended with {process.code()}: {process.output()[-1000:]}")
            self.start(which)
        found = self._testbed.diagnostics.of(self._node_status)
        if self._transport == "file" and found and found[0].startswith(("ended", "the source failed")):
            self.kill("trk_to_ros")
            self._testbed.diagnostics.forget(self._node_status)
            self.start("trk_to_ros")


MOST_AT_ONCE = 10  # kills between two waits for new sets


def bursts(testbed, times):
    """Divides kills into bursts. Within a burst, a process may be killed again before it has started up."""
    left = times
    while left > 0:
        size = min(left, testbed.rng.randint(1, MOST_AT_ONCE))
        left -= size
        yield size
        print(f"{times - left} of {times} kills", file=sys.stderr, flush=True)


def kill(testbed, transport, times):
    """A Result. Recovery is the time from the last restart of a burst until all receivers have newer sets."""
    result, rng = Result(), testbed.rng
    with Chain(testbed, transport) as chain:
        wait_for(lambda: chain.passed(0), "sets arrive at all receivers")
        for size in bursts(testbed, times):
            victims = rng.choices(chain.victims, k=size)
            for victim in victims:
                testbed.pause(0.3 * rng.random())
                chain.kill(victim)
                testbed.pause(0.1 * rng.random())
                chain.start(victim)
            begun, number = time.monotonic(), chain.tracker.sent
            try:
                wait_for(lambda number=number: chain.passed(number), f"sets arrive after kills of {', '.join(victims)}")
            except Failure as failure:
                missing = [where for where, one in chain.arrivals.items() if not one.has_passed(1, number)]
                raise Failure(f"{failure}, at {', '.join(missing)}") from None
            result.recovered(time.monotonic() - begun)
        result.sent = chain.tracker.stop()
        wait_until_still(lambda: [one.count for one in chain.arrivals.values()])
        chain.end()
    for where, one in chain.arrivals.items():
        result.wrong += [f"{where}: {wrong}" for wrong in one.wrong]
    result.arrived = min(one.count for one in chain.arrivals.values())
    result.lost = result.sent - result.arrived
    result.note = f"{times} kills"
    return result


def kill_recorders(testbed, times):
    """The same for a relay that records takes. The next one recovers the .part file that it leaves."""
    result, rng = Result(), testbed.rng
    folder = testbed.new_folder()
    port = free_port()
    tracker = Tracker([(port, 1)])

    def start():
        return testbed.programs.relay(f"udp://127.0.0.1:{port}", f"file:{folder}/take-001.trk?number=1",
                                         log=testbed.log("recorder"))

    def newest():
        """Counter of the last set in the take that is being recorded."""
        for part in folder.glob("*.part"):
            with contextlib.suppress(OSError):
                lines = part.read_text(encoding="ascii").split("\n")[:-1]
                # The lines before the first set are shorter.
                if lines and len(lines[-1].split()) > 12:
                    return int(lines[-1].split()[-1])
        return 0

    recorder = start()
    wait_for(newest, "a take is recorded")
    for size in bursts(testbed, times):
        for _ in range(size):
            testbed.pause(0.3 * rng.random())
            recorder.kill()
            recorder = start()
        begun, number = time.monotonic(), tracker.sent
        wait_for(lambda number=number: newest() > number, "a take is recorded again")
        result.recovered(time.monotonic() - begun)
    result.sent = tracker.stop()
    wait_until_still(newest)
    result.expect(recorder.end() == 0, f"the last recorder ended with {recorder.code()}: {recorder.output()[-500:]}")
    result.expect(not list(folder.glob("*.part")), "a .part file is left")
    takes = list(folder.glob("*.trk"))
    for take in takes:
        result.take(read_take(testbed, take))
    result.lost = result.sent - result.arrived
    result.note = f"{times} kills, {len(takes)} takes"
    return result


def read_take(testbed, path):
    arrivals = sets.Arrivals(1)
    testbed.programs.dump(f"file:{path}?speed=0&time=now", arrivals, testbed.log("dump")).wait()
    return arrivals
