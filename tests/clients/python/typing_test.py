"""Keywords of the Python client: what type checkers say of them, and what calls say of those that they don't take."""

import asyncio
import inspect
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import gnomon

PACKAGE = Path(gnomon.__file__).parents[1]

# Whatever is wrong has the start of mypy's message behind it.
CALLS = """
import numpy as np
import gnomon
from gnomon import AsyncSession, Frame, Session, spec

gnomon.render("a.glb", sun=(135, 40), width=3, camera={"node": "overview"}, views=["color", "ids"])
gnomon.render("a.glb", {"width": 3}, server="http://localhost:8080", key="secret")
gnomon.render("a.glb", spec.FrameSpec(width=3), lights=[spec.Light(sun=spec.Sun(1, 2)), {"sun": {}}], exposure=1)
gnomon.render("a.glb", widht=3)  # Unexpected keyword argument "widht"
gnomon.render("a.glb", width="3")  # Argument "width" to "render" has incompatible type "str"
gnomon.render("a.glb", views=["colr"])  # List item 0 has incompatible type
gnomon.render("a.glb", sun="135,40")  # Argument "sun" to "render" has incompatible type "str"
gnomon.render("a.glb", shadow=spec.Shadow(cascades=3))  # Unexpected keyword argument "cascades"

with Session(flags=["--device", "cpu"]) as session:
    frame: Frame = session.frame(b"glTF", width=3, nodes=[{"node": 0, "visible": False}])
    session.frame(scene="a.glb", spec=None, sun=np.array([1.0, 2.0]), toneMapping="none")
    session.frame("a.glb", hieght=3)  # Unexpected keyword argument "hieght"
    session.frame("a.glb", toneMapping="filmic")  # Argument "toneMapping" to "frame" of "Session" has incompatible type
    picture: bytes = session.picture("a.glb", None, "image/x-exr", width=3)
    session.picture("a.glb", mediatype="image/png")  # Unexpected keyword argument "mediatype"
    session.plan("a.glb", width=3)["lights"]
    session.plan("a.glb", widht=3)  # Unexpected keyword argument "widht"
    session.bake("a.glb", lights=[{"sun": {}}])
    session.bake("a.glb", light=[])  # Unexpected keyword argument "light"
    session.evaluate("a.glb", sweep="techniques", repeats=1, path={"step": [0, 0, 1]}, width=3)
    session.evaluate("a.glb", variant=[{}])  # Unexpected keyword argument "variant"
    for each in session.sequence("a.glb", frames=[{}, {"width": 3}], stable=False, width=3):
        each.save("x.png")
    session.sequence("a.glb", keys=[{}, {}], cuont=3)  # Unexpected keyword argument "cuont"
    session.submit("a.glb", keys=[{}, {}], count=3).wait(1)
    session.submit("a.glb", framesPerSecond=3)  # Unexpected keyword argument "framesPerSecond"
    session.video("a.glb", "a.webm", keys=[{}, {}], count=3, framesPerSecond=12, videoQuality=50, width=3)
    session.video("a.glb", "a.webm", quallity={})  # Unexpected keyword argument "quallity"
    gnomon.orbit(session, "a.glb", width=3, shadow={})
    gnomon.orbit(session, "a.glb", shaddow={})  # Unexpected keyword argument "shaddow"


async def work() -> bytes:
    AsyncSession(pateince=3)  # Unexpected keyword argument "pateince"
    async with AsyncSession(patience=3, concurrency=2) as session:
        frame: Frame = await session.frame("a.glb", width=3)
        await session.frame("a.glb", widht=3)  # Unexpected keyword argument "widht"
        await session.video("a.glb", "a.webm", count=2, keys=[{}, {}], hight=3)  # Unexpected keyword argument "hight"
        async for each in session.sequence("a.glb", frames=[{}]):
            each.save("x.png")
        session.sequence("a.glb", fraems=[{}])  # Unexpected keyword argument "fraems"
        return await session.picture("a.glb", width=3)
"""


class Checker(unittest.TestCase):
    def test_it_finds_every_keyword_that_is_wrong_and_no_other(self):
        mypy = shutil.which("mypy", path="/usr/bin") or self.skipTest("there is no mypy")
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "calls.py").write_text(CALLS)
            run = subprocess.run([mypy, "--cache-dir", folder + "/cache", "--hide-error-context", "calls.py"], cwd=folder,
                                 env={"PATH": "/usr/bin:/bin", "MYPYPATH": str(PACKAGE)}, text=True, capture_output=True)
            self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
            found = {}
            for line in run.stdout.splitlines():
                place, kind, message = line.split(": ", 2) if line.count(": ") > 1 else (line, "", "")
                if kind == "error":
                    found[int(place.split(":")[1])] = message
            for number, line in enumerate(CALLS.splitlines(), 1):
                expected = line.partition("  # ")[2]
                message = found.pop(number, "")
                self.assertTrue(message.startswith(expected) if expected else not message, f"{line}\n{message}")
            self.assertEqual(found, {}, run.stdout)


class Calls(unittest.TestCase):
    def test_a_keyword_that_is_wrong_is_named_before_anything_is_sent(self):
        session = object.__new__(gnomon.Session)  # which could send nothing
        for call, wrong, right in (
                (session.frame, "widht", "width"),
                (session.picture, "mediatype", "media_type"),
                (session.plan, "camra", "camera"),
                (session.bake, "light", "lights"),
                (session.evaluate, "varaints", "variants"),
                (session.sequence, "fraems", "frames"),
                (session.submit, "cuont", "count"),
                (session.video, "videoquality", "videoQuality"),
                (gnomon.render, "sever", "server"),
                (gnomon.orbit, "shaddow", "shadow")):
            with self.assertRaisesRegex(TypeError, rf"^{call.__name__}\(\) takes no '{wrong}'; did you mean '{right}'\?$"):
                call("scene.glb", **{wrong: 1})
        with self.assertRaisesRegex(TypeError, "takes no 'xyz'; it takes scene, spec, sun, width, "):
            session.frame("scene.glb", xyz=1)

    def test_a_keyword_that_is_wrong_is_named_when_it_is_awaited(self):
        async def work():
            session = gnomon.AsyncSession()
            session._session = object.__new__(gnomon.Session)
            with self.assertRaisesRegex(TypeError, "'widht'; did you mean 'width'"):
                await session.frame("scene.glb", widht=3)
            with self.assertRaisesRegex(TypeError, "'fraems'; did you mean 'frames'"):
                async for _ in session.sequence("scene.glb", fraems=[]):
                    pass

        asyncio.run(work())

    def test_a_notebook_completes_them(self):
        for call in (gnomon.render, gnomon.Session.frame, gnomon.AsyncSession.frame, gnomon.Session.video):
            self.assertIn("antialiasing", inspect.signature(call).parameters)
        self.assertNotIn("self", inspect.signature(object.__new__(gnomon.Session).frame).parameters)


if __name__ == "__main__":
    unittest.main()
