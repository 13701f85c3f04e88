# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""What every case uses: a master, nodes, cameras on their way into ROS, and the checks of what arrived."""

import contextlib
import itertools
import logging
import random
import time
from dataclasses import dataclass, field
from typing import Optional

import rospy

import sandbox
import sets
from counts import SHOWN, Counts
from processes import Failure, Programs, free_port, wait_for, wait_until_still
from ros_side import Diagnostics, Listener, Master
from trackers import Forwarder, Tracker, damage_byte, damage_text


@dataclass
class Result:
    """A row of the table. `wrong` lists what must not be; empty: the case has passed."""
    sent: int = 0
    arrived: int = 0
    lost: int = 0  # sent and not arrived
    duplicates: int = 0  # received and dropped
    recovery: Optional[float] = None  # s, the longest
    wrong: list = field(default_factory=list)
    note: str = ""

    def expect(self, is_true, text):
        if not is_true:
            self.wrong.append(text)

    def take(self, arrivals):
        self.arrived += arrivals.count
        self.wrong += arrivals.wrong

    def recovered(self, seconds):
        self.recovery = max(self.recovery or 0.0, seconds)


class Testbed:
    """`folder` is for logs. All random values come from `rng`, which the caller seeds for each case."""

    def __init__(self, devel, root, folder, is_long=False, kills=0):
        self.programs = Programs(devel)
        self.folder = folder
        self.lens = root / "config/lens_example.yaml"
        self.rng = random.Random()
        self._is_long, self._kills = is_long, kills
        self.master = Master(folder)
        # It would warn of every process that is killed on purpose.
        logging.getLogger("rospy").setLevel(logging.ERROR)
        rospy.init_node("faults", anonymous=True, disable_signals=True, disable_rosout=True)
        self.diagnostics = Diagnostics()
        self._names = (f"camera{number}" for number in itertools.count(1))
        self._logs = itertools.count(1)

    def next_name(self):
        return next(self._names)

    def choose(self, short, long):
        """The value for the short or for the long form."""
        return long if self._is_long else short

    def kills(self, share):
        """The number of kills of a case, which has this share of all."""
        return max(1, round(share * self._kills))

    def new_folder(self):
        folder = self.folder / f"folder{next(self._logs)}"
        folder.mkdir()
        return folder

    @staticmethod
    def set_parameters(node, **parameters):
        rospy.set_param(node, {"diagnostic_period": 0.2, **parameters})

    @staticmethod
    def pause(seconds):
        time.sleep(seconds)

    def log(self, name):
        """The path of a new log file."""
        return self.folder / f"{next(self._logs)}_{name}.log"

    @contextlib.contextmanager
    def node(self, program, namespace, **parameters):
        """A node with these parameters. It is ended with SIGINT, and must end without an error."""
        name = f"{namespace}/{program}"
        self.set_parameters(name, **parameters)
        node = Node(self, program, name)
        try:
            yield node
            node.end()
        finally:
            node.process.kill()

    def subscribe_again(self):
        """After a restart of the master, which does not know the old subscribers."""
        self.diagnostics.close()
        self.diagnostics = Diagnostics()

    def camera(self, path=None, **options):
        return Camera(self, path, **options)

    @contextlib.contextmanager
    def leaving_nothing(self, wrong):
        """Checks that nothing is left behind that was not there before; what is left is added to `wrong`."""
        before = sandbox.everything()
        yield
        try:
            wait_for(lambda: sandbox.everything() <= before, "nothing is left behind", 5)
        except Failure:
            wrong += [f"left behind: {what}" for what in sorted(sandbox.everything() - before)]


class Node:
    """A node as a process, which can be killed and started again."""

    def __init__(self, testbed, program, name):
        self.name = name
        self._testbed, self._program = testbed, program
        self.start()

    def start(self):
        testbed = self._testbed
        self.process = testbed.programs.node(self._program, self.name, testbed.log(self._program))

    def end(self):
        if self.process.end() != 0:
            raise Failure(f"{self.name} ended with {self.process.code()}: {self.process.output()[-1000:]}")

    def wait(self, subject, condition, what):
        return self._testbed.diagnostics.wait(f"{self.name}: {subject}", condition, what)


