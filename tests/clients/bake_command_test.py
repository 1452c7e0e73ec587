"""`gnomon bake` through the shipped binary: the same files here and there, problems."""

import json
import struct
import unittest

from command_line import BOX, OK, PROBLEM, USAGE, AgainstServer, gnomon
from shipped_server import EXR_MAGIC, png_size

BAKE = ["--sun", "135,40", "--set", "shadow.technique=lightMap", "--set", "shadow.lightMap.size=128"]


class Bake(AgainstServer):
    def test_a_bake_here_and_there(self):
        for ending in ("png", "exr", "glb"):
            files = []
            for where in ([], ["--server", self.url]):
                path, report = self.folder / f"baked.{ending}", self.folder / "report.json"
                run = gnomon("bake", BOX, *BAKE, "-o", str(path), "--report", str(report), *where)
                self.assert_ends(run, OK)
                self.assertEqual((run.stdout, run.stderr), (b"", b""))
                light = json.loads(report.read_text())["lights"][0]
                files.append((path.read_bytes(), light["lightMap"]["width"], light["lightMap"]["height"]))
            self.assertEqual(files[0], files[1])
            data, width, height = files[0]
            if ending == "png":
                self.assertEqual(png_size(data), (width, height))
            elif ending == "exr":
                self.assertTrue(data.startswith(EXR_MAGIC))
            else:
                self.assertEqual(struct.unpack("<4sII", data[:12]), (b"glTF", 2, len(data)))

    def test_a_sky_here_and_there(self):
        sky = ["--environment", "sky", "--sky-shadows", "--sky-samples", "1", *BAKE]
        for light in ([], ["--light", "environment"]):
            files = []
            for where in ([], ["--server", self.url]):
                path, report = self.folder / "sky.glb", self.folder / "report.json"
                run = gnomon("bake", BOX, *sky, *light, "-o", str(path), "--report", str(report), *where)
                self.assert_ends(run, OK)
                self.assertGreater(json.loads(report.read_text())["environment"]["charts"], 0)
                files.append(path.read_bytes())
            self.assertEqual(*files)

    def test_a_picture_lights_a_bake(self):
        picture = self.folder / "white.hdr"
        rows = bytes([128, 128, 128, 129]) * (64 * 32)
        picture.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n" + rows)
        files = []
        for where in ([], ["--server", self.url]):
            path = self.folder / "lit.png"
            size = ["--set", "shadow.lightMap.size=128"]
            lit = ["--environment", str(picture), "--sky-shadows", "--sky-samples", "1", "--set", "lights=[]", *size]
            self.assert_ends(gnomon("bake", BOX, *lit, "-o", str(path), *where), OK)
            files.append(path.read_bytes())
        self.assertEqual(*files)

    def test_what_is_wrong_with_a_bake_is_told(self):
        out = ["-o", str(self.folder / "baked.glb")]
        for arguments, said in (
            (["--set", "shadow.technique=rayTraced"], ["/shadow/technique"]),
            ([*BAKE, "--set", "shadow.lightMap.size=0"], ["--set shadow.lightMap.size", "16..8192"]),
            ([*BAKE, "--set", "shadow.lightMap.texelsPerMetre=1000000"], ["8192"]),
            ([*BAKE, "--light", "3"], ["/light"]),
            ([*BAKE, "--light", "environment"], ["/light", "was not baked"]),
        ):
            for where in ([], ["--server", self.url]):
                self.assert_ends(gnomon("bake", BOX, *arguments, *out, *where), PROBLEM, *said)
        self.assert_ends(gnomon("bake", BOX, *BAKE, "-o", "baked.obj"), USAGE)
        self.assert_ends(gnomon("bake", BOX, *BAKE), USAGE)
        self.assert_ends(gnomon("bake", BOX, *BAKE, "--light", "sun", *out), USAGE)


if __name__ == "__main__":
    unittest.main()
