# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Programs as processes that a test starts, kills and waits for."""

import contextlib
import json
import pathlib
import signal
import socket
import subprocess
import sys
import threading
import time

_TRACKERS = pathlib.Path(__file__).resolve().parent / "trackers.py"
PATIENCE = 300  # s; what is waited for takes a moment, but the machine may be busy with other work


class Failure(Exception):
    """A fault that a case has found."""


def wait_for(condition, what, seconds=PATIENCE):
    """The first true value of `condition`. Time in which this process did not run does not count."""
    waited, last = 0.0, time.monotonic()
    while True:
        value = condition()
        if value:
            return value
        if waited > seconds:
            raise Failure(f"not within {seconds} s: {what}")
        time.sleep(0.01)
        now = time.monotonic()
        waited, last = waited + min(now - last, 0.5), now


def wait_until_still(value, seconds=0.5):
    """Waits until `value()` has not changed for this time."""
    last, since = value(), time.monotonic()

    def is_still():
        nonlocal last, since
        now = value()
        if now != last:
            last, since = now, time.monotonic()
        return time.monotonic() - since > seconds
    wait_for(is_still, f"nothing changes for {seconds} s")


_given_ports = set()


def free_port(kind=socket.SOCK_DGRAM):
    """A port that this function has not returned before. Nothing else in the sandbox uses ports."""
    while True:
        with socket.socket(socket.AF_INET, kind) as one:
            one.bind(("127.0.0.1", 0))
            port = one.getsockname()[1]
        if port not in _given_ports:
            _given_ports.add(port)
            return port


class Process:
    """A running program. What it prints on standard error goes into `log`; `on_line` gets the lines of standard output."""

    def __init__(self, command, log, on_line=None):
        self.command = [str(word) for word in command]
        self.log = pathlib.Path(log)
        with self.log.open("ab") as err:
            self._popen = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stderr=err,
                                           stdout=subprocess.PIPE if on_line else err)
        self.pid = self._popen.pid
        self._reader = None
        if on_line:
            self._reader = threading.Thread(target=self._read, args=(on_line,), daemon=True)
            self._reader.start()

    def _read(self, on_line):
        for line in self._popen.stdout:
            # A killed program can leave an incomplete line.
            if line.endswith(b"\n"):
                on_line(line.decode())

    def code(self):
        """None while it runs."""
        return self._popen.poll()

    def kill(self):
        """Like kill -9."""
        self._popen.kill()
        self._wait()

    def end(self, seconds=PATIENCE):
        """Like Ctrl-C. The exit code."""
        with contextlib.suppress(ProcessLookupError):
            self._popen.send_signal(signal.SIGINT)
        try:
            self._wait(seconds)
        except subprocess.TimeoutExpired:
            self.kill()
            raise Failure(f"does not end within {seconds} s: {' '.join(self.command)}") from None
        return self.code()

    def wait(self, seconds=PATIENCE):
        self._wait(seconds)
        return self.code()

    def pause(self, seconds):
        """Stops the process for this time."""
        self._popen.send_signal(signal.SIGSTOP)
        time.sleep(seconds)
        self._popen.send_signal(signal.SIGCONT)

    def usage(self):
        """Memory in MiB, descriptors and threads."""
        folder = pathlib.Path(f"/proc/{self.pid}")
        memory = dict(line.split(":", 1) for line in (folder / "smaps_rollup").read_text().splitlines()[1:])
        rss, pss = (int(memory[key].split()[0]) / 1024 for key in ("Rss", "Pss"))
        return {"rss": rss, "pss": pss, "descriptors": len(list((folder / "fd").iterdir())),
                "threads": len(list((folder / "task").iterdir()))}

    def output(self):
        return self.log.read_text(encoding="utf-8", errors="replace")

    def _wait(self, seconds=PATIENCE):
        self._popen.wait(seconds)
        if self._reader:
            self._reader.join(seconds)


class Programs:
    """The programs of a devel space."""

    def __init__(self, devel):
        self._folder = pathlib.Path(devel) / "lib/trk_bridge"

    def path(self, name):
        path = self._folder / name
        if not path.exists():
            raise SystemExit(f"no {path}: build first, or say --build")
        return path

    def process(self, name, *words, log, on_line=None):
        return Process([self.path(name), *words], log, on_line)

    def relay(self, source, *sinks, log):
        return self.process("trk", "relay", source, *sinks, log=log)

    def dump(self, source, arrivals, log):
        """Adds all sets that are received to `arrivals`."""
        def on_line(line):
            record = json.loads(line)
            if record["type"] == "params":
                arrivals.add_json(record)
        return self.process("trk", "dump", "--json", source, log=log, on_line=on_line)

    @staticmethod
    def tracker(rate, run, targets, log, on_line):
        """A separate process; `targets`: PORT:ID. At its end it prints how many sets it sent of each camera."""
        return Process([sys.executable, "-B", _TRACKERS, "tracker", rate, run, *targets], log, on_line)

    @staticmethod
    def flood(port, rate, seconds, seed, log, on_line):
        """A separate process. At its end it prints how many datagrams it sent, and in how many seconds."""
        return Process([sys.executable, "-B", _TRACKERS, "flood", port, rate, seconds, seed], log, on_line)

    def node(self, name, node_name, log):
        namespace, _, base = node_name.rpartition("/")
        return self.process(name, f"__ns:={namespace}", f"__name:={base}", log=log)
