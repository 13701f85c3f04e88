#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Runs the fuzzers of a tree, prints a table of what they found, and minimises their corpora. See scripts/fuzz."""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
from text_table import aligned  # noqa: E402

CORPORA = HERE / "corpus"
LONGEST_INPUT = 5000
# Seconds of wall time, in which an input that never ends is found; a machine with other work may stop a run for a while.
LONGEST_RUN = 1200
# For files of targets, which a finding leaves behind.
MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
HASH = re.compile("[0-9a-f]{40}")


def cpu_seconds(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii") as stat:
        fields = stat.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Target:
    def __init__(self, tree, name):
        self.name = name
        self.program = tree / "test" / "fuzz" / f"{name}_fuzz"
        self.seeds = CORPORA / name
        self.corpus = tree / "corpus" / name
        self.findings = tree / "findings"
        self.log = tree / "logs" / f"{name}.log"
        for folder in (self.corpus, self.findings, self.log.parent):
            folder.mkdir(parents=True, exist_ok=True)
        self.failed = False

    def found(self):
        return sorted(self.findings.glob(f"{self.name}-*"))

    def run(self, seconds):
        """For `seconds` of CPU time, or to the first finding."""
        # What was found before is tried first.
        for finding in self.found():
            shutil.move(finding, self.corpus / finding.name)
        with open(self.log, "wb") as log, tempfile.TemporaryDirectory(dir=MEMORY) as files:
            process = subprocess.Popen(
                [self.program, f"-max_len={LONGEST_INPUT}", f"-timeout={LONGEST_RUN}",
                 f"-report_slow_units={LONGEST_RUN}", "-reload=0", "-print_final_stats=1",
                 f"-artifact_prefix={self.findings}/{self.name}-", self.corpus, self.seeds],
                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, cwd=files,
                env=dict(os.environ, TMPDIR=files))
            try:
                while process.poll() is None and cpu_seconds(process.pid) < seconds:
                    time.sleep(0.2)
            except BaseException:
                process.kill()
                raise
            process.send_signal(signal.SIGUSR1)  # libFuzzer ends in order
            self.failed = process.wait() != 0
        return self

    def row(self):
        log = self.log.read_text(errors="replace")
        features = re.findall(r" ft: (\d+) ", log)
        runs = re.findall(r"stat::number_of_executed_units: *(\d+)", log)
        files = len(list(self.corpus.iterdir())) + len(list(self.seeds.iterdir()))
        return [self.name, runs[-1] if runs else "-", str(files), features[-1] if features else "-",
                str(max(len(self.found()), int(self.failed)))]

    def minimise(self):
        """Named seeds stay; of all else what reaches code that they do not."""
        with tempfile.TemporaryDirectory() as others:
            for file in self.seeds.iterdir():
                if HASH.fullmatch(file.name):
                    shutil.move(file, others)
            # By reached code alone, not by how often it is run: that needs far fewer files.
            with open(self.log, "wb") as log:
                subprocess.run([self.program, "-set_cover_merge=1", "-use_counters=0", f"-max_len={LONGEST_INPUT}",
                                self.seeds, others, self.corpus],
                               check=True, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                               cwd=self.log.parent)
        sizes = [file.stat().st_size for file in self.seeds.iterdir()]
        return [self.name, str(len(sizes)), str(sum(sizes))]


def main():
    parser = argparse.ArgumentParser(prog="scripts/fuzz")
    parser.add_argument("--tree", type=pathlib.Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--jobs", type=int, default=1, help=argparse.SUPPRESS)
    parser.add_argument("--minimise", action="store_true")
    parser.add_argument("words", nargs="*", metavar="SECONDS TARGET")
    given = parser.parse_args()
    seconds = 0 if given.minimise else int(given.words.pop(0))
    known = (given.tree / "test" / "fuzz" / "targets").read_text(encoding="ascii").split()
    unknown = set(given.words) - set(known)
    if unknown:
        sys.exit(f"scripts/fuzz: no target {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    targets = [Target(given.tree, name) for name in given.words or known]
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        if given.minimise:
            print("\n".join(aligned([["target", "files", "bytes"], *pool.map(Target.minimise, targets)])))
            return 0
        list(pool.map(lambda target: target.run(seconds), targets))
    header = ["target", "runs", "corpus files", "features", "findings"]
    print("\n".join(aligned([header, *(target.row() for target in targets)])))
    for target in targets:
        for finding in target.found():
            print(f"{target.name}: {target.program} {finding}")
        if target.failed:
            print(f"{target.name}: see {target.log}")
    return int(any(target.failed for target in targets))


if __name__ == "__main__":
    sys.exit(main())
