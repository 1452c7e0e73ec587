#!/usr/bin/env python3
"""Puts what a benchmark found into the README and the pages that show it.

usage: to_readme.py NAME RESULT [PAGE...]      exit status 1 and one line where markers are missing

RESULT is the Markdown that a benchmark wrote. What stands there between <!-- readme --> and <!-- /readme --> goes
between <!-- NAME --> and <!-- /NAME --> of each PAGE (default: renderer/ACCURACY.md), its links changed
so that they work from there. Between <!-- NAME: A | B --> and <!-- /NAME --> goes the table alone, with columns
A and B.
"""

import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "renderer/ACCURACY.md"
RELATIVE_LINK = re.compile(r"(\]\()(?![a-z]+:|#|/)")


def place(text, name):
    """Where the text between the markers begins and ends, and the columns that the first one names."""
    begin = re.search(rf"<!-- {re.escape(name)}(?:: (.*))? -->\n", text)
    last = text.find(f"<!-- /{name} -->")
    if not begin or last < begin.end():
        raise ValueError(f"no markers: <!-- {name} --> ... <!-- /{name} -->")
    return begin.end(), last, begin[1].split(" | ") if begin[1] else []


def chosen(text, columns):
    """The first table of the text with these columns only."""
    table = re.search(r"(?:^\|.*\|$\n?)+", text, re.MULTILINE)
    if not table:
        raise ValueError("no table to choose columns from")
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table[0].strip().split("\n")]
    unknown = [column for column in columns if column not in rows[0]]
    if unknown:
        raise ValueError(f"no columns {unknown}; there are {rows[0]}")
    indices = [rows[0].index(column) for column in columns]
    lines = [[row[i] for i in indices] for row in rows]
    return "\n".join("|---" * len(line) + "|" if set(line) == {"---"} else "| " + " | ".join(line) + " |" for line in lines)


def put(name, result, folder, page):
    """The page with the result in it; `folder`: of the result, as links reach it from the page."""
    begin, end, _ = place(result, "readme")
    first, last, columns = place(page, name)
    part = result[begin:end].strip("\n")
    part = chosen(part, columns) if columns else RELATIVE_LINK.sub(rf"\g<1>{folder}/", part)
    return f"{page[:first]}\n{part}\n\n{page[last:]}"


def main(name, result, *pages):
    result = Path(result).resolve()
    for page in [Path(page).resolve() for page in pages] or [PAGE]:
        folder = Path(os.path.relpath(result.parent, page.parent)).as_posix()
        try:
            page.write_text(put(name, result.read_text(), folder, page.read_text()))
        except ValueError as problem:
            sys.exit(f"{result} or {page}: {problem}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
