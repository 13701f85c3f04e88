#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Makes faults on purpose, in a sandbox, and checks what arrives (doc/faults.md)."""

import argparse
import pathlib
import random
import sys
import tempfile
import time
import traceback

import sandbox

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "test/support"))
from text_table import aligned  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    sandbox.add_build_arguments(parser, ROOT / "build")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--short", action="store_true", help="at most two minutes; the default")
    form.add_argument("--long", action="store_true", help="with 1,000 kills")
    parser.add_argument("--seed", type=int, help="of all random values; default: a new one each time")
    parser.add_argument("--list", action="store_true", help="list the cases")
    parser.add_argument("--recovery", type=float, help="seconds that a recovery may take; default: 2 with --long, else 120")
    parser.add_argument("--kills", type=int, help="kill -9 of all cases together; default: 1000 with --long, else 20")
    parser.add_argument("cases", nargs="*", metavar="CASE", help="default: all")
    options = parser.parse_args()
    sandbox.enter(options, ROOT)
    # They import ROS, which --help does not need.
    from cases import CASES
    from testbed import Testbed, Result

    if options.list:
        for name, function in CASES.items():
            print(f"{name:28} {function.__doc__}")
        return 0
    unknown = [name for name in options.cases if name not in CASES]
    if unknown:
        parser.error(f"no case {', '.join(unknown)}; there are {', '.join(CASES)}")
    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(1 << 32)
    print(f"seed {seed}", flush=True)
    most_recovery = options.recovery or (2 if options.long else 120)
    begin = time.monotonic()
    rows = [("case", "sent", "arrived", "lost", "duplicates", "recovery", "result")]
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        testbed = Testbed(options.devel, ROOT, pathlib.Path(folder), options.long,
                                options.kills or (1000 if options.long else 20))
        for name in options.cases or CASES:
            testbed.rng = random.Random(f"{seed} {name}")
            left = []
            try:
                with testbed.leaving_nothing(left):
                    result = CASES[name](testbed)
            except Exception as error:  # the other cases continue
                traceback.print_exc()
                result = Result(wrong=[str(error)])
            result.wrong += left
            if result.recovery is not None:
                result.expect(result.recovery <= most_recovery,
                              f"recovery after {result.recovery:.2f} s, allowed {most_recovery:g} s")
            failed += bool(result.wrong)
            rows.append((name, str(result.sent), str(result.arrived), str(result.lost), str(result.duplicates),
                         "" if result.recovery is None else f"{result.recovery:.2f} s",
                         "; ".join(result.wrong) or "; ".join(filter(None, ["ok", result.note]))))
            print(f"{name}: {rows[-1][-1]}", file=sys.stderr, flush=True)
    print("\n".join(aligned(rows, left=(0, -1))))
    print(f"{time.monotonic() - begin:.0f} s")
    print(f"{len(rows) - 1 - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
