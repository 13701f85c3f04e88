# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Senders to the programs that are tested, and what is between them: a tracker, a bad path, a flood of random datagrams."""

import heapq
import random
import signal
import socket
import sys
import threading
import time
from dataclasses import dataclass

import sets


class Tracker:
    """Sends sets of cameras at a steady rate, as datagrams of trk, from its own thread. `targets`: (port of 127.0.0.1,
    id of the camera) for each; `run` is in every set."""

    def __init__(self, targets, rate=100, run=1):
        self.run = run
        self.sent = 0  # the number of the last set
        self._targets, self._rate = targets, rate
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._send, daemon=True)
        self._thread.start()

    def stop(self):
        self._ends.set()
        self._thread.join()
        return self.sent

    def _send(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            begin = time.monotonic()
            for number in range(1, 1 << 62):
                if self._ends.wait(max(0.0, begin + number / self._rate - time.monotonic())):
                    return
                self.sent = number
                for port, camera in self._targets:
                    if number % self._rate == 1:
                        _send_to(out, sets.constants(camera), port)
                    _send_to(out, sets.params(camera, self.run, number), port)


def _send_to(out, datagram, port):
    try:
        out.sendto(datagram, ("127.0.0.1", port))
    except ConnectionRefusedError:
        pass  # the datagram before was not received


@dataclass(frozen=True)
class Path:
    """What happens to parameters on their way. Shares are between 0 and 1."""
    loss: float = 0
    twice: float = 0
    late: float = 0  # delayed until up to five later ones have passed
    delay: float = 0  # s
    jitter: float = 0  # s, at most; a random part of it is added for each
    corrupt: float = 0


_SPACING = 0.008  # s, between sets of 100 Hz that are delayed


class Forwarder:
    """A path between two ports of 127.0.0.1. It applies its Path to each set except the first, in its own
    thread, and records what it did."""

    def __init__(self, to_port, path, rng, damage):
        self.emitted = []  # (run, number) of the sets that were sent unchanged, in this order; None for other protocols
        self.corrupted = 0
        self._path, self._rng, self._damage = path, rng, damage
        self._to = ("127.0.0.1", to_port)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        self._waiting = []  # (time, order, datagram): delayed
        self._held = []  # [others to pass, datagram]
        self._order, self._base = 0, 0.0
        self._ends = False
        self._thread = threading.Thread(target=self._forward, daemon=True)
        self._thread.start()

    def stop(self):
        """Sends what is still delayed. Its sender must have ended before."""
        self._ends = True
        self._thread.join()
        self._socket.close()

    def _forward(self):
        is_first = True
        while True:
            next_due = self._waiting[0][0] - time.monotonic() if self._waiting else 0.05
            self._socket.settimeout(max(0.0005, min(0.05, next_due)))
            try:
                datagram = self._socket.recv(4096)
                if is_first or not self._is_set(datagram):
                    self._send(datagram)
                    is_first = is_first and not self._is_set(datagram)
                else:
                    self._take(datagram)
            except (TimeoutError, BlockingIOError):
                if self._ends and not self._waiting:
                    break
            self._send_due()
        for _, datagram in self._held:
            self._send(datagram)

    @staticmethod
    def _is_set(datagram):
        return sets.is_params(datagram) or not datagram.startswith(b"DMC01")

    def _take(self, datagram):
        path, chance = self._path, self._rng.random
        if chance() < path.loss:
            return
        if chance() < path.corrupt:
            self._socket.sendto(self._damage(datagram, self._rng), self._to)
            self.corrupted += 1
            return
        behind = self._rng.randint(1, 5) if chance() < path.late else 0
        copies = 2 if chance() < path.twice else 1
        if path.delay or path.jitter:
            # If sets arrive at once after a pause, they overtake no more than evenly spaced ones.
            self._base = max(time.monotonic(), self._base + _SPACING)
            for _ in range(copies):
                due = self._base + path.delay + path.jitter * chance() + behind * _SPACING
                self._order += 1
                heapq.heappush(self._waiting, (due, self._order, datagram))
        elif behind:
            self._held += [[behind, datagram] for _ in range(copies)]
        else:
            for _ in range(copies):
                self._send(datagram)

    def _send_due(self):
        while self._waiting and self._waiting[0][0] <= time.monotonic():
            self._send(heapq.heappop(self._waiting)[2])

    def _send(self, datagram):
        self._socket.sendto(datagram, self._to)
        if not self._is_set(datagram):
            return
        self.emitted.append(sets.number_of(datagram) if sets.is_params(datagram) else None)
        for held in self._held:
            held[0] -= 1
        passed = [held for held in self._held if held[0] <= 0]
        self._held = [held for held in self._held if held[0] > 0]
        for _, late in passed:
            self._send(late)


def damage_text(datagram, rng):
    """Damages it visibly: trk has no checksum, and a changed digit would be a valid number."""
    last = datagram.rstrip(b"\0").rfind(b" ")
    way = rng.randrange(3)
    if way == 0:
        return datagram[:rng.randrange(1, last)]
    at = rng.randrange(8, last) if way == 1 else rng.randrange(0, 6)
    return datagram[:at] + bytes([rng.choice(b"x?\x80\xff")]) + datagram[at + 1:]


def damage_byte(datagram, rng):
    """Changes one byte: for protocols with a checksum."""
    at = rng.randrange(len(datagram))
    return datagram[:at] + bytes([datagram[at] ^ rng.randrange(1, 256)]) + datagram[at + 1:]


_UDP_SEGMENT = 103  # of linux/udp.h: the kernel divides what is sent at once into datagrams of this size
_AT_ONCE = 32


def flood(port, rate, seconds, seed):
    """Sends `rate` datagrams per second that are not records. Returns how many it sent, and for how long (s)."""
    rng = random.Random(seed)
    beginnings = [b"", b"DMC01\0PA", b"DMC01\0PB", b"DMC01\0CA", b"DMC01\0XX", b"OTrk", b"\xd1"]
    senders = []
    for beginning in beginnings * 4:
        size = len(beginning) + rng.randrange(1, 400)
        out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        out.setsockopt(socket.IPPROTO_UDP, _UDP_SEGMENT, size)
        out.connect(("127.0.0.1", port))
        senders.append((out, b"".join(beginning + rng.randbytes(size - len(beginning)) for _ in range(_AT_ONCE))))
    count, begin = 0, time.monotonic()
    while True:
        now = time.monotonic() - begin
        if now >= seconds:
            return count, now
        # It does not catch up after a long pause.
        for _ in range(min(rate // 20, int(now * rate) - count) // _AT_ONCE):
            out, datagrams = rng.choice(senders)
            out.send(datagrams)
            count += _AT_ONCE
        time.sleep(0.001)


def main(what, *words):
    """As a separate process: tracker RATE RUN PORT:ID… until SIGINT, or flood PORT RATE SECONDS SEED."""
    if what == "flood":
        print(*flood(*map(int, words)))
        return
    rate, run, *targets = words
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    tracker = Tracker([tuple(map(int, target.split(":"))) for target in targets], int(rate), int(run))
    signal.sigwait([signal.SIGINT])
    print(tracker.stop())


if __name__ == "__main__":
    main(*sys.argv[1:])
