#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Tests of session.py with commands that do not do what their page says."""

import os
import pathlib
import tempfile
import unittest

from session import CommandError, Terminals, wait_for


class Sessions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.terminals = Terminals({"PATH": os.environ["PATH"]}, self.folder, self.folder)

    def refused(self, why):
        return self.assertRaisesRegex(CommandError, why)

    def test_every_line_must_succeed(self):
        self.terminals.run("true\necho word >file\n")
        self.assertEqual((self.folder / "file").read_text(), "word\n")
        with self.refused("ended with 1"):
            self.terminals.run("false\ntrue\n")

    def test_what_is_to_fail_must_fail_and_say_so(self):
        self.terminals.run("echo no >&2; exit 3", prints="no", fails=True)
        with self.refused("ended with 0"):
            self.terminals.run("echo no", prints="no", fails=True)
        with self.refused("has not printed 'yes'"):
            self.terminals.run("echo no; exit 3", prints="yes", fails=True)

    def test_nodes_that_die_are_seen(self):
        with self.refused("says 'process has died'"):
            self.terminals.run("echo '[a-1] process has died [pid 1, exit code 1]'")

    def test_a_log_that_ctrl_c_interrupts_is_no_error_but_others_are(self):
        log = ("--- Logging error ---\nTraceback (most recent call last):\n  File \"handlers.py\", line 197\n"
               "RuntimeError: reentrant call inside <_io.BufferedWriter name='log'>\nCall stack:\n  File \"pmon.py\"\n"
               "Message: 'ProcessMonitor.shutdown'\nArguments: ()\n")
        (self.folder / "log").write_text(log + log)
        self.terminals.run("cat log")
        other = log.replace("reentrant call inside", "no space for")
        for text in (log + other, other + log, "Traceback (most recent call last):\nOSError\n" + log):
            (self.folder / "log").write_text(text)
            with self.refused("says 'Traceback"):
                self.terminals.run("cat log")

    def test_background_lives_until_ctrl_c(self):
        self.terminals.run_in_background("trap 'touch ended; exit 0' INT; echo up; while :; do sleep 0.05; done", "up")
        self.assertFalse((self.folder / "ended").exists())
        self.terminals.end_all()
        self.assertTrue((self.folder / "ended").exists())

    def test_background_goes_on_while_others_run_and_is_known(self):
        self.terminals.run_in_background("echo up; exec sleep 1000", "up")
        self.terminals.run("true")
        self.assertEqual(self.terminals.running(), ["echo up; exec sleep 1000"])
        with self.refused("ended with -2 after Ctrl-C"):
            self.terminals.end_all()
        self.assertEqual(self.terminals.running(), [])

    def test_background_that_ends_is_refused(self):
        with self.refused("has ended with 0 before it printed 'up'"):
            self.terminals.run_in_background("true", "up")
        with self.refused("has ended by itself with 0"):
            self.terminals.end_all()

    def test_background_that_ends_badly_is_refused(self):
        self.terminals.run_in_background("trap 'exit 4' INT; echo up; while :; do sleep 0.05; done", "up")
        with self.refused("ended with 4 after Ctrl-C"):
            self.terminals.end_all()

    def test_nothing_is_left_behind(self):
        self.terminals.LEAVING = 0.2
        # During exec, a process has neither environment nor command line.
        self.terminals.run("setsid sleep 1000 >/dev/null 2>&1 & echo $! >pid; "
                           "until [ \"$(cat /proc/$!/comm)\" = sleep ]; do sleep 0.01; done")
        with self.refused("left behind: sleep 1000"):
            self.terminals.end_all()
        command_line = pathlib.Path("/proc", (self.folder / "pid").read_text().strip(), "cmdline")
        # It has ended, or is a zombie.
        self.assertTrue(wait_for(lambda: not command_line.exists() or not command_line.read_bytes(), 5))

    def test_syntax(self):
        self.terminals.check_syntax("sudo tcpdump 'it'")
        with self.refused("unexpected"):
            self.terminals.check_syntax("if 'it")


if __name__ == "__main__":
    unittest.main()
