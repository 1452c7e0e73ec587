#!/usr/bin/env python3
"""Checks every path and link of the READMEs and pages, that their tables are complete, and the files that comments name.

usage: check_docs.py [ROOT]      prints one line a fault, as PAGE:LINE: what is wrong; exit status 1 if any

A link leads to a file or folder of the tree, and its #anchor to a heading there. A `path` in backquotes is checked if
its first part is the name of a folder of the tree, or if it ends like a source file; it may begin at the root, at the
page's folder, or at any folder, and may lack the file's suffix. In a table, every name in a column headed `file`,
`files`, `folder` or `shader` is one, and lies below the page's folder if it has no path. Shell commands in code blocks
are checked for paths from the root. Views, stages, techniques, shaders, commands and fields are those that the
code names. A file that a comment of a source names (C++, GLSL, Python, CMake) is one of the tree, by its path or by the
last parts of it.
"""

import fnmatch
import io
import os
import re
import sys
import tokenize
from pathlib import Path

SKIPPED = {"build", "node_modules", ".git"}
SOURCE = re.compile(r"\.(h|cpp|glsl|vert|frag|py|mjs|css|html|cmake|md)$")
MEDIA_TYPE = re.compile(r"^(application|image|model|multipart|text)/[a-z0-9.+*-]+$")
LINK = re.compile(r"\]\(([^)\s]+)\)|<(?:img|a)\s[^>]*?(?:src|href)=\"([^\"]+)\"")
SPAN = re.compile(r"`([^`\s]+)`")
FILE_COLUMNS = {"file", "files", "folder", "shader"}
WILD = re.compile(r"NAME|…|\.\.\.|\{[^}]*\}")
# Written by programs: what stands in their backquotes are names of models, not of files.
GENERATED = ("tests/bench/results/", "tests/gallery/README.md")

C_SUFFIXES = (".h", ".cpp", ".glsl", ".vert", ".frag", ".comp")
CMAKE_SUFFIXES = ("CMakeLists.txt", ".cmake", ".cmake.in")
# What is no comment, and in a group what is one. A ' between digits begins no character.
C_COMMENT = re.compile(
    r"""(?<=[\da-fA-F])'(?=[\da-fA-F])|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'"""
    r"""|(?P<comment>//[^\n]*|/\*.*?\*/)""", re.DOTALL)
CMAKE_COMMENT = re.compile(r'"(?:\\.|[^"\\])*"|(?P<comment>#[^\n]*)', re.DOTALL)
NAMED_FILE = re.compile(r"(?<![\w./:<>*-])[\w./*-]*[\w*]\.(?:h|cpp|glsl|vert|frag|comp|md|py)(?![\w-])")
# Other people's headers, what programs write, and names that stand for any name.
NAMED_ELSEWHERE = {"foreach_target.h", "GL/osmesa.h", "OUTPUT/data_sets.md", "a_test.cpp", "b_test.cpp"}


def tree_of(root):
    """Every file and folder, from the root, with slashes."""
    paths = set()
    for folder, folders, files in os.walk(root):
        folders[:] = [name for name in folders if name not in SKIPPED]
        here = Path(folder).relative_to(root)
        paths.update((here / name).as_posix() for name in folders + files)
    return paths


class Tree:
    def __init__(self, root):
        self.root = root
        self.paths = tree_of(root)
        self.folders = {Path(path).name for path in self.paths if (root / path).is_dir()}
        self.roots = {path for path in self.paths if "/" not in path and (root / path).is_dir()}
        self.pages = sorted(path for path in self.paths if path.endswith(".md"))

    def holds(self, path, page=""):
        """Whether this names a file or folder: from the root, from the page's folder, or from any folder."""
        path = WILD.sub("*", path.rstrip("/"))
        here = os.path.normpath((Path(page).parent / path).as_posix())
        if path in self.paths or here in self.paths:
            return True
        ends = [path, path + ".*", "*/" + path, "*/" + path + ".*", here + ".*"]
        return any(fnmatch.fnmatchcase(held, end) for held in self.paths for end in ends)


    def has_below(self, name, page):
        """Whether a file or folder of this name, which may lack its suffix, lies somewhere below the page's folder."""
        here = Path(page).parent
        names = (Path(held).name for held in self.paths if here in Path(held).parents)
        return any(fnmatch.fnmatchcase(held, end) for held in names for end in (name.rstrip("/"), name + ".*"))


