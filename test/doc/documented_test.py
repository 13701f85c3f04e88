#!/usr/bin/env python3
# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Checks that the public headers are documented, and the links of the Doxygen pages: documented_test.py OUTPUT.

Every class, struct, union, enumeration, type and function needs a comment. Exceptions: constructors, destructors and
operators; overloads of a function that has one; and getters without arguments (`name() const`). Fields and enumerators need
no comment.
"""

import pathlib
import re
import sys
import urllib.parse
import xml.etree.ElementTree


def is_documented(element):
    return any("".join(text.itertext()).strip() for tag in ("briefdescription", "detaileddescription")
               for text in element.findall(tag))


def name_of(member, scope):
    return f"{scope}::{member.findtext('name')}" if scope else member.findtext("name")


def needs_comment(member, scope):
    kind, name = member.get("kind"), member.findtext("name")
    if kind not in ("function", "enum", "typedef") or member.get("prot") == "private" or name.startswith("@"):
        return False
    if kind != "function":
        return bool(name)
    own = scope.rsplit("::", 1)[-1].split("<")[0].strip()
    if name.lstrip("~") == own or name.startswith("operator"):
        return False
    return not (member.get("const") == "yes" and member.find("param") is None)


def faults_of(xml_folder):
    members = {}
    for path in sorted(xml_folder.glob("*.xml")):
        for compound in xml.etree.ElementTree.parse(path).getroot().iter("compounddef"):
            kind, scope = compound.get("kind"), compound.findtext("compoundname")
            header = compound.find("location").get("file") if compound.find("location") is not None else ""
            if kind in ("class", "struct", "union") and compound.get("prot") == "public" and "@" not in scope:
                if not is_documented(compound):
                    yield f"{header}: {scope} has no comment"
            inside = scope if kind != "file" else ""
            for member in compound.iter("memberdef"):
                members.setdefault((name_of(member, inside), inside), []).append(member)
    for (name, scope), overloads in members.items():
        if any(is_documented(member) for member in overloads):
            continue
        for member in overloads[:1]:
            if needs_comment(member, scope):
                location = member.find("location")
                yield f"{location.get('file')}:{location.get('line')}: {name} has no comment"


def dead_links_of(html_folder):
    for page in sorted(html_folder.rglob("*.html")):
        for target in re.findall(r'(?:src|href|data)="([^"]+)"', page.read_text(encoding="utf-8", errors="replace")):
            address = urllib.parse.urlsplit(target)
            if address.scheme or address.netloc or not address.path:
                continue
            if not (page.parent / urllib.parse.unquote(address.path)).exists():
                yield f"{page.name}: {target} does not exist"


def main():
    output = pathlib.Path(sys.argv[1])
    if not (output / "html" / "index.html").exists():
        print(f"{output}: no pages", file=sys.stderr)
        return 1
    faults = sorted({*faults_of(output / "xml"), *dead_links_of(output / "html")})
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
