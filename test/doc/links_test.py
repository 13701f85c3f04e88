#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Checks the links and pictures of all pages: links_test.py [ROOT].

Files must exist in the repository, with the same case, and be tracked by git if git is available; anchors must be the GitHub
anchor of a heading of their page. Addresses of other machines are not opened, but must be https. Text between backticks or in
fences is no link. Every page of doc/ must be reachable from doc/README.md, and every picture in doc/images must be used.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

from pages import page_files

LINK = re.compile(r"(?P<picture>!?)\[(?P<text>(?:[^\[\]]|\[[^\[\]]*\])*)\]\((?P<target>[^()\s]+)(?:\s+\"[^\"]*\")?\)")
HTML_TARGET = re.compile(r"<(?:img|a)\b[^>]*\b(?:src|href)=\"(?P<target>[^\"]*)\"")
REFERENCE = re.compile(r"^\[(?P<name>[^\]]+)\]:\s*(?P<target>\S+)", re.MULTILINE)


def without_code(text):
    """The text with fences, code spans and comments blanked; lines keep their numbers."""
    kept, fence = [], None
    for line in text.splitlines():
        mark = re.match(r"^ *(`{3,}|~{3,})", line)
        if mark and fence is None:
            fence = mark[1]
            kept.append("")
        elif fence is not None:
            if mark and mark[1].startswith(fence):
                fence = None
            kept.append("")
        else:
            kept.append(re.sub(r"(`+)(?:(?!\1).)+?\1", "", line))
    return re.sub(r"<!--.*?-->", "", "\n".join(kept), flags=re.DOTALL)


def anchors_of(text):
    """GitHub's anchors of a page's headings."""
    anchors, fence = [], None
    for line in text.splitlines():
        mark = re.match(r"^ *(`{3,}|~{3,})", line)
        if mark:
            fence = mark[1] if fence is None else None if mark[1].startswith(fence) else fence
        heading = re.match(r"^#{1,6}\s+(.*?)\s*#*$", line) if fence is None else None
        if heading:
            name = re.sub(r"[^\w\- ]", "", heading[1].lower()).replace(" ", "-")
            count = sum(1 for anchor in anchors if re.fullmatch(re.escape(name) + r"(-\d+)?", anchor))
            anchors.append(f"{name}-{count}" if count else name)
    return anchors


def exists_with_case(path):
    return path.exists() and (path == path.parent or path.name in {p.name for p in path.parent.iterdir()})


class Pages:
    def __init__(self, root):
        self.root = root.resolve()
        self.pages = page_files(self.root)
        self.reached = {}
        self.faults = []

    def check(self):
        for page in self.pages:
            text = page.read_text(encoding="utf-8")
            self.reached[page] = set()
            cleaned = without_code(text)
            for pattern in (LINK, HTML_TARGET, REFERENCE):
                for match in pattern.finditer(cleaned):
                    fault = self._fault(page, match["target"])
                    if fault:
                        line = cleaned.count("\n", 0, match.start()) + 1
                        self.faults.append(f"{page.relative_to(self.root)}:{line}: {match['target']}: {fault}")
        self._check_reached()
        return self.faults

    def _fault(self, page, target):
        address = urllib.parse.urlsplit(target)
        if address.scheme or address.netloc:
            return None if address.scheme in ("https", "mailto") else "an address must be https"
        path = page if not address.path else page.parent / urllib.parse.unquote(address.path)
        path = path.resolve()
        if self.root not in [path, *path.parents]:
            return "outside of the repository"
        if not exists_with_case(path):
            return "no such file"
        self.reached[page].add(path)
        if address.fragment and path.suffix == ".md":
            if address.fragment not in anchors_of(path.read_text(encoding="utf-8")):
                return f"no heading '#{address.fragment}' in it"
        return None

    def _check_reached(self):
        index = self.root / "doc" / "README.md"
        for page in self.pages:
            if page.parent == index.parent and page != index and page not in self.reached[index]:
                self.faults.append(f"{page.relative_to(self.root)}: not reachable from doc/README.md")
        used = set().union(*self.reached.values())
        for picture in sorted((self.root / "doc" / "images").glob("*")):
            if picture not in used:
                self.faults.append(f"{picture.relative_to(self.root)}: no page uses it")


def untracked(pages):
    """Targets that git does not track, which are missing in a clone; none if this is no clone or git is not available."""
    if shutil.which("git") is None:
        return []
    listed = subprocess.run(["git", "-C", str(pages.root), "ls-files", "-z"], capture_output=True, check=False)
    if listed.returncode != 0:
        return []
    known = {pages.root / name for name in listed.stdout.decode().split("\0") if name}
    targets = set().union(*pages.reached.values())
    return [f"{target.relative_to(pages.root)}: linked, but not in git"
            for target in sorted(targets) if target.is_file() and target not in known]


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]
    pages = Pages(root)
    faults = [*pages.check(), *untracked(pages)]
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