def slug(heading):
    """The anchor that GitHub gives to a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    return {slug(heading) for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE)}


def link_fault(tree, page, target):
    if re.match(r"[a-z]+:", target):
        return None
    path, _, anchor = target.partition("#")
    file = os.path.normpath((Path(page).parent / path).as_posix()) if path else page
    if file != "." and file not in tree.paths:
        return f"the link {target} leads nowhere"
    if anchor and anchor not in anchors((tree.root / file).read_text(encoding="utf-8")):
        return f"the link {target}: {file} has no heading of that name"
    return None


def path_fault(tree, page, span, is_file):
    if span.startswith(("/", "-", "http:", "https:", "build/", "$", "<", "#")) or MEDIA_TYPE.match(span):
        return None
    looks_like_one = SOURCE.search(span) or ("/" in span and span.split("/")[0] in tree.folders)
    if not (is_file or looks_like_one) or not re.fullmatch(r"[\w./{},*…-]+", span):
        return None
    if is_file and "/" not in span.rstrip("/"):
        return None if tree.has_below(WILD.sub("*", span), page) else f"there is no {span} in this folder"
    return None if tree.holds(span, page) else f"there is no {span}"


def page_faults(tree, page):
    """Lines and what is wrong there."""
    code = None
    columns = []
    for number, line in enumerate((tree.root / page).read_text(encoding="utf-8").split("\n"), 1):
        if fence := re.match(r"\s*```(\w*)", line):
            code = None if code is not None else fence[1]
            continue
        if code is not None:
            words = re.findall(r"(?<![\w@:/.=-])([\w-]+/[\w./-]+)", line.split(" # ")[0]) if code == "sh" else []
            for word in words:
                if word.split("/")[0] in tree.roots and not tree.holds(word.rstrip(".")):
                    yield number, f"there is no {word}"
            continue
        for target in (first or second for first, second in LINK.findall(line)):
            if fault := link_fault(tree, page, target):
                yield number, fault
        if page.startswith(GENERATED):
            continue
        cells = re.split(r"(?<!\\)\|", line.strip())[1:-1] if line.strip().startswith("|") else []
        if not cells or not columns:
            columns = [cell.strip() for cell in cells]
        named = {span for cell, head in zip(cells, columns) if head in FILE_COLUMNS for span in SPAN.findall(cell)}
        for span in SPAN.findall(re.sub(r"\[[^\]]*\]\([^)]*\)", "", line)):
            if fault := path_fault(tree, page, span, span in named):
                yield number, fault


def first_column(tree, page, heading):
    """The names in backquotes that begin the rows of the tables under a heading."""
    text = (tree.root / page).read_text(encoding="utf-8")
    part = re.search(rf"^#+ {re.escape(heading)}$(.*?)(?=^#+ |\Z)", text, re.MULTILINE | re.DOTALL)
    return re.findall(r"^\| `([^`]+)` ", part[1], re.MULTILINE) if part else []


def spellings(tree, enum):
    text = (tree.root / "protocol/spec/enum_rows.h").read_text(encoding="utf-8")
    part = re.search(rf"kSpellings<{enum}>\{{(.*?)\n\}};", text, re.DOTALL)
    return re.findall(rf"spelling<{enum}::(\w+?)_?>", part[1]) if part else []


def texts(tree, pattern):
    for path in sorted(tree.paths):
        if fnmatch.fnmatchcase(path, pattern):
            yield (tree.root / path).read_text(encoding="utf-8")


def stages(tree):
    """What the code calls its stages."""
    names = set()
    for pattern in ("renderer/*.cpp", "server/*.cpp", "clients/cli/*.cpp"):
        for text in texts(tree, pattern):
            names.update(re.findall(r"\b(?:finish|endStage)\(\"(\w+)\"\)", text))
            names.update(re.findall(r"StageTime\{\"(\w+)\"", text))
            names.update(re.findall(r"stages\.push_back\(\{\"(\w+)\"", text))
    return names


def found(pattern, text):
    match = re.search(pattern, text, re.DOTALL)
    return match[1] if match else ""


def compare(place, what, listed, wanted, extra_allowed=False):
    if not wanted:
        yield f"{place}: the code names no {what}; has the way that check_docs.py finds them changed?"
    for name in sorted(set(wanted) - set(listed)):
        yield f"{place}: {what} {name} is missing"
    for name in sorted(set(listed) - set(wanted)):
        if not extra_allowed:
            yield f"{place}: there is no {what} {name}"


def table_faults(tree):
    read = lambda path: (tree.root / path).read_text(encoding="utf-8")
    page = read("clients/web/fields.mjs")

    views = spellings(tree, "View")
    yield from compare("server/API.md", "view", first_column(tree, "server/API.md", "Views"), views)
    lists = "\n".join(re.findall(r"k\w*Views = \[(.*?)\n\];", page, re.DOTALL))
    yield from compare("clients/web/fields.mjs", "view", re.findall(r"^  \['(\w+)'", lists, re.MULTILINE), views)

    names = stages(tree)
    yield from compare("server/API.md", "stage", first_column(tree, "server/API.md", "Stages"), names)
    colors = found(r"kStageColors = \{(.*?)\n\};", page)
    yield from compare("clients/web/fields.mjs", "stage", re.findall(r"^  (\w+):", colors, re.MULTILINE), names)
    labels = found(r"kStages\{(.*?)\};", read("server/metrics/request_metrics.h"))
    yield from compare("server/metrics/request_metrics.h", "stage", re.findall(r"\w+", labels), names)
    says = re.sub(r"\s*///\s*", " ", found(r"Names and order: (.*?)\.", read("protocol/report/frame_report.h")))
    yield from compare("protocol/report/frame_report.h", "stage", says.split(), names)
    says = found(r"&FrameReport::stages>(.*?)\{", read("protocol/report/report_rows.h"))
    yield from compare("protocol/report/report_rows.h", "stage", re.findall(r"\w+", says), names, extra_allowed=True)

    shaders = {Path(path).name for path in tree.paths if re.search(r"^renderer/shaders/\w+\.(vert|frag)$", path)}
    rows = "".join(re.findall(r"^\|.*", read("renderer/shaders/README.md"), re.MULTILINE))
    listed = re.findall(r"`(\w+\.(?:vert|frag))`", rows)
    yield from compare("renderer/shaders/README.md", "shader", listed, shaders)

    techniques = spellings(tree, "ShadowTechnique")
    for path, heading in (("README.md", "What it can do"), ("renderer/SHADOWS.md", "Techniques")):
        yield from compare(path, "technique", first_column(tree, path, heading), techniques)

    commands = [name for folder in ("server", "clients") for text in texts(tree, folder + "/*.cpp")
                for name in re.findall(r"add_subcommand\(\"(\w+)\"", text)]
    listed = [name.removeprefix("gnomon ") for name in first_column(tree, "clients/USING.md", "Command line")]
    yield from compare("clients/USING.md", "command", listed, commands)

    fields = {name for text in texts(tree, "protocol/spec/*_rows.h")
              for name in re.findall(r"field<&\w+::(\w+)>", text)}
    listed = {part for path in re.findall(r"^\| `([^`]+)` ", read("protocol/FIELDS.md"), re.MULTILINE)
              for part in path.replace("[]", "").split(".")}
    yield from compare("protocol/FIELDS.md", "field", listed, fields)


def python_comments(text):
    """Comments, and the strings that stand alone."""
    begins = True
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT or (token.type == tokenize.STRING and begins):
            yield token.start[0], token.string
        if token.type not in (tokenize.COMMENT, tokenize.NL):
            begins = token.type in (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)


def comments_of(path, text):
    """Lines of a source and the comments that begin there."""
    if path.endswith(C_SUFFIXES):
        pattern = C_COMMENT
    elif path.endswith(CMAKE_SUFFIXES):
        pattern = CMAKE_COMMENT
    else:
        yield from python_comments(text)
        return
    for match in pattern.finditer(text):
        if match["comment"]:
            yield text.count("\n", 0, match.start()) + 1, match["comment"]


def is_source(root, path):
    if "." in Path(path).name:
        return path.endswith((*C_SUFFIXES, *CMAKE_SUFFIXES, ".py"))
    with (root / path).open("rb") as file:
        return re.match(rb"#!.*python", file.readline(80)) is not None


def comment_faults(tree):
    """Files that comments name and that there are not."""
    ends = {"/".join(parts[first:]) for parts in (path.split("/") for path in tree.paths) for first in range(len(parts))}
    for path in sorted(tree.paths):
        if not (tree.root / path).is_file() or not is_source(tree.root, path):
            continue
        for line, comment in comments_of(path, (tree.root / path).read_text(encoding="utf-8")):
            for match in NAMED_FILE.finditer(comment):
                name = re.sub(r"^(\.\.?/)+", "", match[0])
                if name in ends or name in NAMED_ELSEWHERE or ("*" in name and fnmatch.filter(ends, name)):
                    continue
                newlines = comment.count("\n", 0, match.start())
                yield f"{path}:{line + newlines}: there is no {name}"


def faults_of(root):
    tree = Tree(root)
    for page in tree.pages:
        for number, fault in page_faults(tree, page):
            yield f"{page}:{number}: {fault}"
    yield from table_faults(tree)
    yield from comment_faults(tree)


def main(root):
    faults = list(faults_of(root))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parents[1]).resolve()))
