#!/usr/bin/env python3
"""Follows the checklists of tests/DEVELOPING.md on a scratch copy of the tree.

A view, a filter and a technique are added step by step. A step that is left out must not go unseen: the compiler, or
check_docs.py, has to complain until the last step is done. Each checklist has three steps.
"""

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COPIED = ("clients", "docker", "protocol", "renderer", "server", "tests")


class Checklists(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.pristine = Path(cls.folder.name) / "pristine"
        for name in COPIED:
            shutil.copytree(ROOT / name, cls.pristine / name, ignore=shutil.ignore_patterns("__pycache__", "node_modules"))
        for name in ("README.md", "CMakeLists.txt", "CMakePresets.json", "LICENSE", ".dockerignore", ".clang-format"):
            shutil.copy(ROOT / name, cls.pristine / name)
        shutil.copytree(ROOT / ".ci", cls.pristine / ".ci")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def setUp(self):
        self.tree = Path(self.folder.name) / "tree"
        shutil.copytree(self.pristine, self.tree)

    def tearDown(self):
        shutil.rmtree(self.tree)

    def edit(self, path, pattern, addition):
        """Puts `addition` behind the one place of a file that the pattern matches."""
        file = self.tree / path
        text, count = re.subn(pattern, lambda match: match.group(0) + addition, file.read_text(encoding="utf-8"), flags=re.S)
        self.assertEqual(count, 1, f"{path}: {pattern}")
        file.write_text(text, encoding="utf-8")

    def compiles(self, source):
        """Whether a file that holds this compiles, and what the compiler says."""
        file = self.tree / "scratch.cpp"
        file.write_text(source, encoding="utf-8")
        done = subprocess.run(
            ["g++", "-std=c++20", "-fsyntax-only", "-DGLM_FORCE_DEPTH_ZERO_TO_ONE", "-DGLM_ENABLE_EXPERIMENTAL", "-I", ".", "scratch.cpp"],
            cwd=self.tree, capture_output=True, text=True, check=False)
        file.unlink()
        return done.returncode == 0, done.stderr

    def assert_refused(self, source, words):
        fine, said = self.compiles(source)
        self.assertFalse(fine, "compiles without the step that is left out")
        self.assertIn(words, said)

    def assert_fine(self, source):
        fine, said = self.compiles(source)
        self.assertTrue(fine, said)

    def docs_faults(self):
        done = subprocess.run([sys.executable, "-B", "tests/check_docs.py"], cwd=self.tree, capture_output=True, text=True, check=False)
        return done.stdout

    def steps_of(self, heading):
        text = (ROOT / "tests/DEVELOPING.md").read_text(encoding="utf-8")
        return re.findall(r"^(\d)\. ", text.split(f"## {heading}\n")[1].split("\n## ")[0], flags=re.M)

    def test_a_view(self):
        self.assertEqual(self.steps_of("To add a debug view"), ["1", "2", "3"])
        rows = '#include "protocol/spec/traits.h"\n'
        self.assert_fine(rows)
        # 1. Its name, what it shows, and its row.
        self.edit("protocol/spec/output_options.h", r"\n  edgeDistance", ",\n  scratch")
        self.assert_refused(rows, "spellsAll")
        self.edit("protocol/spec/enum_rows.h", r"spelling<View::edgeDistance>\(.*?\),\n", '    spelling<View::scratch>("nothing"),\n')
        self.assert_refused(rows, "rowsAreComplete")
        self.edit("protocol/spec/traits.h", r"ViewTraits\{View::edgeDistance,[^\n]*\n",
                  "    ViewTraits{View::scratch, ViewSource::data, false, false, false, false, false, false, false, channels::kValue, channels::kValue},\n")
        self.assert_fine(rows)
        # 2. What it draws: by the processor, which lists its views, and under the define that follows from its name.
        processor = '#include "renderer/cpu/show/show_view.h"\n'
        self.assert_refused(processor, "kDataViews")
        self.edit("renderer/cpu/show/show_view.h", r"kDataViews\{.*?View::casterIds,", " View::scratch,")
        self.assert_fine(processor)
        self.edit("renderer/shaders/view.frag", r"\nvec4 data\(Sample seen\) \{\n", "#ifdef VIEW_SCRATCH\n  return vec4(0.5);\n#endif\n")
        self.assertIn("return vec4(0.5);", self.expanded_shader("view.frag", "VIEW_SCRATCH"))
        # 3. Its names for people.
        self.assertIn("scratch", self.docs_faults())
        self.edit("clients/web/fields.mjs", r"\['edgeDistance',[^\n]*\n", "  ['scratch', 'Scratch', 'Nothing'],\n")
        self.edit("server/API.md", r"\| `edgeDistance` \|[^\n]*\n", "| `scratch` | nothing |\n")
        self.assertNotIn("scratch", self.docs_faults())

    def expanded_shader(self, name, define):
        """The shader with its includes, as the reference front end reads it with this define."""
        listed = (self.tree / "renderer/shaders/CMakeLists.txt").read_text(encoding="utf-8")
        includes = re.search(r"set\(GNOMON_SHADER_INCLUDES\n(.*?)\)", listed, flags=re.S).group(1).split()
        out = self.tree / "expanded"
        out.mkdir()
        subprocess.run(["cmake", f"-DDIRECTORY={self.tree}/renderer/shaders", f"-DSHADERS={name}", f"-DINCLUDES={','.join(includes)}",
                        f"-DOUTPUT={out}/sources.cpp", f"-DEXPANDED={out}", "-P", str(self.tree / "renderer/shaders/embed_shaders.cmake")],
                       check=True, capture_output=True)
        subprocess.run(["glslangValidator", f"-D{define}", "-DSAMPLES=1", "-DLIGHT_COUNT=1", "-DNO_SHADOWS", "-l", str(out / name)],
                       check=True, capture_output=True)
        done = subprocess.run(["glslangValidator", "-E", f"-D{define}", str(out / name)], check=True, capture_output=True, text=True)
        return done.stdout

    def test_a_filter(self):
        self.assertEqual(self.steps_of("To add a shadow filter"), ["1", "2", "3"])
        rows = '#include "protocol/spec/enum_rows.h"\nconst auto word = gnomon::spell(gnomon::FilterType::hard);\n'
        kernel = '#include "renderer/shadow/filter_kernel.cpp"\n'
        self.assert_fine(kernel)
        # 1. Its name and what it does.
        self.edit("protocol/spec/shadow_options.h", r"enum class FilterType \{ hard, pcf, vsm, evsm, msm", ", scratch")
        self.assert_refused(rows, "spellsAll")
        self.edit("protocol/spec/enum_rows.h", r"spelling<FilterType::msm>\(.*?\),\n", '    spelling<FilterType::scratch>("nothing"),\n')
        self.assert_fine(rows)
        traits = '#include "protocol/spec/traits.h"\n'
        self.assert_refused(traits, "rowsAreComplete")
        self.edit("protocol/spec/traits.h", r"FilterTraits\{FilterType::msm,[^\n]*\n",
                  "    FilterTraits{FilterType::scratch, true, false, 4},\n")
        self.assert_fine(traits)
        # 2. How it reads the map: of all stages this one alone knows it.
        self.assert_refused(kernel, "rowsAreComplete")
        self.edit("renderer/shadow/filter_kernel.cpp", r"FilterReading\{FilterType::msm,[^\n]*\n",
                  "    FilterReading{FilterType::scratch, MapReadingKind::texels, MapReadingKind::disc},\n")
        self.assert_fine(kernel)
        # A new way of reading maps is listed, numbered for shaders, and looked up by the processor.
        lookups = '#include "renderer/cpu/shadow/map_queries.cpp"\n'
        self.edit("renderer/shadow/filter_kernel.h", r"\n  pcss", ",\n  scratched")
        self.assert_refused(kernel, "isEnumerator")
        self.edit("renderer/shadow/filter_kernel.h", r"kMapReadingKinds\{.*?MapReadingKind::pcss", ", MapReadingKind::scratched")
        self.assert_refused('#include "renderer/device/shader_data.cpp"\n', "kMapReadingKinds")
        self.assert_refused(lookups, "A new reading of maps")
        # 3. Its control on the page is checked with the page; what reads kernels compiles as it is.
        self.assert_fine('#include "renderer/shadow/predicted_error.cpp"\n')

    def test_a_technique(self):
        self.assertEqual(self.steps_of("To add a technique"), ["1", "2", "3"])
        rows = '#include "protocol/spec/traits.h"\n'
        # 1. Its name, what it is, and its row.
        self.edit("protocol/spec/shadow_options.h", r"enum class ShadowTechnique \{ auto_, shadowMap, shadowVolume, rayTraced", ", scratch")
        self.assert_refused(rows, "spellsAll")
        self.edit("protocol/spec/enum_rows.h", r"spelling<ShadowTechnique::rayTraced>\(.*?\),\n",
                  '    spelling<ShadowTechnique::scratch>("nothing"),\n')
        self.assert_refused(rows, "rowsAreComplete")
        self.edit("protocol/spec/traits.h", r"TechniqueTraits\{ShadowTechnique::rayTraced,[^\n]*\n",
                  "    TechniqueTraits{ShadowTechnique::scratch, true, true, false, false, true, false},\n")
        # 2. What finds the shadow asks the row: nothing else names techniques.
        self.assert_fine('#include "renderer/resolve/plan_input.cpp"\n')
        # 3. Its place in the tables.
        self.assertIn("scratch", self.docs_faults())
        self.edit("README.md", r"\| `rayTraced` \|[^\n]*\n", "| `scratch` | nothing |\n")
        self.edit("renderer/SHADOWS.md", r"\| `rayTraced` \|[^\n]*\n", "| `scratch` | nothing |\n")
        self.assertNotIn("scratch", self.docs_faults())


if __name__ == "__main__":
    unittest.main()