class Camera(contextlib.AbstractContextManager):
    """A camera on its way into ROS: tracker, path with faults, trk_to_ros, subscriber. `protocol`: trk, freed or opentrackio.
    With `sinks`, a relay between tracker and node writes to them; LIVE among them stands for the source of the node.

    Call send() any number of times, then result() once.
    """

    RATE = 100  # Hz
    LIVE = "live"

    def __init__(self, testbed, path=None, protocol="trk", source=None, sinks=(), rate=RATE, **parameters):
        self._testbed, self._rate, self._protocol = testbed, rate, protocol
        self.name = testbed.next_name()
        self.port = free_port()
        self._stack = contextlib.ExitStack()
        with self._stack as stack:
            scheme = {"trk": "udp"}.get(protocol, protocol)
            lens = "?lens=" + str(testbed.lens) if protocol == "freed" else ""
            source = source or f"{scheme}://127.0.0.1:{self.port}{lens}"
            self.node = stack.enter_context(
                testbed.node("trk_to_ros", "/" + self.name, source=source, queue_size=10000, **parameters))
            self.node.wait(self.name, lambda *_: True, "the node reports")
            self.arrivals = sets.Arrivals(1, protocol != "freed", sets.FREE_D_ERROR if protocol == "freed" else None)
            self._listener = Listener(f"/{self.name}/params", self.arrivals.add)
            stack.callback(self._listener.close)
            wait_for(self._listener.is_connected, "the subscriber is connected")
            self.forwarder = self.relay = None
            self.entrance = self.port
            if path is not None:
                damage = damage_text if protocol == "trk" else damage_byte
                self.forwarder = Forwarder(self.port, path, random.Random(testbed.rng.random()), damage)
                self.entrance = self.forwarder.port
            if protocol != "trk":
                options = f"{lens or '?'}&id=1".replace("?&", "?")
                sinks = [f"{scheme}://127.0.0.1:{self.entrance}{options}"]
            if sinks:
                port = free_port()
                sinks = [source if sink is self.LIVE else sink for sink in sinks]
                self.relay = testbed.programs.relay(f"udp://127.0.0.1:{port}", *sinks, log=testbed.log("relay"))
                stack.callback(self.relay.kill)
                self.entrance = port
                wait_for(lambda: "reading udp" in self.relay.output(), "the relay listens")
            self._stack = stack.pop_all()
        self._runs = itertools.count(1)
        self.sent = 0

    def __exit__(self, *details):
        return self._stack.__exit__(*details)

    def tracker(self):
        """A new sender, with a new run number."""
        return Tracker([(self.entrance, 1)], self._rate, next(self._runs))

    def send(self, seconds):
        """Sends with a new sender, and waits until it has ended."""
        tracker = self.tracker()
        self._testbed.pause(seconds)
        self.sent += tracker.stop()

    def result(self):
        """After the last set was sent: checks what arrived, and that /diagnostics shows what was done."""
        result = Result(sent=self.sent)
        if self.forwarder:
            if self.relay:
                wait_until_still(lambda: self.arrivals.count)
            self.forwarder.stop()
        values = self.settled()
        # Published messages arrive a moment later.
        with contextlib.suppress(Failure):
            wait_for(lambda: self.arrivals.count >= int(values["received"]), "all arrives", 20)
        result.take(self.arrivals)
        result.lost = result.sent - result.arrived
        result.duplicates = int(values["duplicate"])
        result.expect(int(values["received"]) == self.arrivals.count,
                      f"received {values['received']}, on the topic {self.arrivals.count}")
        if self.forwarder:
            self._compare(result, values)
        return result

    def settled(self):
        """The values of the diagnostics after the last record: they were the same twice."""
        seen = []

        def stand(_, values):
            if not seen or seen[-1] is not values:
                seen.append(values)
            return len(seen) > 2 and all(seen[-2][key] == values[key] for key in SHOWN.values())
        return self.node.wait(self.name, stand, "the diagnostics settle")

    def _compare(self, result, values):
        emitted = self.forwarder.emitted
        expected = vars(Counts.of(emitted) if self._protocol == "trk" else Counts(received=len(emitted)))
        expected["malformed"] = self.forwarder.corrupted
        for name, key in SHOWN.items():
            # Only the sets of trk have a number, from which the other counts follow.
            if self._protocol == "trk" or name in ("received", "malformed"):
                result.expect(int(values[key]) == expected[name],
                              f"{key}: {values[key]} in the diagnostics, {expected[name]} was done")
