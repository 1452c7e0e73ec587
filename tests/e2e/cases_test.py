"""The shared small inputs with the right value: files that exporters write, by HTTP and by the command line, and shadows
whose pixels are known, on both devices."""

import io
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy

from shipped_server import BINARY, TIMEOUT, ServerTest, environment

CASES = Path(os.environ["GNOMON_TEST_ASSETS"]).parent / "cases"
FRAME = {"width": 96, "height": 96, "camera": {"orbit": {"azimuthDegrees": 200, "elevationDegrees": 30}}}
DEVICES = ("cpu", "gl")

# What these look like, once they are repaired; but one has an occlusion texture.
LIKE_REFERENCE = ("faulty-part-unused", "glb-container", "rounded-numbers", "value-in-no-list")
OTHERWISE = ("pointer_twice.glb",)

# Of these nothing has to be said: conforming files; what is missing depends on the camera; a translation that is applied.
SILENT = ("flattened_box.glb", "orange_255_128_0.glb", "faces_away.glb", "CESIUM_RTC.glb")
# They conform, so that what is said of them is no reason to refuse them.
CONFORMING = ("texture_left_out.glb", "ktx2_not_required.glb")


def spec_of(folder):
    """A case's request. Some name technique hybrid, of an earlier version."""
    text = (folder / "spec.json").read_text()
    return json.loads(text.replace('"hybrid"', '"rayTraced"'))


def render(scene, spec, *flags):
    """(pictures by view, what was said) of the command line."""
    with tempfile.TemporaryDirectory() as folder:
        request = Path(folder) / "spec.json"
        request.write_text(json.dumps(spec))
        output = Path(folder) / "frame.npz"
        ran = subprocess.run(
            [BINARY, "render", str(scene), "--spec", str(request), "--output", str(output), *flags],
            capture_output=True,
            text=True,
            timeout=TIMEOUT,
            env=environment(),
        )
        if ran.returncode != 0:
            return None, ran.stderr
        with numpy.load(output) as views:
            return dict(views), ran.stderr


def exporters_files():
    for path in sorted((CASES / "gltf").rglob("*.gl*")):
        if path.parent.name not in ("reference", "blend"):  # what blends is drawn as a mask
            yield path


@unittest.skipUnless(CASES.exists(), f"there are no cases at {CASES}")
class ExportersFiles(ServerTest):
    def drawn_by_server(self, path):
        """(picture or None, warnings)"""
        kind = "model/gltf-binary" if path.suffix == ".glb" else "model/gltf+json"
        reply = self.server.ask("POST", "/v1/scenes", path.read_bytes(), {"Content-Type": kind})
        if reply.status not in (200, 201):
            return None, [problem["detail"] for problem in reply.json()["problems"]]
        frame = self.server.frame(reply.json()["id"], FRAME | {"output": {"format": "npz"}})
        self.assertEqual(frame.status, 200, frame.body[:300])
        with numpy.load(io.BytesIO(frame.body)) as views:
            return dict(views)["color"], reply.json()["warnings"]

    def test_each_is_drawn_and_said_by_every_way(self):
        reference, _ = render(CASES / "gltf/reference/reference.glb", FRAME)
        count = 0
        for path in exporters_files():
            with self.subTest(f"{path.parent.name}/{path.name}"):
                count += 1
                by_server, warnings = self.drawn_by_server(path)
                self.assertEqual(warnings == [], path.name in SILENT, warnings)
                views, said = render(path, FRAME, "--device", "cpu")
                self.assertIsNotNone(by_server, warnings)
                self.assertIsNotNone(views, said)
                for warning in warnings:
                    self.assertIn(warning, said)
                if path.suffix == ".glb":
                    numpy.testing.assert_array_equal(views["color"], by_server)
                on_gl, _ = render(path, FRAME, "--device", "gl")
                self.assertLess(numpy.abs(on_gl["color"].astype(float) - views["color"]).mean(), 1)
                if path.parent.name in LIKE_REFERENCE and path.name not in OTHERWISE:
                    numpy.testing.assert_array_equal(views["color"], reference["color"])
                if warnings and path.name not in CONFORMING:
                    refused, problem = render(path, FRAME, "--strict")
                    self.assertTrue(refused is None, problem)
        self.assertGreater(count, 25)


# The pixels that show a node, and those of them in shadow; what may be missing, and the techniques that are asked.
SHADOWS = (
    ("sky-dome-sun", 76415, 4545, 90, ("shadowMap",)),
    ("sky-dome-sun", 76415, 4545, 2, ("rayTraced",)),
    ("near-plane-from-scene-size", 81120, 4545, 2, ("rayTraced",)),
    ("ortho-eye-far", 127620, 1747, 60, ("shadowMap",)),
    ("ortho-eye-far", 127620, 1747, 2, ("rayTraced",)),
    ("node-flattened-on-one-axis", None, 813, 2, ("rayTraced",)),
)


