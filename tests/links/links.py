#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Whether every link of the documents leads somewhere.

links.py ROOT          exit status 1 and a line for each dead link in ROOT/*.md and ROOT/docs/*.md
links.py --self-test   exit status 1 if a dead link were not found

Files and folders are relative to the page and stay inside of ROOT; anchors are those that GitHub makes of headings.
Links to other sites are not followed.
"""

import pathlib
import re
import sys
import tempfile

LINK = re.compile(r"!?\[[^\]]*\]\(([^()\s]+)(?:\s+\"[^\"]*\")?\)")
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"``.+?``|`[^`\n]+`")


def without_code(text):
    """The text with code blanked out, of the same number of lines."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    text = FENCE.sub(blank, text)
    return CODE.sub(blank, "\n".join("" if line.startswith("    ") else line for line in text.split("\n")))


def anchors_of(page):
    """The anchors of a page's headings, numbered where a heading is there twice."""
    anchors, seen = set(), {}
    for line in FENCE.sub("", page.read_text(encoding="utf-8")).split("\n"):
        heading = re.match(r"#{1,6} +(.*?)\s*#*$", line)
        if not heading:
            continue
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(1)).lower()
        anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        seen[anchor] = seen.get(anchor, -1) + 1
        anchors.add(anchor if seen[anchor] == 0 else f"{anchor}-{seen[anchor]}")
    return anchors


def dead_links(root):
    """A line for each dead link."""
    found = []
    for page in sorted([*root.glob("*.md"), *(root / "docs").glob("*.md")]):
        text = without_code(page.read_text(encoding="utf-8"))
        for link in LINK.finditer(text):
            target = link.group(1)
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            file = (page.parent / name).resolve() if name else page
            where = f"{page.relative_to(root)}:{text.count(chr(10), 0, link.start()) + 1}: {target}"
            if root not in [file, *file.parents] or not file.exists():
                found.append(f"{where}: no such file")
            elif anchor and file.suffix == ".md" and anchor not in anchors_of(file):
                found.append(f"{where}: no such heading")
    return found


def self_test():
    """Whether dead links of each kind are found, and no others."""
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name).resolve()
        (root / "docs").mkdir()
        (root / "docs" / "a.md").write_text("# One `two`, 3.5\n## Twice\n## Twice\n[up](../README.md) [same](#twice-1)\n")
        (root / "README.md").write_text(
            "[a](docs/a.md#one-two-35) `[code](no.md)`\n```\n[fenced](no.md)\n```\n[web](https://example.org)\n"
            "[file](docs/b.md)\n![image](x.png)\n[heading](docs/a.md#thrice)\n[out](../..)\n"
        )
        found = dead_links(root)
        expected = ["docs/b.md", "x.png", "docs/a.md#thrice", "../.."]
        return [line.split(": ")[1] for line in found] == expected or print("self-test failed:", *found, sep="\n")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return 0 if self_test() else 1
    if len(sys.argv) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    found = dead_links(pathlib.Path(sys.argv[1]).resolve())
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


sys.exit(main())
