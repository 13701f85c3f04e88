# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""The faults: a case is a function of the laboratory that returns a Result, and its first line says what is done."""

import json
import os
import time

import own_machine
from kills import kill, kill_recorders, read_take
from laboratory import Camera, Result
from processes import free_port, wait_for
from ros_side import Crane
from trackers import Path

CASES = {}


def case(function):
    CASES[function.__name__] = function
    return function


def over(laboratory, path, seconds=(2, 60), **options):
    """A camera over this path."""
    with laboratory.camera(path, **options) as camera:
        camera.send(laboratory.choose(*seconds))
        return camera.result()


@case
def nothing_wrong(laboratory):
    """Nothing is wrong: the measure of the others."""
    result = over(laboratory, Path())
    result.expect(result.lost == 0, f"{result.lost} lost")
    return result


@case
def loss(laboratory):
    """One set in five is lost."""
    return over(laboratory, Path(loss=0.2))


@case
def duplicates(laboratory):
    """One set in five comes twice."""
    return over(laboratory, Path(twice=0.2))


@case
def reordering(laboratory):
    """One set in ten comes after up to five later ones."""
    return over(laboratory, Path(late=0.1))


@case
def jitter(laboratory):
    """Each set is 30 to 60 ms late, so that they overtake each other."""
    return over(laboratory, Path(delay=0.03, jitter=0.03))


@case
def bad_network(laboratory):
    """All of it at once."""
    return over(laboratory, Path(loss=0.1, twice=0.1, late=0.05, delay=0.01, jitter=0.02, corrupt=0.05))


@case
def corruption(laboratory):
    """One set in five is cut, or has a byte that is no number."""
    return over(laboratory, Path(corrupt=0.2))


@case
def corruption_of_freed(laboratory):
    """Free-D: any byte of one message in five becomes any other."""
    return over(laboratory, Path(corrupt=0.2), protocol="freed")


@case
def corruption_of_opentrackio(laboratory):
    """OpenTrackIO: any byte of one packet in five becomes any other."""
    return over(laboratory, Path(corrupt=0.2), protocol="opentrackio")


@case
def rubbish(laboratory):
    """100,000 datagrams a second that are no records, beside 100 Hz."""
    with laboratory.camera() as camera:
        said = []
        seconds = laboratory.choose(3, 30)
        tracker = camera.tracker()
        laboratory.programs.rubbish(camera.port, 100000, seconds, laboratory.rng.randrange(1 << 32), laboratory.log("rubbish"),
                                    said.append).wait()
        ended = time.monotonic()
        number = tracker.sent
        wait_for(lambda: camera.arrivals.has_passed(1, number), "sets arrive after the rubbish")
        recovery = camera.arrivals.last_time - ended
        camera.sent += tracker.stop()
        result = camera.result()
        values = camera.settled()
    count, took = said[0].split()
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
def sender_restarts(laboratory):
    """The sender ends, and begins again at 1 from the same port."""
    with laboratory.camera(Path()) as camera:
        camera.send(1)
        recovery = 0
        for _ in range(laboratory.choose(3, 30)):
            tracker = camera.tracker()
            begun = time.monotonic()
            wait_for(lambda run=tracker.run: camera.arrivals.has_passed(run, 0), "the new run arrives")
            recovery = max(recovery, camera.arrivals.last_time - begun)
            laboratory.pause(0.5)
            camera.sent += tracker.stop()
        result = camera.result()
    result.recovered(recovery)
    return result


@case
def two_senders(laboratory):
    """A second sender of the same camera: the first is followed until it is silent, then the second."""
    # Longer than the pauses of a busy machine.
    with laboratory.camera(failover=laboratory.choose(3, 0.5)) as camera:
        first = camera.tracker()
        wait_for(lambda: camera.arrivals.count > 0, "the first arrives")
        second = camera.tracker()
        laboratory.pause(laboratory.choose(1.5, 10))
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
    # Every set of the second sender is received or foreign.
    foreign = camera.sent - int(values["received"]) - int(values["lost"])
    result.expect(int(values["foreign"]) >= ignored, f"foreign: {values['foreign']}, ignored were {ignored}")
    result.expect(abs(int(values["foreign"]) - foreign) <= second.sent // camera.RATE + 1,
                  f"foreign: {values['foreign']} of {foreign}")
    return result


