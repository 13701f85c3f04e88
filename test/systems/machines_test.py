#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Programs on machines that lack something work, or say exactly what is wrong.

machines_test.py --trk PROGRAM --write-mem PROGRAM --no-ipv6 LIBRARY --take FILE --lens FILE. Each machine is this one in namespaces of its
own, so that nothing here changes. Exits 77, with the reason, where the system lets a process have none.
"""

import argparse
import os
import re
import subprocess
import sys
import unittest

SKIPPED = 77  # SKIP_RETURN_CODE of ctest
# The files of slots are shared with other tests, which take slots from 61 downwards (test/support/free_slot.h).
SLOT, SLOT_FILE = 30, "/tmp/dmc_tracking_buffer.U"
DEADLINE = 600  # seconds

NAMESPACES = ["unshare", *([] if os.geteuid() == 0 else ["--map-root-user"]), "--net", "--ipc", "--mount", "--uts"]

IPV6_OFF = """
for file in /proc/sys/net/ipv6/conf/*/disable_ipv6; do
  if [ -e "$file" ]; then echo 1 > "$file"; fi
done"""
# Programs find no other shared memory than that of System V.
NO_DEV_SHM = "mount -t tmpfs -o ro none /dev/shm"
READ_ONLY_TMP = "mount --bind /tmp /tmp; mount -o remount,bind,ro /tmp"
NAME_WITHOUT_ADDRESS = "echo nowhere.invalid > /proc/sys/kernel/hostname"


class Machine(unittest.TestCase):
    environment = {}

    def run_on(self, machine, script, expected=0):
        """What a shell prints, both outputs in order, on a machine that `machine` has made so."""
        result = subprocess.run([*NAMESPACES, "sh", "-ec", f"ip link set lo up\n{machine}\n{script}"], text=True, check=False,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=DEADLINE,
                                env={**os.environ, **self.environment})
        self.assertEqual(result.returncode, expected, result.stdout)
        return result.stdout

    def assert_received(self, machine, source, sink):
        """A take that is sent to the sink arrives at the source."""
        output = self.run_on(machine, f"""
            "$TRK" relay "file:$TAKE?loop=1" '{sink}' > /dev/null 2>&1 &
            "$TRK" dump '{source}' --count 5 2> /dev/null
            kill $!
            wait $! || [ $? = 143 ]""")
        self.assertEqual(len(re.findall(" id 7 (params|constants)", output)), 5, output)


class WithoutIpv6(Machine):
    def test_ipv4_is_received_on_every_interface(self):
        self.assert_received(IPV6_OFF, "udp://:7000", "udp://127.0.0.1:7000?id=7")
        self.assert_received(IPV6_OFF, "udp://localhost:7000", "udp://localhost:7000?id=7")

    def test_an_address_that_is_missing_is_named(self):
        output = self.run_on(IPV6_OFF, "\"$TRK\" dump 'udp://[::1]:7000' --seconds 0.1", expected=3)
        self.assertIn("no interface that is up has the address ::1", output)

    def test_a_group_names_what_is_missing(self):
        output = self.run_on(IPV6_OFF, "\"$TRK\" dump 'udp://[ff15::9]:7000' --seconds 0.1", expected=3)
        self.assertIn("no interface that is up receives multicast of IPv6", output)

    def test_sending_says_what_the_system_refused(self):
        output = self.run_on(IPV6_OFF, "\"$TRK\" relay \"file:$TAKE?speed=0\" 'udp://[::1]:7000'", expected=1)
        self.assertIn("udp to [::1]:7000: the system refused: Cannot assign requested address", output)


class WithoutIpv6InTheKernel(Machine):
    """As after ipv6.disable=1."""
    def preload(self):
        return f"export LD_PRELOAD={self.environment['NO_IPV6']}"

    def test_ipv4_is_received_on_every_interface(self):
        self.assert_received(self.preload(), "udp://:7000", "udp://127.0.0.1:7000?id=7")

    def test_an_address_is_refused_with_the_reason(self):
        for words in ("dump 'udp://[::1]:7000'", "relay \"file:$TAKE\" 'udp://[::1]:7000'"):
            output = self.run_on(self.preload(), f'"$TRK" {words}', expected=1)
            self.assertRegex(output, r"error: .*\[::1\]:7000.*Address family not supported by protocol")


class WithoutDevShm(Machine):
    def test_shared_memory_needs_none(self):
        self.assert_received(NO_DEV_SHM, f"shm:{SLOT}", f"shm:{SLOT}?id=7")


class WithReadOnlyTmp(Machine):
    def test_a_slot_that_cannot_be_made_is_named(self):
        output = self.run_on(READ_ONLY_TMP, f'"$TRK" relay "file:$TAKE?speed=0" shm:{SLOT}', expected=1)
        self.assertIn(f"shm slot {SLOT}: {SLOT_FILE}: Read-only file system", output)
        self.assertIn(f"slot {SLOT}", self.run_on(READ_ONLY_TMP, f'"$WRITE_MEM" {SLOT}', expected=1))

    def test_files_that_cannot_be_written_are_named(self):
        output = self.run_on(READ_ONLY_TMP, '"$TRK" relay "file:$TAKE?speed=0" file:/tmp/trk_bridge_test.trk', expected=1)
        self.assertIn("/tmp/trk_bridge_test.trk: cannot be written: the system refused: Read-only file system", output)
        output = self.run_on(READ_ONLY_TMP, '"$TRK" lens "$LENS" --plot /tmp/trk_bridge_test.svg', expected=1)
        self.assertIn("/tmp/trk_bridge_test.svg: cannot be written: Read-only file system", output)

    def test_networks_need_no_tmp(self):
        self.assert_received(READ_ONLY_TMP, "udp://:7000", "udp://127.0.0.1:7000?id=7")


class WithANameWithoutAddress(Machine):
    def test_programs_do_not_ask_for_it(self):
        self.assert_received(NAME_WITHOUT_ADDRESS, "udp://:7000", "udp://127.0.0.1:7000?id=7")
        self.assert_received(NAME_WITHOUT_ADDRESS, "opentrackio://127.0.0.1:55555", "opentrackio://127.0.0.1:55555?id=7")

    def test_a_host_that_resolves_to_nothing_is_named(self):
        for words in ('dump "udp://$(uname -n):7000"', 'relay "file:$TAKE" "udp://$(uname -n):7000"'):
            output = self.run_on(NAME_WITHOUT_ADDRESS, f'"$TRK" {words}', expected=1)
            self.assertRegex(output, r'error: udp://nowhere.invalid:7000: host "nowhere.invalid": .*name')


def main():
    parser = argparse.ArgumentParser()
    for name in ("trk", "write-mem", "no-ipv6", "take", "lens"):
        parser.add_argument(f"--{name}", required=True)
    arguments, rest = parser.parse_known_args()
    possible = subprocess.run([*NAMESPACES, "true"], capture_output=True, text=True, check=False)
    if possible.returncode != 0:
        print(f"skipped: no namespaces: {possible.stderr.strip()}")
        sys.exit(SKIPPED)
    Machine.environment = {"TRK": arguments.trk, "WRITE_MEM": arguments.write_mem, "NO_IPV6": arguments.no_ipv6,
                           "TAKE": arguments.take, "LENS": arguments.lens, "LC_ALL": "C.UTF-8"}
    unittest.main(argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
