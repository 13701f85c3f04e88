# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""The cases: each is a function of the testbed that returns a Result. Its docstring says what is done."""

import json
import os
import time

import sandbox
from kills import kill, kill_recorders, read_take
from testbed import Camera, Result
from processes import free_port, wait_for, wait_until_still
from ros_side import Crane
from trackers import Path

CASES = {}


def case(function):
    CASES[function.__name__] = function
    return function


def over(testbed, path, seconds=(2, 60), **options):
    """Sends a camera over this path."""
    with testbed.camera(path, **options) as camera:
        camera.send(testbed.choose(*seconds))
        return camera.result()


@case
def nothing_wrong(testbed):
    """Nothing is wrong: for comparison."""
    result = over(testbed, Path())
    result.expect(result.lost == 0, f"{result.lost} lost")
    return result


@case
def loss(testbed):
    """One set in five is lost."""
    return over(testbed, Path(loss=0.2))


@case
def duplicates(testbed):
    """One set in five arrives twice."""
    return over(testbed, Path(twice=0.2))


@case
def reordering(testbed):
    """One set in ten arrives after up to five later ones."""
    return over(testbed, Path(late=0.1))


@case
def jitter(testbed):
    """Each set is 30 to 60 ms late, so that they overtake each other."""
    return over(testbed, Path(delay=0.03, jitter=0.03))


@case
def bad_network(testbed):
    """All of this at once, and corruption."""
    return over(testbed, Path(loss=0.1, twice=0.1, late=0.05, delay=0.01, jitter=0.02, corrupt=0.05))


@case
def corruption(testbed):
    """One set in five is truncated, or has a byte that is not part of a number."""
    return over(testbed, Path(corrupt=0.2))


@case
def corruption_of_freed(testbed):
    """Free-D: one byte of one message in five is changed."""
    return over(testbed, Path(corrupt=0.2), protocol="freed")


@case
def corruption_of_opentrackio(testbed):
    """OpenTrackIO: one byte of one packet in five is changed."""
    return over(testbed, Path(corrupt=0.2), protocol="opentrackio")


@case
def flood(testbed):
    """100,000 datagrams per second that are not records, beside 100 Hz."""
    with testbed.camera() as camera:
        printed = []
        seconds = testbed.choose(3, 30)
        tracker = camera.tracker()
        testbed.programs.flood(camera.port, 100000, seconds, testbed.rng.randrange(1 << 32), testbed.log("flood"),
                                    printed.append).wait()
        ended = time.monotonic()
        number = tracker.sent
        wait_for(lambda: camera.arrivals.has_passed(1, number), "sets arrive after the flood")
        recovery = camera.arrivals.last_time - ended
        camera.sent += tracker.stop()
        result = camera.result()
        values = camera.settled()
    count, took = printed[0].split()
    drops, malformed, received = (int(values[key]) for key in ("kernel drops", "malformed", "received"))
    constants = camera.sent // camera.RATE + 1
    missing = int(count) + camera.sent - malformed - drops - received
    result.recovered(recovery)
    result.note = f"{int(count) / float(took):,.0f}/s, {drops} dropped by the kernel"
    result.expect(-constants <= missing <= 0,
                  f"of {count} and {camera.sent} sets: {malformed} malformed, {drops} dropped, {received} received")
    result.expect(drops > 0 or result.lost == 0, f"{result.lost} lost though the kernel dropped none")
    return result


@case
def sender_restarts(testbed):
    """The sender ends, and starts again with counter 1 from the same port."""
    with testbed.camera(Path()) as camera:
        camera.send(1)
        recovery = 0
        for _ in range(testbed.choose(3, 30)):
            tracker = camera.tracker()
            begun = time.monotonic()
            wait_for(lambda run=tracker.run: camera.arrivals.has_passed(run, 0), "the new run arrives")
            recovery = max(recovery, camera.arrivals.last_time - begun)
            testbed.pause(0.5)
            camera.sent += tracker.stop()
        result = camera.result()
    result.recovered(recovery)
    return result


@case
def two_senders(testbed):
    """A second sender of the same camera: the first is followed until it is silent, then the second."""
    # Longer than the pauses of a busy machine.
    with testbed.camera(failover=testbed.choose(3, 0.5)) as camera:
        first = camera.tracker()
        wait_for(lambda: camera.arrivals.count > 0, "the first arrives")
        second = camera.tracker()
        testbed.pause(testbed.choose(1.5, 10))
        camera.sent = first.stop()
        silent = time.monotonic()
        ignored = second.sent
        wait_for(lambda: len(camera.arrivals.runs) > 1, "the second is followed")
        recovery = camera.arrivals.last_time - silent
        camera.sent += second.stop()
        result = camera.result()
        values = camera.settled()
    result.recovered(recovery)
    result.expect(camera.arrivals.runs == [1, 2], f"followed were {camera.arrivals.runs}")
    result.expect(values["failovers"] == "1", f"failovers: {values['failovers']}")
    # Every set of the second sender was either received or counted as foreign.
    foreign = camera.sent - int(values["received"]) - int(values["lost"])
    result.expect(int(values["foreign"]) >= ignored, f"foreign: {values['foreign']}, ignored were {ignored}")
    result.expect(abs(int(values["foreign"]) - foreign) <= second.sent // camera.RATE + 1,
                  f"foreign: {values['foreign']} of {foreign}")
    return result


