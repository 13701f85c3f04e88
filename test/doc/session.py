# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Runs commands like a person with several terminals."""

import contextlib
import os
import pathlib
import re
import shlex
import signal
import subprocess
import time
import uuid

LEFT_BY = "TRK_BRIDGE_PAGE_TEST"  # an environment variable that marks the processes of a page's commands

# Output of programs and of roslaunch about errors that no exit code reports.
_BAD_SIGNS = ("process has died", "escalating to SIGTERM", "Traceback (most recent call last)")

# roslaunch writes to its log in its signal handler. If Ctrl-C comes while it is writing to it, Python's logging reports
# this, and nothing else happens.
_WITHIN_ONE_ERROR = r"(?:(?!--- Logging error ---|Traceback ).)*?"
_REENTRANT_LOG = re.compile(r"--- Logging error ---\nTraceback " + _WITHIN_ONE_ERROR + r"\nRuntimeError: reentrant call " +
                            _WITHIN_ONE_ERROR + r"\nArguments: [^\n]*\n", re.DOTALL)


class CommandError(Exception):
    """A command did not do what its page says. Contains its output."""


def wait_for(condition, seconds):
    """Polls `condition` and returns its first true value; after `seconds`, its last value."""
    deadline = time.monotonic() + seconds
    while True:
        value = condition()
        if value or time.monotonic() > deadline:
            return value
        time.sleep(0.02)


class Command:
    """A shell with the commands of one block, in a separate process group, like in a separate terminal."""

    def __init__(self, text, environment, folder, log):
        self.text = text
        self._log = log
        with open(log, "wb") as output:
            self._process = subprocess.Popen(["bash", "-e", "-c", text], env=environment, cwd=folder,
                                             stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                             start_new_session=True)

    def output(self):
        return self._log.read_text(errors="replace")

    def code(self):
        """None while it runs."""
        return self._process.poll()

    def fail(self, why):
        raise CommandError(f"{self.text.strip()}\n  {why}; it printed:\n{self.output()[-6000:]}")

    def wait(self, seconds):
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(seconds)
        if self.code() is None:
            self.kill()
            self.fail(f"has not ended within {seconds} s")
        return self.code()

    def wait_for_output(self, text, seconds):
        wait_for(lambda: text in self.output() or self.code() is not None, seconds)
        # Output just before its end is also checked.
        if text not in self.output():
            self.fail(f"has not printed '{text}' within {seconds} s" if self.code() is None else
                      f"has ended with {self.code()} before it printed '{text}'")

    def interrupt(self, seconds):
        """Ctrl-C. It must still be running, and end with exit code 0."""
        if self.code() is not None:
            self.fail(f"has ended by itself with {self.code()}")
        os.killpg(self._process.pid, signal.SIGINT)
        if self.wait(seconds) != 0:
            self.fail(f"ended with {self.code()} after Ctrl-C")
        self.check_signs()

    def check_signs(self):
        output = _REENTRANT_LOG.sub("", self.output())
        for sign in _BAD_SIGNS:
            if sign in output:
                self.fail(f"says '{sign}'")

    def kill(self):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()


class Terminals:
    """The terminals of a reader of one page: its background processes and their environment."""

    PATIENCE = 600  # s, for a command to end or to print the expected text, also on a busy machine
    LEAVING = 10  # s, for the processes of commands to end with them

    def __init__(self, environment, folder, logs):
        self._mark = uuid.uuid4().hex
        self._environment = {**environment, LEFT_BY: self._mark}
        self._folder = folder
        self._logs = pathlib.Path(logs)
        self._background = []
        self._started = 0

    def _start(self, text):
        self._started += 1
        return Command(text, self._environment, self._folder, self._logs / f"{self._mark}.{self._started}")

    def run(self, text, prints="", fails=False):
        command = self._start(text)
        code = command.wait(self.PATIENCE)
        if (code != 0) != fails:
            command.fail(f"ended with {code}")
        if prints and prints not in command.output():
            command.fail(f"has not printed '{prints}'")
        if not fails:
            command.check_signs()

    def run_in_background(self, text, until):
        command = self._start(text)
        self._background.append(command)
        if until:
            command.wait_for_output(until, self.PATIENCE)

    def check_syntax(self, text):
        self.run("bash -n -c " + shlex.quote(text))

    def running(self):
        """The background processes, in the order in which they were started."""
        return [command.text.strip() for command in self._background]

    def end_all(self):
        """Ctrl-C in each terminal, the last first. No process of the commands may remain."""
        try:
            while self._background:
                self._background.pop().interrupt(30)
            if wait_for(lambda: not self._left(), self.LEAVING):
                return
            raise CommandError("left behind: " + ", ".join(self._left().values()))
        finally:
            while self._background:
                self._background.pop().kill()
            for pid in self._left():
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)

    def _left(self):
        """Command lines of the running processes that its commands have started, by pid."""
        wanted = f"{LEFT_BY}={self._mark}".encode()
        found = {}
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            # The process has ended, or belongs to another user.
            with contextlib.suppress(OSError):
                if wanted in (process / "environ").read_bytes().split(b"\0"):
                    line = (process / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
                    if line:
                        found[int(process.name)] = line
        return found
