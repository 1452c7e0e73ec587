"""The session behind `gnomon.render`: made at the first call, ended with the program."""

from __future__ import annotations

import atexit
import threading
from typing import Any, Dict, Optional

from . import keywords
from .frame import Frame
from .json_form import Spec
from .scene_calls import Scene, SceneLike, is_scene_id
from .session import Session
from .typed_calls import function_of

_lock = threading.Lock()
_sessions: Dict[Any, Session] = {}


@function_of(keywords.render)
def render(scene: SceneLike, spec: Optional[Spec] = None, *, server: Optional[str] = None, key: Optional[str] = None,
           strict: Optional[bool] = None, **fields: Any) -> Frame:
    """Renders a scene: a path, bytes, or an id. `fields` are those of a FrameSpec, on top of `spec`, and
    `sun=(azimuth, elevation)` in degrees; without `views`, these are color, depth, ids and shadow.

    `strict` refuses a model, by its path or bytes, that violates glTF, instead of repairing it.
    Asks `server`, or GNOMON_SERVER, or a server that the first call starts and the end of the program ends.
    """
    with _lock:
        session = _sessions.get((server, key))
        if session is None:
            session = _sessions[server, key] = Session(server, key=key)
    if strict:
        if isinstance(scene, Scene) or is_scene_id(scene):
            raise ValueError("strict judges a model, not a scene that the server has: upload it with strict=True")
        scene = session.upload(scene, strict=True)
    return session.frame(scene, spec, **fields)


@atexit.register
def _close() -> None:
    for session in _sessions.values():
        session.close()
