#!/usr/bin/env python3
"""Each rule of check_docs.py is broken once, in a tree of its own, and has to be named."""

import tempfile
import unittest
from pathlib import Path

import check_docs

# The smallest tree in which every table has something to say, and nothing is wrong.
SOUND = {
    "README.md": "# House\n\n## What it can do\n\n| technique | is |\n|---|---|\n| `maps` | a map |\n\n"
                 "[API](server/API.md#views)\n",
    "server/API.md": "# API\n\n## Views\n\n| view | shows |\n|---|---|\n| `color` | all |\n| `depth` | depth |\n\n"
                     "## Stages\n\n| stage | is |\n|---|---|\n| `plan` | planning |\n| `encode` | writing |\n",
    "server/frames/reply.cpp": 'stages.push_back({"encode", took});\n',
    "server/main.cpp": 'app.add_subcommand("serve", "Serve");\n',
    "clients/USING.md": "## Command line\n\n| command | does |\n|---|---|\n| `gnomon serve` | serves |\n",
    "clients/cli/commands/spec_flags.cpp": "",
    "clients/web/fields.mjs": "const kViews = [\n  ['color', 'Colour'],\n];\n"
                              "const kDebugViews = [\n  ['depth', 'Depth'],\n];\n"
                              "const kStageColors = {\n  plan: '#1',\n  encode: '#2',\n};\n",
    "protocol/FIELDS.md": "| field | type |\n|---|---|\n| `width` | number |\n| `lights[].color` | 3 numbers |\n",
    "server/metrics/request_metrics.h": 'kStages{"plan", "encode"};\n',
    "protocol/report/frame_report.h": "/// One stage's time. Names and order: plan\n/// encode. More.\n",
    "protocol/report/report_rows.h": 'field<&FrameReport::stages>("plan, "\n "encode.", {}),\n',
    "protocol/spec/enum_rows.h": 'kSpellings<View>{\n  spelling<View::color>("x"),\n'
                                 '  spelling<View::depth>(\n    "x"),\n};\n'
                                 'kSpellings<ShadowTechnique>{\n  spelling<ShadowTechnique::maps>("x"),\n};\n',
    "protocol/spec/field_rows.h": 'field<&A::width>("x")\nfield<&A::lights>(\n  "x")\n'
                                  'field<&B::color>("x")\n',
    "renderer/SHADOWS.md": "## Techniques\n\n| technique | is |\n|---|---|\n| `maps` | a map |\n",
    "renderer/render.cpp": 'drawing.endStage("plan");\n',
    "renderer/shaders/README.md": "| shader | draws |\n|---|---|\n| `view.frag` | a view |\n",
    "renderer/shaders/view.frag": "",
}

# Path, a text in it, what stands there instead, and words of the one fault that it has to give.
BROKEN = [
    ("README.md", "server/API.md#views", "server/NONE.md", "README.md:9: the link server/NONE.md leads nowhere"),
    ("README.md", "#views", "#sights", "has no heading of that name"),
    ("README.md", "[API]", '<img src="none.png" alt="x"> [API]', "the link none.png leads nowhere"),
    ("README.md", "# House", "# House\n\nSee `renderer/none.cpp`.", "README.md:3: there is no renderer/none.cpp"),
    ("README.md", "# House", "# House\n\nSee `none.h`.", "there is no none.h"),
    ("README.md", "# House", "# House\n\n```sh\nserver/start   # go\n```", "README.md:4: there is no server/start"),
    ("renderer/shaders/README.md", "`view.frag` |", "`view.frag`, `other` |", "there is no other"),
    ("renderer/shaders/README.md", "`view.frag` |", "`view.frag`, `render` |", "no render in this folder"),
    ("renderer/shaders/README.md", "| `view.frag` | a view |", "", "shader view.frag is missing"),
    ("server/API.md", "| `depth` | depth |\n", "", "server/API.md: view depth is missing"),
    ("server/API.md", "| `depth` | depth |\n", "| `depth` | x |\n| `old` | x |\n", "there is no view old"),
    ("server/API.md", "| `plan` | planning |\n", "", "server/API.md: stage plan is missing"),
    ("clients/web/fields.mjs", "  ['depth', 'Depth'],\n", "", "clients/web/fields.mjs: view depth is missing"),
    ("clients/web/fields.mjs", "  plan: '#1',\n", "", "clients/web/fields.mjs: stage plan is missing"),
    ("server/metrics/request_metrics.h", '"plan", ', "", "server/metrics/request_metrics.h: stage plan is missing"),
    ("protocol/report/frame_report.h", "plan", "plan load", "there is no stage load"),
    ("protocol/report/report_rows.h", "plan, ", "", "protocol/report/report_rows.h: stage plan is missing"),
    ("renderer/SHADOWS.md", "| `maps` | a map |\n", "", "renderer/SHADOWS.md: technique maps is missing"),
    ("README.md", "| `maps` | a map |\n", "", "README.md: technique maps is missing"),
    ("clients/USING.md", "| `gnomon serve` | serves |\n", "", "command serve is missing"),
    ("protocol/FIELDS.md", "| `width` | number |\n", "", "field width is missing"),
    ("server/main.cpp", 'add_subcommand("serve"', "addServe(", "the code names no command"),
]

