#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Tests of the checks that faults and soak use: they find what is wrong."""

import random
import unittest

import sets
import trackers
import verdict
from counts import Counts


def arrivals(*numbers, run=1):
    one = sets.Arrivals(3)
    for number in numbers:
        one.add(3, number, sets.values(3, run, number))
    return one


class WhatArrives(unittest.TestCase):
    def test_a_part_in_order_is_right(self):
        self.assertEqual(arrivals(1, 2, 5, 9).wrong, [])

    def test_twice(self):
        self.assertIn("twice", arrivals(1, 2, 2).wrong[0])

    def test_out_of_order(self):
        self.assertIn("out of order", arrivals(1, 3, 2).wrong[0])

    def test_one_value_that_differs_in_its_last_bit(self):
        for index in range(len(sets.FIELDS)):
            found = list(sets.values(3, 1, 7))
            found[index] += 2e-16 + abs(found[index]) * 3e-16
            one = sets.Arrivals(3)
            one.add(3, 7, tuple(found))
            self.assertIn("not sent", one.wrong[0], sets.FIELDS[index])

    def test_another_camera(self):
        one = sets.Arrivals(4)
        one.add(3, 1, sets.values(3, 1, 1))
        self.assertIn("not sent", one.wrong[0])

    def test_a_new_run_begins_again(self):
        one = arrivals(1, 2)
        one.add(3, 1, sets.values(3, 2, 1))
        self.assertEqual((one.wrong, one.runs), ([], [1, 2]))

    def test_without_counter_the_number_is_that_of_the_values_also_when_they_begin_again(self):
        one = sets.Arrivals(3, has_counter=False, error=sets.FREE_D_ERROR)
        for number in (sets.MOST - 1, sets.MOST, sets.MOST + 1):
            one.add(3, 1, sets.values(3, 1, number))
        self.assertEqual((one.wrong, one.newest), ([], {1: sets.MOST + 1}))

    def test_a_datagram_has_the_run_and_the_number_that_it_was_made_of(self):
        self.assertEqual(sets.number_of(sets.params(3, 12, 345)), (12, 345))


class WhatDiagnosticsMustShow(unittest.TestCase):
    def expect(self, numbers, **counts):
        self.assertEqual(Counts.of(numbers), Counts(**counts))

    def test_lost(self):
        self.expect([(1, 1), (1, 2), (1, 5)], received=3, lost=2)

    def test_late_ones_are_not_lost(self):
        self.expect([(1, 1), (1, 3), (1, 2)], received=2, late=1)

    def test_what_is_older_than_the_first_was_never_lost(self):
        self.expect([(1, 3), (1, 2)], received=1, late=1)

    def test_duplicates_of_new_and_of_late_ones(self):
        self.expect([(1, 1), (1, 1), (1, 3), (1, 2), (1, 2)], received=2, late=1, duplicate=2)

    def test_a_restart(self):
        self.expect([(1, 7), (2, 1), (2, 2)], received=3, restarts=1)


class Damage(unittest.TestCase):
    def test_of_text_is_never_a_record_of_so_many_numbers(self):
        rng = random.Random(1)
        datagram = sets.params(1, 2, 3456)
        for _ in range(2000):
            damaged = trackers.damage_text(datagram, rng)
            with self.assertRaises((ValueError, IndexError), msg=damaged):
                if not damaged.startswith(b"DMC01\0PAI"):
                    raise ValueError
                words = damaged[9:].rstrip(b"\0").decode("ascii").split()
                int(words[0]), int(words[1], 16), [float(word) for word in words[2:15]], int(words[15])

    def test_of_a_byte_changes_it(self):
        rng = random.Random(1)
        for _ in range(1000):
            self.assertNotEqual(trackers.damage_byte(b"\0\1\2", rng), b"\0\1\2")


class Flat(unittest.TestCase):
    KEY = "pss node"

    def is_flat(self, values, key=KEY):
        rows = [{"time": 10.0 * (index + 1), key: value} for index, value in enumerate(values)]
        return verdict.classify(rows)[1]

    def test_noise_and_single_peaks_are_flat(self):
        rng = random.Random(1)
        self.assertTrue(self.is_flat([20 + 0.2 * rng.random() + 30 * (index == 50) for index in range(100)]))

    def test_growth_is_not(self):
        self.assertFalse(self.is_flat([20 + 0.02 * index for index in range(100)]))

    def test_a_step_is_not(self):
        self.assertFalse(self.is_flat([20 if index < 70 else 23 for index in range(100)]))

    def test_growth_while_caches_fill_is(self):
        self.assertTrue(self.is_flat([10 if index < 10 else 20 for index in range(100)]))

    def test_one_descriptor_more_is_not(self):
        self.assertFalse(self.is_flat([20 if index < 50 else 21 for index in range(100)], "descriptors node"))

    def test_a_camera_that_stops(self):
        rows = [{"rate a": 120, "rate b": rate} for rate in (120, 0, 110, 0, 0, 120)]
        self.assertEqual(list(verdict.stopped(rows)), ["b stopped"])


if __name__ == "__main__":
    unittest.main()
