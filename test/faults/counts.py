# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""What /diagnostics must show for the sets that were received."""

from dataclasses import dataclass

# Keys of /diagnostics for the members of Counts, and for malformed records.
SHOWN = {"received": "received", "lost": "lost", "duplicate": "duplicate", "late": "out of order",
          "restarts": "restarts", "malformed": "malformed"}


@dataclass
class Counts:
    """What /diagnostics must show for sets in this order of arrival: [(run, number), …]. A new run is a restart."""
    received: int = 0
    lost: int = 0
    duplicate: int = 0
    late: int = 0
    restarts: int = 0

    @classmethod
    def of(cls, emitted):
        counts, received, newest = cls(), set(), None
        for run, number in emitted:
            if newest is None or run != newest[0]:
                counts.restarts += newest is not None
                counts.received += 1
                received, first, newest = {number}, number, (run, number)
            elif number > newest[1]:
                counts.received += 1
                counts.lost += number - newest[1] - 1
                newest = (run, number)
            elif number in received:
                counts.duplicate += 1
            else:
                counts.late += 1
                counts.lost -= number > first
            received.add(number)
        return counts
