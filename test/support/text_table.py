# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Tables as text, for programs that print results."""


def aligned(rows, left=(0,)):
    """Lines with aligned columns. `left`: the indices of columns that are aligned to the left, as -1 for the last."""
    left = {column % len(rows[0]) for column in left}
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return ["  ".join(text.ljust(width) if column in left else text.rjust(width)
                      for column, (text, width) in enumerate(zip(row, widths))).rstrip() for row in rows]
