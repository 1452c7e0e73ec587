"""clients/cli/README.md does what it says: every block, in order, in one folder, against a server."""

import json
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from command_line import BOX, CommandLine
from shipped_server import BINARY, SCENES, TIMEOUT, Server, environment, png_size

README = Path(__file__).resolve().parents[2] / "clients/cli/README.md"
SERVER = "http://127.0.0.1:8080"


class Readme(CommandLine):
    def test_every_example_runs(self):
        shutil.copy(BOX, self.folder / "scene.glb")
        shutil.copy(SCENES / "cameras.glb", self.folder / "other.glb")
        (self.folder / "bin").mkdir()
        (self.folder / "bin/gnomon").symlink_to(BINARY)
        (self.folder / "gnomon").mkdir()
        variables = environment(XDG_CONFIG_HOME=str(self.folder), HOME=str(self.folder))
        variables["PATH"] = f"{self.folder / 'bin'}:{variables['PATH']}"
        blocks = re.findall(r"^```(sh|toml)\n(.*?)^```", README.read_text(), re.DOTALL | re.MULTILINE)
        self.assertGreater(len(blocks), 7)
        said = ""
        with Server("--device", "cpu", "--workers", "1") as server:
            for kind, text in blocks:
                text = text.replace(SERVER, "http://{}:{}".format(*server.address))
                if kind == "toml":
                    (self.folder / "gnomon/config").write_text(text)
                    continue
                run = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=self.folder, env=variables, text=True,
                                     capture_output=True, timeout=TIMEOUT)  # fmt: skip
                self.assertEqual((run.returncode, run.stderr), (0, ""), text)
                said += run.stdout
        self.check(said)

    def check(self, said):
        for line in ("the sun has moved", "exit code 1", "edges ", "shadow=reference: largest ", "# preset preview, "):
            self.assertIn(line, said)
        for name, size in {"frame": (1280, 720), "there": (1280, 720), "shadows.reference": (320, 180), "mine": (320, 180),
                           "small": (160, 90), "farm": (160, 90), "off": (320, 180), "other-morning": (160, 90),
                           "turn/00003": (160, 90), "piped": (160, 90), "asked": (160, 90),
                           "stored": (1280, 720), "steps/00001": (160, 90)}.items():  # fmt: skip
            self.assertEqual(png_size((self.folder / f"{name}.png").read_bytes()), size, name)
        self.assertLess(json.loads((self.folder / "shadows.json").read_text())["reference"]["metrics"]["misclassified"], 0.05)
        self.assertEqual(len(json.loads((self.folder / "plan.json").read_text())["lights"][0]["tiles"]), 2)
        [problem] = json.loads((self.folder / "problems.json").read_text())["problems"]
        self.assertEqual((problem["pointer"], problem["flag"], problem["actual"]), ("/width", "--width", "0"))


if __name__ == "__main__":
    unittest.main()
