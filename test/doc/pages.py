# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Command blocks of a documentation page, and the marks that say how each is run.

A page shows commands in `sh` fences. A comment before each, which readers do not see, is its mark:

    <!-- run -->                          all lines, run by one shell, end with exit code 0
    <!-- run: prints TEXT -->             and print TEXT
    <!-- run: fails, prints TEXT -->      end with another exit code, and print TEXT
    <!-- run: background -->              one command in a separate terminal, which runs until the text says Ctrl-C,
                                          and then ends with exit code 0
    <!-- run: background until TEXT -->   the same; the next block waits for TEXT
    <!-- run on MACHINE -->               like run, with all of the above after a colon, on one of several machines, which
                                          several_machines_test.py creates; other tests check the syntax
    <!-- run by: FILE -->                 FILE, a script of the repository, contains these commands
    <!-- needs hardware: WHY -->          it is not run; its syntax is checked

A mark before a paragraph that says Ctrl-C is where a reader ends all background processes; nothing else ends them:

    <!-- Ctrl-C -->                       here
    <!-- Ctrl-C: after each section -->   at the end of each section, from here to the next heading of this level

All other fences also need a language. `<!-- file: NAME -->` before one makes it a file for the commands after it.
"""

import dataclasses
import re
import xml.etree.ElementTree

COMMAND_LANGUAGES = ("sh", "bash", "shell", "console")

_FENCE = re.compile(r"^(?P<indent> *)(?P<ticks>`{3,}|~{3,})[ \t]*(?P<language>[^\s`]*)[^`]*$")
_MARK = re.compile(r"^\s*<!--\s*(?P<verb>run by|run(?: on (?P<machine>\w+))?|needs hardware|file|Ctrl-C)\b\s*"
                   r"(?::\s*(?P<text>.*?))?\s*-->\s*$")
_RUN = re.compile(
    r"^(?:(?P<background>background)(?: until (?P<until>.+))?|(?:(?P<fails>fails), )?prints (?P<prints>.+))$")
_LIST_ITEM = re.compile(r"^ {0,3}(?:[-*+]|\d+[.)])\s")


def page_files(root):
    """All pages of the repository, the README first."""
    first = root / "README.md"
    return [first, *(page for page in sorted(root.glob("*.md")) if page != first), *sorted(root.glob("doc/**/*.md"))]


class PageError(Exception):
    """An error of a page, with its line."""

    def __init__(self, line, why):
        super().__init__(f"line {line}: {why}")


@dataclasses.dataclass(frozen=True)
class Mark:
    """How the block after it is run: `kind` is run, background, run by, needs hardware or file. Ctrl-C is a block without
    text."""

    kind: str
    text: str = ""  # until, FILE, WHY or NAME
    prints: str = ""
    fails: bool = False
    machine: str = ""  # on which it runs; empty: on the reader's machine


@dataclasses.dataclass(frozen=True)
class Block:
    line: int  # of its fence, from 1
    section: int  # counts the page's headings
    heading: str
    language: str
    text: str
    mark: Mark = None

    def is_command(self):
        return self.language in COMMAND_LANGUAGES

    def commands(self):
        """Its lines for a shell: without comments, continued lines joined."""
        lines = re.sub(r"\\\n\s*", "", self.text).splitlines()
        return [line.strip() for line in lines if line.strip() and not line.strip().startswith("#")]


def parse_mark(line, number):
    """The mark in a line, or None. Raises PageError for an unknown one."""
    match = _MARK.match(line)
    if not match:
        return None
    verb, text = match["verb"], match["text"]
    if verb == "Ctrl-C":
        if text not in (None, "after each section"):
            raise PageError(number, f"'Ctrl-C: {text}' is neither here nor after each section")
        return Mark(verb, text or "")
    machine = match["machine"] or ""
    if verb != "run" and not machine:
        if not text:
            raise PageError(number, f"'{verb}' does not say what")
        return Mark(verb, text)
    if text is None:
        return Mark("run", machine=machine)
    run = _RUN.match(text)
    if not run:
        raise PageError(number, f"'run: {text}' is not a known way to run a block")
    if run["background"]:
        return Mark("background", run["until"] or "", machine=machine)
    return Mark("run", prints=run["prints"], fails=bool(run["fails"]), machine=machine)


def _check(block):
    if not block.language:
        raise PageError(block.line, "a fence without a language; use text for plain text")
    if block.is_command():
        if block.mark is None or block.mark.kind == "file":
            raise PageError(block.line, f"no mark says how these commands are run: {block.commands()[:1]}")
        if not block.commands():
            raise PageError(block.line, "a command block without a command")
        if block.mark.kind == "background" and len(block.commands()) != 1:
            raise PageError(block.line, "a background block must have one command")
    elif block.mark is not None and block.mark.kind != "file":
        raise PageError(block.line, f"a mark of commands before a fence of '{block.language}'")


class _Reader:
    """One pass over a page's lines."""

    def __init__(self, lines):
        self._lines = lines
        self._at = 0
        self._section, self._heading, self._level = 0, "", 0
        self._each_below = None  # the level of the heading below which every section ends with Ctrl-C
        self._mark = self._mark_line = None
        self._in_list = False
        self.blocks = []

    def read(self):
        while self._at < len(self._lines):
            fence = _FENCE.match(self._lines[self._at])
            if fence:
                self._read_fence(fence)
            else:
                self._read_text(self._lines[self._at])
                self._at += 1
        self._end_mark()
        self._end_section(0)

    def _end_section(self, next_level):
        if self._each_below is None:
            return
        self._add_end(self._at)
        if next_level <= self._each_below:
            self._each_below = None

    def _add_end(self, line):
        self.blocks.append(Block(line, self._section, self._heading, "", "", Mark("Ctrl-C")))

    def _read_end(self, mark):
        paragraph = []
        for line in self._lines[self._at + 1:]:
            if (not line.strip() and paragraph) or _FENCE.match(line) or _MARK.match(line):
                break
            paragraph.append(line.strip())
        if "Ctrl-C" not in " ".join(paragraph):
            raise PageError(self._at + 1, "the paragraph after this mark does not say Ctrl-C")
        if mark.text:
            self._each_below = self._level
        else:
            self._add_end(self._at + 1)

    def _end_mark(self):
        if self._mark is not None:
            raise PageError(self._mark_line, "a mark without a fence after it")

    def _read_fence(self, fence):
        begin = self._at
        closing = re.compile(rf"^ *{re.escape(fence['ticks'][0])}{{{len(fence['ticks'])},}}\s*$")
        content = []
        while True:
            self._at += 1
            if self._at == len(self._lines):
                raise PageError(begin + 1, "a fence that does not end")
            if closing.match(self._lines[self._at]):
                break
            content.append(re.sub(rf"^ {{0,{len(fence['indent'])}}}", "", self._lines[self._at]))
        self._at += 1
        block = Block(begin + 1, self._section, self._heading, fence["language"], "\n".join(content) + "\n", self._mark)
        self._mark = None
        _check(block)
        self.blocks.append(block)

    def _read_text(self, line):
        if not line.strip():
            return
        self._end_mark()
        mark = parse_mark(line, self._at + 1)
        if mark is not None and mark.kind == "Ctrl-C":
            self._read_end(mark)
            return
        if mark is not None:
            self._mark, self._mark_line = mark, self._at + 1
            return
        if _LIST_ITEM.match(line):
            self._in_list = True
            return
        indent = len(line.expandtabs(4)) - len(line.expandtabs(4).lstrip())
        after_blank = self._at == 0 or not self._lines[self._at - 1].strip()
        if indent >= (8 if self._in_list else 4) and after_blank:
            raise PageError(self._at + 1, "an indented block: use a fence with a language")
        if indent == 0:
            self._in_list = False
        if line.startswith("#"):
            self._level = len(line) - len(line.lstrip("#"))
            self._end_section(self._level)
            self._section += 1
            self._heading = line.lstrip("#").strip()


def blocks_of(text):
    """All fences of a page and its Ctrl-C marks, in order. Raises PageError."""
    reader = _Reader(text.splitlines())
    reader.read()
    return reader.blocks


def unknown_arguments(command, launch_folder):
    """Arguments of `command`, if it is a roslaunch of this package, that its launch file does not have. roslaunch does not
    report them."""
    launched = re.search(r"\broslaunch trk_bridge (\S+\.launch)\b(.*)", command)
    if not launched:
        return []
    root = xml.etree.ElementTree.parse(launch_folder / launched[1]).getroot()
    known = {argument.get("name") for argument in root.findall("arg")}
    return [name for name in re.findall(r"(?:^|\s)(\w+):=", launched[2]) if name not in known]


def has_commands(script, commands):
    """Commands that are missing in a script. `script` is its text including the files that it sources."""
    text = re.sub(r"\\\n\s*", " ", script).replace('"', "").replace("$(dirname $0)/..", ".")
    text = text.replace("$root", ".").replace("$build", "build")
    lines = [line.split() for line in text.splitlines() if not line.strip().startswith("#")]

    def has(words):
        return any(line[i:i + len(words)] == words for line in lines for i in range(len(line)))

    return [command for command in commands if not has(command.split())]