@unittest.skipUnless(CASES.exists(), f"there are no cases at {CASES}")
class KnownShadows(unittest.TestCase):
    def drawn(self, case, device, technique, views):
        folder = CASES / "shadow" / case
        spec = spec_of(folder)
        spec.setdefault("shadow", {})["technique"] = technique
        spec["views"] = views
        spec["output"] = {"format": "npz", "exrPixelType": "float"}
        pictures, said = render(folder / "scene.glb", spec, "--device", device)
        self.assertIsNotNone(pictures, said)
        return pictures

    def test_as_many_pixels_as_a_closed_form_says(self):
        for case, shown, shadowed, slack, techniques in SHADOWS:
            for technique in techniques:
                for device in DEVICES:
                    with self.subTest(case, technique=technique, device=device):
                        pictures = self.drawn(case, device, technique, ["shadow", "ids"])
                        ids = pictures["ids"]
                        counts = {node: int((ids == node).sum()) for node in numpy.unique(ids) if node >= 0}
                        ground = max(counts, key=counts.get) if shown is None else None
                        for node, count in counts.items():
                            if shown is not None and abs(count - shown) <= 2:
                                ground = node
                        self.assertIsNotNone(ground, counts)
                        dark = int(((ids == ground) & (pictures["shadow"] < 0.5)).sum())
                        self.assertLessEqual(abs(dark - shadowed), slack, dark)

    def test_no_light_leaves_a_closed_box(self):
        pictures = self.drawn("volume-lamp-inside-solid", "gl", "shadowVolume", ["shadow", "ids"])
        ids = pictures["ids"]
        ground = max(numpy.unique(ids), key=lambda node: (ids == node).sum())
        self.assertLessEqual(int(((ids == ground) & (pictures["shadow"] >= 0.5)).sum()), 1)

    def test_a_ball_of_few_triangles_has_no_black_facets(self):
        azimuth, elevation = numpy.radians((80, 15))
        across = numpy.cos(elevation)
        to_sun = (across * numpy.sin(azimuth), numpy.sin(elevation), -across * numpy.cos(azimuth))
        for device in DEVICES:
            for technique in ("shadowMap", "rayTraced"):
                pictures = self.drawn("terminator", device, technique, ["shadow", "normal", "ids"])
                ids, normals = pictures["ids"], pictures["normal"]
                nodes = [node for node in numpy.unique(ids) if node >= 0]
                ball = max(nodes, key=lambda node: normals[ids == node].std())
                faces = (ids == ball) & (normals @ numpy.array(to_sun) > 0.1)
                self.assertGreater(int(faces.sum()), 5000)
                self.assertEqual(int((faces & (pictures["shadow"] < 0.5)).sum()), 0, (device, technique))

    def test_rays_name_the_caster(self):
        for device in DEVICES:
            for technique in ("rayTraced", "lightMap"):
                pictures = self.drawn("caster-ids-of-rays", device, technique, ["casterIds", "shadow", "ids"])
                dark = (pictures["ids"] == 0) & (pictures["shadow"] < 0.5)
                unnamed = int((pictures["casterIds"][dark] != 1).sum())
                self.assertGreater(int(dark.sum()), 500)
                # A light map's edges are not where rays find them.
                slack = 0 if technique == "rayTraced" else 0.03 * int(dark.sum())
                self.assertLessEqual(unnamed, slack, (device, technique, int(dark.sum())))

    def test_what_shows_no_shadow_is_not_measured(self):
        for case, receivers in (("unlit-counts-as-receiver", 1922), ("zero-intensity-error", 0)):
            for device in DEVICES:
                folder = CASES / "shadow" / case
                spec = spec_of(folder) | {"views": ["error"]}
                with tempfile.TemporaryDirectory() as temporary:
                    report = Path(temporary) / "report.json"
                    _, said = render(folder / "scene.glb", spec, "--device", device, "--report", str(report))
                    error = json.loads(report.read_text())["error"]
                self.assertEqual((error["receivers"], error["misclassified"]), (receivers, 0), (case, device, said))

    def test_snapped_tiles_hold_still_while_the_lens_zooms(self):
        folder = CASES / "shadow/zoom-shimmers"
        maps = {"shadow": {"technique": "shadowMap"}}
        snapped = {"shadow": {"technique": "shadowMap", "stabilization": "viewSnapping"}}
        for device in DEVICES:
            ran = subprocess.run(
                [BINARY, "evaluate", str(folder / "scene.glb"), "--spec", str(folder / "spec.json"), "--device", device]
                + ["--variant", json.dumps(maps), "--variant", json.dumps(snapped), "--repeats", "1", "--json", "-"]
                + ["--path", (folder / "path.json").read_text()],
                capture_output=True,
                text=True,
                timeout=TIMEOUT,
                env=environment(),
            )
            self.assertEqual(ran.returncode, 0, ran.stderr)
            for row in json.loads(ran.stdout)["rows"]:
                self.assertEqual(row["metrics"]["shimmer"], 0, device)


if __name__ == "__main__":
    unittest.main()
