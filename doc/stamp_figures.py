#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Measures the stamps of doc/time.md: makes signals of a tracker behind a network, and asks stamp_replay for its stamps.

Usage: stamp_figures.py STAMP_REPLAY [--check]. Writes doc/stamps.csv (ratios for every jitter and rate) and
doc/stamps_plot.csv (what the plots show), and prints the rows of the page's table. With --check it writes nothing, and
files or a page that are not what was measured are an error. Needs nothing but Python.
"""

import csv
import io
import math
import pathlib
import random
import subprocess
import sys

DOC = pathlib.Path(__file__).resolve().parent
BEGIN = 1_700_000_000_000_000_000  # ns
DELAY, SIGMA, PPM = 30e6, 2e6, 100  # ns, ns, parts per million
RATES = {"50": 50, "59.94": 60000 / 1001, "119.88": 120000 / 1001}
SEEDS, SECONDS = 4, 180
WINDOWS = (10, 40, 90)  # s, from there to the end

MIXED_MEAN = math.sqrt(2 / math.pi) * (0.95 + 0.05 * 10)
MIXED_SIGMA = math.sqrt(0.95 + 0.05 * 100 - MIXED_MEAN ** 2)


def mixed(rng):
    return abs(rng.gauss(0, 1)) * (10 if rng.random() < 0.05 else 1) / MIXED_SIGMA


# Each of standard deviation 1.
JITTERS = {
    "gauss": lambda rng: rng.gauss(0, 1),
    "uniform": lambda rng: math.sqrt(12) * (rng.random() - 0.5),
    "exponential": lambda rng: rng.expovariate(1),
    "mixed": mixed,
}


def same(value):
    return value


def nothing(_):
    return 0


def signal(jitter, rate, seconds, seed, counter=same, moved=nothing, late=nothing, stall=None):
    """(counter, time in ns, arrival) in the order of arrival: 1 % lost, 1 % twice. `moved` and `late` are ns at a time of
    sampling in s, `stall` is (from, to) in s: what would arrive in between comes in a burst at its end."""
    rng = random.Random(f"{jitter} {rate} {seed}")
    draw, interval = JITTERS[jitter], 1e9 / rate * (1 + 1e-6 * PPM)
    samples = []
    for n in range(int(seconds * 1e9 / interval)):
        time = n * interval
        time += moved(time / 1e9)
        arrival = BEGIN + round(time + DELAY + SIGMA * draw(rng) + late(time / 1e9))
        is_lost, comes_twice = rng.random() < 0.01, rng.random() < 0.01
        if is_lost:
            continue
        samples.append((counter(n), time, arrival))
        if comes_twice:
            samples.append((counter(n), time, arrival + 3_000_000))
    samples.sort(key=lambda sample: sample[2])
    if stall:
        held, released = (BEGIN + round(at * 1e9) for at in stall)
        for i, (count, time, arrival) in enumerate(samples):
            if held <= arrival < released:
                released += 20_000
                samples[i] = (count, time, released)
    return samples


def stamped(program, samples):
    """(time in s, lateness of arrival in ms, of stamp in ms) of those that got a stamp."""
    text = "".join(f"{count} {arrival}\n" for count, _, arrival in samples)
    out = subprocess.run([program], input=text, check=True, capture_output=True, text=True).stdout
    rows, at = [], 0
    for line in out.splitlines():
        count, stamp = map(int, line.split())
        while samples[at][0] != count:
            at += 1
        _, time, arrival = samples[at]
        at += 1
        rows.append((time / 1e9, (arrival - BEGIN - time) / 1e6, (stamp - BEGIN - time) / 1e6))
    return rows


def variance(values):
    mean = sum(values) / len(values)
    return sum((value - mean) ** 2 for value in values) / len(values)


def ratios(program):
    """Root mean square of arrivals over that of stamps, constant offset removed; over all seeds."""
    rows = []
    for jitter in JITTERS:
        for name, rate in RATES.items():
            sums = {begin: [0.0, 0.0] for begin in WINDOWS}
            for seed in range(SEEDS):
                all_rows = stamped(program, signal(jitter, rate, SECONDS, seed))
                for begin, total in sums.items():
                    chosen = [row for row in all_rows if row[0] >= begin]
                    total[0] += variance([row[1] for row in chosen])
                    total[1] += variance([row[2] for row in chosen])
            rows.append({"jitter": jitter, "rate": name,
                         **{f"from_{begin}": f"{math.sqrt(a / s):.1f}" for begin, (a, s) in sums.items()}})
    return rows


def plotted(program):
    """One camera of 50 Hz with exponential jitter: what the four plots show."""
    def after(at, value):
        return lambda time: value if time >= at else 0

    restart = 3000  # the 60th second
    cases = {
        "start": ((0, 12), signal("exponential", 50, 12, 1)),
        "stall": ((59, 62), signal("exponential", 50, 62, 1, stall=(60, 60.3))),
        "step": ((58, 70), signal("exponential", 50, 70, 1, late=after(60, 5e6))),
        "restart": ((58, 70), signal("exponential", 50, 70, 1, counter=lambda n: n + 5000 if n < restart else n - restart,
                                     moved=after(60.006, 7.4e6))),
    }
    rows = []
    for case, ((begin, end), samples) in cases.items():
        for time, arrival, stamp in stamped(program, samples):
            if begin <= time < end:
                rows.append({"case": case, "time": f"{time:.2f}", "arrival": f"{arrival:.2f}", "stamp": f"{stamp:.2f}"})
    return rows


def text_of(rows):
    out = io.StringIO()
    writer = csv.DictWriter(out, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()


def table(rows):
    return [f"| {row['jitter']} | {row['rate']} | " + " | ".join(row[f"from_{begin}"] for begin in WINDOWS) + " |"
            for row in rows]


def is_near(old, new):
    try:
        return abs(float(old) - float(new)) <= 0.05 + 0.02 * abs(float(new))
    except ValueError:
        return old == new


def differences(path, rows):
    with path.open(newline="", encoding="utf-8") as file:
        old = list(csv.DictReader(file))
    if len(old) != len(rows):
        yield f"{path}: {len(old)} rows, measured were {len(rows)}"
    for line, (was, row) in enumerate(zip(old, rows), start=2):
        for column, value in row.items():
            if not is_near(was.get(column, ""), value):
                yield f"{path}:{line}: {column} is {was.get(column)}, measured was {value}"


def main(arguments):
    if len(arguments) not in (1, 2) or arguments[1:] not in ([], ["--check"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    measured = {"stamps.csv": ratios(arguments[0]), "stamps_plot.csv": plotted(arguments[0])}
    if arguments[1:]:
        found = [text for name, rows in measured.items() for text in differences(DOC / name, rows)]
        with (DOC / "stamps.csv").open(newline="", encoding="utf-8") as file:
            page = (DOC / "time.md").read_text(encoding="utf-8").splitlines()
            found += [f"time.md: no row {row}" for row in table(csv.DictReader(file)) if row not in page]
        for text in found:
            print(text, file=sys.stderr)
        return 1 if found else 0
    for name, rows in measured.items():
        (DOC / name).write_text(text_of(rows), encoding="utf-8")
    print("\n".join(table(measured["stamps.csv"])))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
