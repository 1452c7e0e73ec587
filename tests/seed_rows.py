#!/usr/bin/env python3
"""Holds the table "seed row -> tests" of tests/README.md against the tests, and every row of it against having one.

usage: seed_rows.py [TESTS]      TESTS: the folder, default this one; prints one line a fault; exit status 1 if any

A test carries the ids of the rows that it shows at the front of its name: TEST(Splits, X16_X17_Increase...), or
golden/X28_hard_filter.json. GNOMON_README_UPDATE=1 writes the table first.
"""

import os
import re
import sys
from pathlib import Path

BEGIN, END = "<!-- seed rows -->\n\n", "\n<!-- /seed rows -->"
CASE = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
ID = re.compile(r"(?:^|_)([XMDGHN]\d+)(?=_)")

# X: Xenko's shadows. M: the MonoGame article. D: Met.3D's cascades. G: what glTF brings with it. N: a lecture's notes on
# shadows.
MUST_HAVE_TESTS = {
    "X1": "which lights cast", "X2": "factors of the five sizes", "X3": "a directional light covers the whole frame",
    "X4": "the size formula", "X5": "importance", "X6": "what a spot covers", "X7": "what a point light covers",
    "X8": "the atlas and its capacity", "X9": "packing", "X10": "the order of the lights changes nothing",
    "X11": "a full atlas: demotion, then refusal, both told", "X12": "every frame starts with an empty atlas",
    "X13": "no filter reads beside its tile", "X14": "culling masks", "X15": "number of cascades, orthographic too",
    "X16": "manual partition", "X17": "logarithmic partition", "X18": "automatic depth range",
    "X19": "a range kept through a sequence", "X20": "guard distance", "X21": "manual depth range",
    "X22": "blending of cascades", "X23": "beyond the last split", "X24": "stabilization", "X25": "the light's axes",
    "X26": "casters before the light's near plane", "X27": "normal offset", "X28": "filter kernels",
    "X29": "tints of the cascades", "X30": "transmittance: not offered", "X31": "spot lights", "X32": "point lights",
    "X33": "dual paraboloids: not offered", "X34": "what casts: masks, blended materials, both faces",
    "X35": "golden pictures of each kind of light and filter",
    "M1": "the frustum's eight corners", "M2": "sign of the light's direction", "M3": "light along the up vector",
    "M4": "receivers use the whole depth", "M5": "casters upstream of the frustum", "M6": "the map is cleared to far",
    "M7": "outside of the map is lit, in x, y and z", "M8": "compare first, then filter", "M9": "bias in metres",
    "M10": "strength", "M11": "the article's linear splits", "M12": "three depths in one 8-bit target: not offered",
    "M13": "cascades are chosen by view depth", "M14": "culling for each tile, one source of matrices",
    "M15": "tints and the map as debug views", "M16": "a tight box around the receivers",
    "M17": "slices of any projection", "M18": "texels that are not square",
    "D1": "which directional lights cast", "D2": "casting and receiving, each by itself", "D3": "three cascades",
    "D4": "four depths a texel",
    "G1": "lights of KHR_lights_punctual, endless ranges", "G2": "alpha masks and blended materials",
    "G3": "degenerate triangles, posed bounds", "G4": "mirrored nodes", "G5": "orthographic cameras, no far plane",
}

# What goes beyond the documents; a row is listed as soon as it has a test.
MAY_HAVE_TESTS = {
    "H1": "measured error", "H2": "predicted error", "H3": "settings found for a target", "H4": "analytic bias",
    "H5": "the same bytes again", "H6": "shimmer", "H7": "report on the atlas", "H8": "a plan without a picture",
    "H9": "debug views as files", "H10": "times of passes", "H11": "techniques side by side", "H12": "large worlds",
    "H13": "tiles kept between requests",
    "D5": "volumetric light map", "D6": "a volume's shadow on what lies outside and inside",
    "D7": "volumes: Beer-Lambert at any step and resolution, and its traps",
    "D8": "what a full shadow leaves",
    "N1": "umbra and penumbra", "N2": "equal depth is lit", "N3": "shadow volumes",
    "N4": "light falls where no volume is", "N5": "static shadows in a light map", "N6": "soft shadows against a reference",
    "N7": "volumes and rays agree",
}
ROWS = {**MUST_HAVE_TESTS, **MAY_HAVE_TESTS}


def tests_in(folder):
    """(name to show, name with the ids) of each test."""
    for source in sorted(folder.rglob("*_test.cpp")):
        for suite, name in CASE.findall(source.read_text(encoding="utf-8")):
            yield f"{suite}.{name}", name
    for golden in sorted((folder / "golden").glob("*.json")):
        yield f"golden/{golden.stem}", golden.stem


def tests_by_row(folder):
    by_row = {}
    for shown, name in tests_in(folder):
        for row in dict.fromkeys(ID.findall(name)):
            by_row.setdefault(row, []).append(shown)
    return by_row


def table(by_row):
    lines = ["| row | about | tests |", "|---|---|---|"]
    for row, about in ROWS.items():
        if row in by_row:
            lines.append(f"| {row} | {about} | {' '.join(f'`{test}`' for test in by_row[row])} |")
    return "\n".join(lines) + "\n"


def faults_of(folder, update=False):
    by_row = tests_by_row(folder)
    for row in MUST_HAVE_TESTS:
        if row not in by_row:
            yield f"{row} ({ROWS[row]}) has no test"
    for row in by_row:
        if row not in ROWS:
            yield f"{by_row[row][0]} names a row {row} that there is not"
    readme = folder / "README.md"
    text = readme.read_text(encoding="utf-8")
    begin, end = text.find(BEGIN), text.find(END)
    if begin < 0 or end < begin:
        yield "README.md has lost its markers: <!-- seed rows --> ... <!-- /seed rows -->"
        return
    fresh = text[:begin] + BEGIN + table(by_row) + text[end:]
    if update:
        readme.write_text(fresh, encoding="utf-8")
    elif text != fresh:
        yield "README.md: its table of seed rows is stale; GNOMON_README_UPDATE=1 tests/run -R Readme writes it anew"


def main(arguments):
    folder = Path(arguments[0]) if arguments else Path(__file__).resolve().parent
    faults = list(faults_of(folder, "GNOMON_README_UPDATE" in os.environ))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
