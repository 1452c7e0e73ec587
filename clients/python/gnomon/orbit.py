"""A picture that is turned with the mouse, in Jupyter and on any page that reaches the server."""

from __future__ import annotations

import json
from pathlib import Path
from string import Template
from typing import Any, Optional
from urllib.parse import quote

from . import keywords
from .json_form import Spec, frame_spec
from .scene_calls import SceneLike
from .session import Session
from .typed_calls import function_of

PAGE = Template((Path(__file__).parent / "orbit.html").read_text(encoding="utf-8"))


class Orbit:
    """Shown by Jupyter as HTML. The browser asks the server itself, by the address of each frame, so it must reach it
    under the session's address, and a server with keys does not answer it."""

    def __init__(self, url: str, scene: str, spec: Any, width: int, height: int):
        self.address = f"{url}/v1/scenes/{scene}/frame?" + "&".join(
            f"{quote(name)}={quote(json.dumps(value))}" for name, value in spec.items())
        self._size = (width, height)

    def _repr_html_(self) -> str:
        width, height = self._size
        return PAGE.substitute(address=json.dumps(self.address).replace("<", "\\u003c"), width=width, height=height)


@function_of(keywords.orbit)
def orbit(session: Session, scene: SceneLike, spec: Optional[Spec] = None, width: int = 640, height: int = 360,
          **fields: Any) -> Orbit:
    """A widget of a scene: drag or use the arrow keys to orbit. A quarter of the pixels while it moves."""
    asked = frame_spec(spec, **fields)
    asked.pop("camera", None)
    return Orbit(session.url, session.scene(scene)["id"], asked, width, height)