# Path, its text, and words of the one fault that its comments have to give.
COMMENTS = [
    ("renderer/a.cpp", "int x;  // see none.h\n", "renderer/a.cpp:1: there is no none.h"),
    ("renderer/a.cpp", "/* one\n two: shaders/none.frag */\n", "renderer/a.cpp:2: there is no shaders/none.frag"),
    ("renderer/a.cpp", "int x = 1'000;  // none.h isn't here\n", "there is no none.h"),
    ("renderer/a.cpp", "// shaders/none*.frag\n", "there is no shaders/none*.frag"),
    ("renderer/shaders/view.frag", "// common_none.glsl\n", "there is no common_none.glsl"),
    ("renderer/CMakeLists.txt", "# none.cpp\n", "there is no none.cpp"),
    ("renderer/a.py", "#!/usr/bin/env python3\nX = 1  # none.py\n", "renderer/a.py:2: there is no none.py"),
    ("renderer/a.py", '"""What it is.\n\nSee NONE.md."""\n', "renderer/a.py:3: there is no NONE.md"),
    ("server/start", "#!/usr/bin/python3\n# none.py\n", "server/start:2: there is no none.py"),
]

FINE_COMMENTS = [
    ("renderer/a.cpp", "// render.cpp, shaders/view.frag, renderer/shaders/view.frag, ../README.md, shaders/*.frag.\n"),
    ("renderer/a.cpp", '#include <none.h>\nauto x = "// none.h";\nauto y = R"(// none.h)";\nchar z = \'"\'; // main.cpp\n'),
    ("renderer/a.cpp", "// https://none.example/none.md, foreach_target.h, x.height, a.hpp, none.h_\n"),
    ("renderer/CMakeLists.txt", 'add_library(x none.cpp) # main.cpp\nset(y "# none.cpp")\n'),
    ("renderer/a.py", "X = 'none.py'\nY = '# none.py'\n"),
    ("server/start", "#!/bin/sh\n# none.py\n"),
]

FINE = ["`image/png`", "`text/csv`", "`/v1/scenes`", "`build/release/bin/x`", "`spec_flags.cpp`",
        "`cli/commands/spec_flags`", "`shaders/*.frag`", "`renderer/shaders/NAME.frag`", "`KHR/none`",
        "[x](https://none.example/a.md)", "[x](#house)", "```\nserver/anything in a drawing\n```", "`./build`",
        "`shadow.filter.size`"]


class CheckDocs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for path, text in SOUND.items():
            self.write(path, text)

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text, encoding="utf-8")

    def faults(self):
        return list(check_docs.faults_of(self.root))

    def test_a_sound_tree_has_none(self):
        self.assertEqual(self.faults(), [])

    def test_each_fault_is_named(self):
        for path, old, new, words in BROKEN:
            with self.subTest(path=path, words=words):
                self.assertIn(old, SOUND[path])
                self.write(path, SOUND[path].replace(old, new, 1))
                faults = self.faults()
                self.write(path, SOUND[path])
                self.assertTrue(any(words in fault for fault in faults), faults)

    def test_files_that_comments_name_are_there(self):
        for path, text, words in COMMENTS:
            with self.subTest(path=path, text=text):
                self.write(path, text)
                faults = self.faults()
                self.write(path, SOUND.get(path, ""))
                self.assertEqual(len(faults), 1, faults)
                self.assertIn(words, faults[0])

    def test_what_comments_may_name_is_left_alone(self):
        for path, text in FINE_COMMENTS:
            with self.subTest(path=path, text=text):
                self.write(path, text)
                self.assertEqual(self.faults(), [])
                self.write(path, SOUND.get(path, ""))

    def test_what_is_no_path_of_the_tree_is_left_alone(self):
        for text in FINE:
            with self.subTest(text=text):
                self.write("README.md", SOUND["README.md"] + "\n" + text + "\n")
                self.assertEqual(self.faults(), [])


if __name__ == "__main__":
    unittest.main()
