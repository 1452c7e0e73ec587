"""The Python package as it is shipped: generated files, types, installation, README, pytest plugin, example."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from shipped_server import SCENES

ROOT = Path(__file__).resolve().parents[3]
PACKAGE = ROOT / "clients" / "python"
BOX = SCENES / "box_on_plane.glb"


class PackageTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_here(self, *command, status=0, **variables):
        run = subprocess.run([str(each) for each in command], cwd=self.folder, env={**os.environ, **variables},
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(run.returncode, status, run.stdout)
        return run.stdout


class Package(PackageTest):
    def test_the_specs_are_those_of_the_server(self):
        self.run_here(sys.executable, "-B", PACKAGE / "generate.py", "--into", self.folder)
        for name in ("spec.py", "keywords.py", "reports.py"):
            self.assertEqual((self.folder / name).read_text(), (PACKAGE / "gnomon" / name).read_text(),
                             f"{name} is old: run clients/python/generate.py")

    def test_every_type_is_right(self):
        mypy = shutil.which("mypy", path="/usr/bin") or self.skipTest("there is no mypy")
        self.run_here(mypy, "--config-file", PACKAGE / "pyproject.toml", "--cache-dir", self.folder, PACKAGE / "gnomon")

    def test_the_readme_does_what_it_says(self):
        blocks = re.findall(r"```python\n(.*?)```", (PACKAGE / "README.md").read_text(), re.DOTALL)
        self.assertGreater(len(blocks), 5)
        shutil.copy(BOX, self.folder / "scene.glb")
        (self.folder / "blocks.py").write_text("\n".join(block for block in blocks if "def test_" not in block))
        said = self.run_here(sys.executable, "-B", "blocks.py")
        self.assertIn("(180, 320, 3)", said)
        self.assertIn("400 /width 1..16384", said)
        self.assertTrue((self.folder / "frame.png").exists())
        self.assertEqual(len({path.read_bytes() for path in self.folder.glob("turn-*.png")}), 10)

    def test_it_installs_and_pytest_finds_its_fixtures(self):
        shutil.copytree(PACKAGE, self.folder / "source", ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
        self.run_here(sys.executable, "-m", "venv", "--system-site-packages", "venv")
        python = self.folder / "venv" / "bin" / "python"
        self.run_here(python, "-m", "pip", "install", "--quiet", "--no-index", "--no-build-isolation", "./source")
        shutil.rmtree(self.folder / "source")
        test = [each for each in re.findall(r"```python\n(.*?)```", (PACKAGE / "README.md").read_text(), re.DOTALL)
                if "def test_" in each]
        (self.folder / "test_it.py").write_text(test[0])
        shutil.copy(BOX, self.folder / "scene.glb")
        pytest = [python, "-m", "pytest", "-q", "test_it.py"]
        self.assertIn("--gnomon-update writes it", self.run_here(*pytest, status=1, PYTHONPATH=""))
        self.run_here(*pytest, "--gnomon-update", PYTHONPATH="")
        self.run_here(*pytest, PYTHONPATH="")
        (self.folder / "test_it.py").write_text(test[0].replace("(135, 40)", "(300, 20)"))
        self.assertIn("courtyard.png differs", self.run_here(*pytest, status=1, PYTHONPATH=""))
        self.assertTrue((self.folder / "gnomon-failures" / "courtyard-diff.png").exists())

    def test_the_data_set_goes_on_after_a_break(self):
        script = [sys.executable, "-B", PACKAGE / "examples" / "dataset.py", BOX, "set", "--width", "64", "--height", "48"]
        self.assertIn("3 frames in", self.run_here(*script, "--count", "3"))
        first = {path.name: path.read_bytes() for path in (self.folder / "set").glob("*.npz")}
        (self.folder / "set" / "000001.npz").unlink()
        self.assertIn("2 frames in", self.run_here(*script, "--count", "4"))
        sample = np.load(self.folder / "set" / "000001.npz")
        before = self.folder / "before.npz"
        before.write_bytes(first["000001.npz"])
        for name, values in np.load(before).items():
            if name != "report.json":  # which tells times
                np.testing.assert_array_equal(sample[name], values, name)
        manifest = json.loads((self.folder / "set" / "manifest.json").read_text())
        self.assertEqual(len(manifest["samples"]), 4)
        self.assertEqual(manifest["nodes"], {"0": "ground", "1": "camera", "2": "box"})
        self.assertTrue(manifest["made"]["renderer"]["fingerprint"])
        self.assertIn("choose another folder", self.run_here(*script, "--seed", "2", status=1))

    def check_samples(self, folder, said):
        """What a data set says of its samples, held against them."""
        samples = json.loads((folder / "manifest.json").read_text())["samples"]
        for name, share in samples.items():
            sample = np.load(folder / name)
            self.assertEqual((sample["shown"], (sample["ids"] >= 0).mean()), (share, share))
            self.assertEqual(np.isfinite(sample["depth"]).mean(), share)
            self.assertGreaterEqual(share, 0.05)
        shares = [*samples.values()]
        self.assertIn(f"{np.mean(shares):.1%} in the mean, {min(shares):.1%} to {max(shares):.1%}", said)

    def test_every_frame_of_a_data_set_shows_the_scene(self):
        length = int.from_bytes(BOX.read_bytes()[12:16], "little")
        gltf, data = json.loads(BOX.read_bytes()[20:20 + length]), BOX.read_bytes()[28 + length:]
        (self.folder / "box.bin").write_bytes(data)
        gltf["buffers"][0]["uri"] = "box.bin"
        roots = gltf["scenes"][0]["nodes"]
        for depth in range(3):  # empty nodes above all others, as exporters write them
            gltf["nodes"].append({"name": f"root {depth}", "children": roots})
            roots = [len(gltf["nodes"]) - 1]
        gltf["scenes"][0]["nodes"] = roots
        (self.folder / "rooted.gltf").write_text(json.dumps(gltf))
        script = [sys.executable, "-B", PACKAGE / "examples" / "dataset.py", "rooted.gltf"]
        for hidden in ("0", "2", "9"):
            said = self.run_here(*script, hidden, "--count", "8", "--width", "64", "--height", "48", "--hidden", hidden)
            self.check_samples(self.folder / hidden, said)
        refused = self.run_here(*script, "none", "--count", "3", "--width", "32", "--height", "24", "--shown", "0.99", status=1)
        self.assertIn("of 50 cameras none shows the scene on 99.0% of the pixels", refused)

    def test_a_data_set_of_a_house_shows_it(self):
        house = ROOT.parent / "shared" / "assets" / "models" / "HouseScene" / "glTF-Binary" / "house.glb"
        if not house.exists():
            self.skipTest(f"there is no {house}")
        said = self.run_here(sys.executable, "-B", PACKAGE / "examples" / "dataset.py", house, "set", "--count", "20",
                             "--width", "64", "--height", "48")
        self.check_samples(self.folder / "set", said)


if __name__ == "__main__":
    unittest.main()
