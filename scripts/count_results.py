#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Summarises a ctest run of this project in one line, "N passed, N failed", and exits with 1 if anything failed.

Usage: count_results.py BUILD [STEP...]. Tests that catkin runs leave a JUnit file of their cases in BUILD/test_results;
every other test of ctest counts as one case. A test that failed without a failed case (it crashed, or left no file) counts as
one failure, as does each STEP, the name of something else that failed. It is a failure if no test ran at all.
"""

import pathlib
import re
import sys
import xml.etree.ElementTree


def cases_of(results):
    """(passed, failed) over the JUnit files below a folder."""
    passed = failed = 0
    for path in sorted(results.rglob("*.xml")):
        # rostest writes an extra file that only says that the test left a result.
        if path.name.startswith("rostest-") and not _has_failure(path):
            continue
        for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
            if case.find("failure") is not None or case.find("error") is not None:
                failed += 1
            elif case.find("skipped") is None and case.get("status") != "notrun":
                passed += 1
    return passed, failed


def _has_failure(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    return any(case.find("failure") is not None or case.find("error") is not None for case in root.iter("testcase"))


def ctests_of(build):
    """Names of the tests that ctest ran, and of those that failed."""
    log = build / "Testing" / "Temporary" / "LastTest.log"
    ran = re.findall(r"^\d+/\d+ Test: (\S+)$", log.read_text(errors="replace"), re.MULTILINE) if log.exists() else []
    failures = build / "Testing" / "Temporary" / "LastTestsFailed.log"
    failed = [line.split(":", 1)[1] for line in failures.read_text().splitlines()] if failures.exists() else []
    return ran, failed


def main():
    build, steps = pathlib.Path(sys.argv[1]), sys.argv[2:]
    passed, failed = cases_of(build / "test_results")
    ran, broken = ctests_of(build)
    with_cases = [name for name in ran if name.startswith("_ctest_")]
    plain = [name for name in ran if name not in with_cases]
    passed += len([name for name in plain if name not in broken])
    failed += len([name for name in plain if name in broken])
    if failed == 0:
        failed += len([name for name in with_cases if name in broken])
    failed += len(steps)
    if not ran:
        print("count_results: ctest's log has no test", file=sys.stderr)
        failed += 1
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
