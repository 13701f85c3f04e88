#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Tests of pages.py: which command blocks it finds, and what it refuses."""

import pathlib
import tempfile
import unittest

from pages import Mark, PageError, blocks_of, has_commands, unknown_arguments


def page(*lines):
    return "\n".join(lines) + "\n"


class Marks(unittest.TestCase):
    def mark_of(self, mark):
        return blocks_of(page(mark, "```sh", "true", "```"))[0].mark

    def test_all_ways_to_run(self):
        self.assertEqual(self.mark_of("<!-- run -->"), Mark("run"))
        self.assertEqual(self.mark_of("<!-- run: prints a, b -->"), Mark("run", prints="a, b"))
        self.assertEqual(self.mark_of("<!-- run: fails, prints no: x -->"), Mark("run", prints="no: x", fails=True))
        self.assertEqual(self.mark_of("<!-- run: background -->"), Mark("background"))
        self.assertEqual(self.mark_of("<!-- run: background until 50 Hz -->"), Mark("background", "50 Hz"))
        self.assertEqual(self.mark_of("<!-- run by: scripts/test -->"), Mark("run by", "scripts/test"))
        self.assertEqual(self.mark_of("<!-- needs hardware: a tracker -->"), Mark("needs hardware", "a tracker"))

    def test_on_one_of_several_machines(self):
        self.assertEqual(self.mark_of("<!-- run on recorder -->"), Mark("run", machine="recorder"))
        self.assertEqual(self.mark_of("<!-- run on a: prints b -->"), Mark("run", prints="b", machine="a"))
        self.assertEqual(self.mark_of("<!-- run on a: background until b -->"), Mark("background", "b", machine="a"))

    def test_blank_lines_may_stand_between(self):
        self.assertEqual(blocks_of(page("<!-- run -->", "", "```sh", "true", "```"))[0].mark, Mark("run"))

    def test_marks_that_say_nothing_are_refused(self):
        for mark in ("<!-- run: -->", "<!-- run: later -->", "<!-- run: background then -->", "<!-- run by -->",
                     "<!-- run on a: later -->", "<!-- needs hardware: -->", "<!-- run: fails -->"):
            with self.subTest(mark), self.assertRaisesRegex(PageError, "line 1: "):
                self.mark_of(mark)

    def test_a_mark_belongs_to_one_fence(self):
        with self.assertRaisesRegex(PageError, "line 1: a mark without a fence"):
            blocks_of(page("<!-- run -->", "Words.", "```sh", "true", "```"))
        with self.assertRaisesRegex(PageError, "line 5: no mark says"):
            blocks_of(page("<!-- run -->", "```sh", "true", "```", "```sh", "true", "```"))


class Blocks(unittest.TestCase):
    def test_commands_without_a_mark_are_refused(self):
        for language in ("sh", "bash", "shell", "console"):
            with self.subTest(language), self.assertRaisesRegex(PageError, "line 2: no mark says"):
                blocks_of(page("Words.", f"```{language}", "true", "```"))

    def test_fences_without_a_language_are_refused(self):
        with self.assertRaisesRegex(PageError, "without a language"):
            blocks_of(page("```", "true", "```"))

    def test_indented_blocks_are_refused(self):
        for text in (page("Words:", "", "    ls"), page("Words:", "", "\tls"), page("- item", "", "        ls")):
            with self.subTest(text), self.assertRaisesRegex(PageError, "indented block"):
                blocks_of(text)

    def test_continued_text_is_no_block(self):
        self.assertEqual(blocks_of(page("- item", "  goes on", "", "  second paragraph", "", "Words", "    go on")), [])

    def test_fences_that_do_not_end_are_refused(self):
        with self.assertRaisesRegex(PageError, "line 1: a fence that does not end"):
            blocks_of(page("```text", "a"))

    def test_marks_are_for_commands(self):
        with self.assertRaisesRegex(PageError, "mark of commands"):
            blocks_of(page("<!-- run -->", "```text", "a", "```"))

    def test_lines_as_a_shell_reads_them(self):
        text = page("# Title", "## Part", "<!-- run -->", "```sh", "a \\", "  b", "# word", "", "c  # d", "```")
        block = blocks_of(text)[0]
        self.assertEqual((block.line, block.section, block.heading), (4, 2, "Part"))
        self.assertEqual(block.commands(), ["a b", "c  # d"])

    def test_fences_in_lists(self):
        block = blocks_of(page("1. item", "   <!-- run -->", "   ```sh", "   a", "     b", "   ```"))[0]
        self.assertEqual(block.text, "a\n  b\n")

    def test_files(self):
        block = blocks_of(page("<!-- file: a.yaml -->", "```yaml", "x: 1", "```"))[0]
        self.assertEqual((block.mark, block.text, block.is_command()), (Mark("file", "a.yaml"), "x: 1\n", False))
        with self.assertRaisesRegex(PageError, "no mark says"):
            blocks_of(page("<!-- file: a.sh -->", "```sh", "true", "```"))

    def test_one_command_in_the_background(self):
        with self.assertRaisesRegex(PageError, "must have one command"):
            blocks_of(page("<!-- run: background -->", "```sh", "a", "b", "```"))


