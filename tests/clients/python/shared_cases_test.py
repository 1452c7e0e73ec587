"""The Python client over the shared files of exporters: it draws and says what the command line does."""

import unittest
import warnings

import cases_test as cases
import gnomon
import numpy
from shipped_server import ServerTest


def drawn(session, path):
    """(picture, what Python warned of) by a session."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        scene = session.upload(path)
        frame = session.frame(scene, cases.FRAME | {"views": ["color"]})
    return frame.color, [str(warning.message) for warning in said], scene.summary["warnings"]


@unittest.skipUnless(cases.CASES.exists(), f"there are no cases at {cases.CASES}")
class SharedCases(ServerTest):
    flags = ("--device", "cpu")

    def setUp(self):
        self.session = gnomon.Session("http://{}:{}".format(*self.server.address))
        self.addCleanup(self.session.close)

    def test_exporters_files_look_as_by_the_command_line(self):
        paths = list(cases.exporters_files())
        self.assertGreater(len(paths), 25)
        for path in paths:
            with self.subTest(f"{path.parent.name}/{path.name}"):
                picture, said, warned = drawn(self.session, path)
                for warning in warned:
                    self.assertIn(warning, said)
                views, _ = cases.render(path, cases.FRAME, "--device", "cpu")
                numpy.testing.assert_array_equal(picture[..., :3], views["color"][..., :3])

    def test_shadows_are_those_of_the_command_line(self):
        for case in sorted({name for name, *_ in cases.SHADOWS}):
            with self.subTest(case):
                folder = cases.CASES / "shadow" / case
                spec = cases.spec_of(folder) | {"views": ["shadow", "ids"]}
                frame = self.session.frame(folder / "scene.glb", spec)
                numbers = {"output": {"format": "npz", "exrPixelType": "float"}}
                views, _ = cases.render(folder / "scene.glb", spec | numbers, "--device", "cpu")
                for view in spec["views"]:
                    numpy.testing.assert_array_equal(getattr(frame, view), views[view])


if __name__ == "__main__":
    unittest.main()