@case
def interface_recreated(laboratory):
    """The interface of a multicast group is removed and created again, under the sender and the node."""
    group = "udp://239.9.9.9:7000?interface=" + own_machine.INTERFACE
    own_machine.plug_in()
    with laboratory.camera(source=group, sinks=[group]) as camera:
        tracker = camera.tracker()
        wait_for(lambda: camera.arrivals.count > 0, "sets arrive")
        recovery = 0
        for _ in range(laboratory.choose(2, 30)):
            laboratory.pause(0.5)
            own_machine.unplug()
            laboratory.pause(0.5)
            own_machine.plug_in()
            begun, number = time.monotonic(), tracker.sent
            wait_for(lambda number=number: camera.arrivals.has_passed(1, number), "sets arrive again")
            recovery = max(recovery, time.monotonic() - begun)
        camera.sent = tracker.stop()
        result = camera.result()
    own_machine.unplug()
    result.recovered(recovery)
    return result


@case
def disk_full(laboratory):
    """A disk is full while a take is recorded, and has room again; beside it a camera goes on."""
    disk = laboratory.new_folder()
    own_machine.run("mount", "-t", "tmpfs", "-o", "size=64k", "none", disk)
    filler, part = disk / "filler", disk / "take.trk.part"
    filler.write_bytes(bytes(48 << 10))
    with laboratory.camera(sinks=[f"file:{disk}/take.trk", Camera.LIVE]) as camera:
        tracker = camera.tracker()
        wait_for(lambda: part.exists() and not free_bytes(disk), "the disk is full")
        laboratory.pause(laboratory.choose(1, 10))
        filler.unlink()
        begun, size = time.monotonic(), part.stat().st_size
        wait_for(lambda: part.stat().st_size > size, "recording goes on")
        recovery = time.monotonic() - begun
        camera.sent = tracker.stop()
        result = camera.result()
        camera.relay.end()
    recorded = read_take(laboratory, disk / "take.trk")
    own_machine.run("umount", disk)
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
def master_restarts(laboratory):
    """The master is killed, and started again later."""
    with laboratory.camera() as camera:
        tracker = camera.tracker()
        wait_for(lambda: camera.arrivals.count > 0, "sets arrive")
        laboratory.master.kill()
        camera.node.wait("ROS", lambda message, _: "does not answer" in message, "the node reports that it is gone")
        number = tracker.sent
        wait_for(lambda: camera.arrivals.has_passed(1, number), "sets arrive without a master")
        laboratory.master.start()
        camera.node.wait("ROS", lambda message, _: "does not know" in message, "the node reports the new master")
        camera.sent = tracker.stop()
        result = camera.result()
    laboratory.subscribe_again()
    result.expect(result.lost == 0, f"{result.lost} lost")
    return result


@case
def clock_of_tf_jumps(laboratory):
    """The clock that stamps tf is set back and forth under ros_to_trk."""
    return jump(laboratory, is_simulated=False)


@case
def ros_time_jumps(laboratory):
    """/clock goes back and forth, and with it the stamps of tf, under ros_to_trk."""
    return jump(laboratory, is_simulated=True)


def jump(laboratory, is_simulated):
    name = laboratory.next_name()
    crane = Crane(name, is_simulated)
    url = f"udp://127.0.0.1:{free_port()}"
    sent_on, result = [], Result()

    def on_line(line):
        record = json.loads(line)
        if record["type"] == "params":
            sent_on.append((record["euler"]["x"], record["counter"]))

    receiver = laboratory.programs.process("trk", "dump", "--json", url, log=laboratory.log("dump"), on_line=on_line)
    with laboratory.node("ros_to_trk", "/" + name, sinks=[url], input="tf", chip_width=9.6, chip_height=5.4,
                         pace=False):
        wait_for(lambda: sent_on, "poses arrive")
        for offset in (-60, 0, 3600, -1e6, 5, 0)[:laboratory.choose(3, 6)]:
            crane.offset = offset
            begun, number = time.monotonic(), crane.at
            wait_for(lambda number=number: sent_on[-1][0] > number, f"poses arrive with a clock off by {offset} s")
            result.recovered(time.monotonic() - begun)
            laboratory.pause(1)
        last = crane.stop()
        laboratory.pause(0.3)
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
def kills_udp(laboratory):
    """kill -9 of any process, over UDP."""
    return kill(laboratory, "udp", laboratory.kills(share=0.3))


@case
def kills_shm(laboratory):
    """kill -9 of any process, over shared memory."""
    return kill(laboratory, "shm", laboratory.kills(share=0.3))


@case
def kills_fifo(laboratory):
    """kill -9 of any process, over FIFOs."""
    return kill(laboratory, "file", laboratory.kills(share=0.2))


@case
def kills_recorder(laboratory):
    """kill -9 of who records a take; the next one recovers it."""
    return kill_recorders(laboratory, laboratory.kills(share=0.2))