@case
def interface_recreated(testbed):
    """The interface of a multicast group is removed and created again, under the sender and the node."""
    group = "udp://239.9.9.9:7000?interface=" + sandbox.INTERFACE
    sandbox.add_interface()
    with testbed.camera(source=group, sinks=[group]) as camera:
        tracker = camera.tracker()
        wait_for(lambda: camera.arrivals.count > 0, "sets arrive")
        recovery = 0
        for _ in range(testbed.choose(2, 30)):
            testbed.pause(0.5)
            sandbox.remove_interface()
            testbed.pause(0.5)
            sandbox.add_interface()
            begun, number = time.monotonic(), tracker.sent
            wait_for(lambda number=number: camera.arrivals.has_passed(1, number), "sets arrive again")
            recovery = max(recovery, time.monotonic() - begun)
        camera.sent = tracker.stop()
        result = camera.result()
    sandbox.remove_interface()
    result.recovered(recovery)
    return result


@case
def disk_full(testbed):
    """A disk is full while a take is recorded, and has space again; another sink continues."""
    disk = testbed.new_folder()
    sandbox.run("mount", "-t", "tmpfs", "-o", "size=64k", "none", disk)
    filler, part = disk / "filler", disk / "take.trk.part"
    filler.write_bytes(bytes(48 << 10))
    with testbed.camera(sinks=[f"file:{disk}/take.trk", Camera.LIVE]) as camera:
        tracker = camera.tracker()
        wait_for(lambda: part.exists() and not free_bytes(disk), "the disk is full")
        testbed.pause(testbed.choose(1, 10))
        filler.unlink()
        begun, size = time.monotonic(), part.stat().st_size
        wait_for(lambda: part.stat().st_size > size, "recording continues")
        recovery = time.monotonic() - begun
        camera.sent = tracker.stop()
        result = camera.result()
        camera.relay.end()
    recorded = read_take(testbed, disk / "take.trk")
    sandbox.run("umount", disk)
    result.recovered(recovery)
    result.wrong += recorded.wrong
    result.note = f"{recorded.count} sets in the take"
    result.expect(result.lost == 0, f"{result.lost} lost beside the disk")
    result.expect(0 < recorded.count < camera.sent, f"{recorded.count} of {camera.sent} recorded")
    return result


def free_bytes(folder):
    found = os.statvfs(folder)
    return found.f_bavail * found.f_frsize


@case
def master_restarts(testbed):
    """The master is killed, and started again later."""
    with testbed.camera() as camera:
        tracker = camera.tracker()
        wait_for(lambda: camera.arrivals.count > 0, "sets arrive")
        testbed.master.kill()
        camera.node.wait("ROS", lambda message, _: "does not answer" in message, "the node reports that it is gone")
        number = tracker.sent
        wait_for(lambda: camera.arrivals.has_passed(1, number), "sets arrive without a master")
        testbed.master.start()
        camera.node.wait("ROS", lambda message, _: "does not know" in message, "the node reports the new master")
        camera.sent = tracker.stop()
        result = camera.result()
    testbed.subscribe_again()
    result.expect(result.lost == 0, f"{result.lost} lost")
    return result


@case
def clock_of_tf_jumps(testbed):
    """The clock that stamps tf is set back and forth under ros_to_trk."""
    return jump(testbed, is_simulated=False)


@case
def ros_time_jumps(testbed):
    """/clock goes back and forth, and with it the stamps of tf, under ros_to_trk."""
    return jump(testbed, is_simulated=True)


def jump(testbed, is_simulated):
    name = testbed.next_name()
    crane = Crane(name, is_simulated)
    url = f"udp://127.0.0.1:{free_port()}"
    sent_on, result = [], Result()

    def on_line(line):
        record = json.loads(line)
        if record["type"] == "params":
            sent_on.append((record["euler"]["x"], record["counter"]))

    receiver = testbed.programs.process("trk", "dump", "--json", url, log=testbed.log("dump"), on_line=on_line)
    with testbed.node("ros_to_trk", "/" + name, sinks=[url], input="tf", chip_width=9.6, chip_height=5.4,
                         pace=False):
        wait_for(lambda: sent_on, "poses arrive")
        for offset in (-60, 0, 3600, -1e6, 5, 0)[:testbed.choose(3, 6)]:
            crane.offset = offset
            begun, number = time.monotonic(), crane.at
            wait_for(lambda number=number: sent_on[-1][0] > number, f"poses arrive with a clock off by {offset} s")
            result.recovered(time.monotonic() - begun)
            testbed.pause(1)
        last = crane.stop()
        wait_until_still(lambda: len(sent_on))
    receiver.end()
    result.sent = last - int(sent_on[0][0]) + 1
    result.arrived = len(sent_on)
    result.lost = result.sent - result.arrived
    for (x, counter), (next_x, next_counter) in zip(sent_on, sent_on[1:]):
        result.expect(next_x > x and next_counter == counter + 1, f"{next_x}, {next_counter} after {x}, {counter}")
    result.expect(all(x == int(x) <= last for x, _ in sent_on), "poses that were not sent")
    del result.wrong[5:]
    return result


@case
def kills_udp(testbed):
    """kill -9 of any process, over UDP."""
    return kill(testbed, "udp", testbed.kills(share=0.3))


@case
def kills_shm(testbed):
    """kill -9 of any process, over shared memory."""
    return kill(testbed, "shm", testbed.kills(share=0.3))


@case
def kills_fifo(testbed):
    """kill -9 of any process, over FIFOs."""
    return kill(testbed, "file", testbed.kills(share=0.2))


@case
def kills_recorder(testbed):
    """kill -9 of a relay that records a take; the next one recovers it."""
    return kill_recorders(testbed, testbed.kills(share=0.2))
