# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Camera sets that can be recognised: every value is a function of the id of the camera, the run of its sender and the
number of the set, so that a receiver can check each set."""

import threading
import time

FORMAT = 1  # euler; all other options have their default
FIELDS = ("x", "y", "z", "pan", "tilt", "roll", "fov", "center_x", "center_y", "k1", "k2", "focdist", "aperture")
POSE = 6  # number of the fields that Free-D has, the first ones
# Free-D has fixed-point numbers: 1/64 mm, 1/32768 degree.
FREE_D_ERROR = (8e-6,) * 3 + (1.6e-5,) * 3
MOST = 100_000  # sets of a run that can be distinguished without a counter, for Free-D


def values(camera, run, number):
    """In the order of FIELDS: m, degrees, mm."""
    return (number % MOST / 1000, run / 1000, camera / 1000,
            number * 7 % 16000 / 100 - 80, number * 11 % 16000 / 100 - 80, number * 13 % 16000 / 100 - 80,
            8 + number % 5000 / 1000, number % 17 / 1000, number % 19 / 1000, number % 23 * 1e-5, number % 29 * 1e-7,
            1 + number % 500 / 100, 2 + number % 50 / 10)


def params(camera, run, number):
    """A datagram of trk."""
    numbers = " ".join(map(repr, values(camera, run, number)))
    return b"DMC01\0PA" + f"I{camera} {FORMAT:x} {numbers} {number}\0".encode()


def constants(camera):
    return b"DMC01\0CA" + f"I{camera} 1920 1080 0 0 0 0 9.59 5.39 9.59 5.39\0".encode()


def is_params(datagram):
    return datagram.startswith(b"DMC01\0P")


def number_of(datagram):
    """(run, number) of a datagram that params() made."""
    words = datagram[8:].rstrip(b"\0").split()
    return round(float(words[3]) * 1000), int(words[-1])


class Arrivals:
    """What arrived of a camera, checked at once. Any thread may call it.

    `wrong` has the first faults: sets that differ from what was sent, arrived twice, or out of order.
    """

    def __init__(self, camera, has_counter=True, error=None):
        self.camera = camera
        self.count = 0
        self.runs = []  # of senders, in the order in which they were followed
        self.newest = {}  # newest number of each run
        self.wrong = []
        self.last_time = 0.0
        self._has_counter = has_counter
        self._error = error  # allowed error of each of the first fields; None: all must be exact
        self._lock = threading.Lock()

    def add(self, camera, counter, found, stamp=None):
        """`found` has the values in the order of FIELDS; the stamp is not checked."""
        now = time.monotonic()
        with self._lock:
            run = round(found[1] * 1000)
            newest = self.newest.get(run, 0)
            number = counter if self._has_counter else _unwrapped(round(found[0] * 1000), newest)
            if camera != self.camera or not self._is_same(found, values(camera, run, number)):
                self._note(f"not sent: camera {camera}, counter {counter}, {found}")
            elif number <= newest:
                self._note(f"{'twice' if number == newest else 'out of order'}: run {run}, {number} after {newest}")
            if not self.runs or self.runs[-1] != run:
                self.runs.append(run)
            self.newest[run] = number
            self.count += 1
            self.last_time = now

    def add_json(self, record):
        """A line of `trk dump --json`, as an object."""
        found = {**record, **record["euler"]}
        self.add(record["id"], record["counter"], tuple(float(found[field]) for field in FIELDS))

    def has_passed(self, run, number):
        return self.newest.get(run, 0) > number

    def _is_same(self, found, sent):
        if self._error is None:
            return found == sent
        return all(abs(a - b) <= error for a, b, error in zip(found, sent, self._error))

    def _note(self, text):
        if len(self.wrong) < 5:
            self.wrong.append(text)


def _unwrapped(number, newest):
    """The number nearest to `newest` among those with the same values."""
    number += newest - newest % MOST
    return number + MOST if number + MOST // 2 < newest else number
