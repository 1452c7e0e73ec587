#!/usr/bin/env python3
"""Puts what a benchmark found into the README.

usage: to_readme.py NAME RESULT [README]      exit status 1 and one line where markers are missing

RESULT is the Markdown that a benchmark wrote. What stands there between <!-- readme --> and <!-- /readme --> goes
between <!-- NAME --> and <!-- /NAME --> of the README, its links turned so that they lead from there.
"""

import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RELATIVE_LINK = re.compile(r"(\]\()(?![a-z]+:|#|/)")


def place(text, name):
    """Where the text between the markers begins and ends."""
    begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->"
    first, last = text.find(begin), text.find(end)
    if first < 0 or last < first:
        raise ValueError(f"no markers: {begin.strip()} ... {end}")
    return first + len(begin), last


def put(name, result, folder, readme):
    """The README with the result in it; `folder`: of the result, as the README reaches it."""
    begin, end = place(result, "readme")
    part = RELATIVE_LINK.sub(rf"\g<1>{folder}/", result[begin:end].strip("\n"))
    first, last = place(readme, name)
    return f"{readme[:first]}\n{part}\n\n{readme[last:]}"


def main(name, result, readme=ROOT / "README.md"):
    result, readme = Path(result).resolve(), Path(readme).resolve()
    folder = Path(os.path.relpath(result.parent, readme.parent)).as_posix()
    try:
        readme.write_text(put(name, result.read_text(), folder, readme.read_text()))
    except ValueError as problem:
        sys.exit(f"{result} or {readme}: {problem}")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