class Ends(unittest.TestCase):
    RUN = ["<!-- run: background -->", "```sh", "a", "```"]

    def kinds(self, *lines):
        return [(block.mark.kind, block.heading) for block in blocks_of(page(*lines))]

    def test_where_the_text_says_it(self):
        self.assertEqual(self.kinds("# A", *self.RUN, "<!-- Ctrl-C -->", "Now press", "Ctrl-C there.", *self.RUN),
                         [("background", "A"), ("Ctrl-C", "A"), ("background", "A")])

    def test_after_each_section(self):
        lines = ["## A", *self.RUN, "## B", "<!-- Ctrl-C: after each section -->", "Ctrl-C ends each.", "### C",
                 *self.RUN, "#### D", *self.RUN, "## E", *self.RUN]
        self.assertEqual(self.kinds(*lines),
                         [("background", "A"), ("Ctrl-C", "B"), ("background", "C"), ("Ctrl-C", "C"),
                          ("background", "D"), ("Ctrl-C", "D"), ("background", "E")])
        self.assertEqual(self.kinds(*lines[:-len(self.RUN) - 1])[-1], ("Ctrl-C", "D"))

    def test_where_the_text_does_not_say_it(self):
        for mark in ("<!-- Ctrl-C -->", "<!-- Ctrl-C: after each section -->"):
            for after in (["Words."], ["Words.", "", "Ctrl-C"], [*self.RUN, "Ctrl-C"]):
                with self.subTest(mark), self.assertRaisesRegex(PageError, "line 2: the paragraph .* Ctrl-C"):
                    blocks_of(page("# A", mark, *after))
        with self.assertRaisesRegex(PageError, "neither here nor"):
            blocks_of(page("<!-- Ctrl-C: later -->", "Ctrl-C"))


class LaunchArguments(unittest.TestCase):
    def unknown(self, command):
        with tempfile.TemporaryDirectory() as folder:
            text = '<launch><arg name="a"/><arg name="b_c" default="1"/><group><arg name="x" value="1"/></group></launch>'
            pathlib.Path(folder, "some.launch").write_text(text)
            return unknown_arguments(command, pathlib.Path(folder))

    def test_those_that_the_file_has(self):
        self.assertEqual(self.unknown('roslaunch trk_bridge some.launch a:=1 b_c:="x:=2"'), [])

    def test_those_that_it_lacks(self):
        self.assertEqual(self.unknown("roslaunch trk_bridge some.launch a:=1 x:=2 b:=3"), ["x", "b"])

    def test_other_commands(self):
        self.assertEqual(self.unknown("rosrun trk_bridge trk_to_ros _x:=1"), [])
        self.assertEqual(self.unknown("roslaunch another some.launch x:=1"), [])


class Scripts(unittest.TestCase):
    SCRIPT = page("# make a cake", 'cmake -S "$root" -B "$build" -G Ninja \\', '  -DX=1 "$@"',
                  'exec "$(dirname "$0")/../scripts/test"')

    def test_commands_that_a_script_has(self):
        for command in ("cmake -S . -B build -G Ninja -DX=1", "./scripts/test"):
            self.assertEqual(has_commands(self.SCRIPT, [command]), [])

    def test_commands_that_it_lacks(self):
        for command in ("cmake -S . -B build -DX=1", "./scripts/demo", "make a cake", "cmake -S . -B build -DX=2"):
            self.assertEqual(has_commands(self.SCRIPT, [command]), [command])


if __name__ == "__main__":
    unittest.main()
