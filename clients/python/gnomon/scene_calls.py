"""Scenes by what they hold: uploaded once, and again where the server has dropped them."""

from __future__ import annotations

import contextlib
import http.client
import json
import re
import threading
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, Mapping, NamedTuple, Optional, Union, cast
from urllib.parse import quote

from .bundle import Bundle, Source, bundle, upload_body
from .json_form import encoded
from .problems import NotFound, Refused
from .reports import SceneSummary
from .transport import Reply, Transport, whole_reply


class Scene(NamedTuple):
    id: str
    summary: SceneSummary


SceneLike = Union[Scene, str, Path, bytes]


class SceneCalls:
    """Calls below /v1/scenes/{id}. May be used by several threads."""

    def __init__(self, http: Transport):
        self._http = http
        self._lock = threading.Lock()
        self._sources: Dict[str, Callable[[], Bundle]] = {}
        self._files: Dict[Any, str] = {}

    def upload(self, source: Source, files: Mapping[str, Source] = {}) -> Scene:
        made = bundle(source, files)
        summary = (self._known(made.id) if made.id else None) or self._send(made)
        again = (lambda: made) if isinstance(source, bytes) else (lambda: bundle(source, files))
        with self._lock:
            self._sources[summary["id"]] = again
        return Scene(summary["id"], summary)

    def forget(self, name: str) -> None:
        with self._lock:
            self._sources.pop(name, None)
            self._files = {key: each for key, each in self._files.items() if each != name}

    def id_of(self, scene: SceneLike) -> str:
        """A scene's id. A path or bytes are uploaded, once for as long as the file stays as it is."""
        if isinstance(scene, Scene):
            return scene.id
        if isinstance(scene, str) and re.fullmatch("[0-9a-f]{64}", scene):
            return scene
        if isinstance(scene, bytes):
            name = Bundle(scene, {}).id
            return name if name in self._sources else self.upload(scene).id
        status = Path(scene).stat()
        file = (str(Path(scene).resolve()), status.st_mtime_ns, status.st_size)
        with self._lock:
            known = self._files.get(file)
        if known is None:
            known = self.upload(scene).id
            with self._lock:
                self._files[file] = known
        return known

    def request(self, scene: SceneLike, method: str, tail: str, asked: Any = None, **headers: str) -> Reply:
        with self.stream(scene, method, tail, None if asked is None else encoded(asked), **headers) as response:
            return whole_reply(response)

    @contextlib.contextmanager
    def stream(self, scene: SceneLike, method: str, tail: str, body: Optional[bytes] = None,
               **headers: str) -> Iterator[http.client.HTTPResponse]:
        """A reply as it comes. A scene that the server has dropped is uploaded again, once."""
        name = self.id_of(scene)
        path = f"/v1/scenes/{quote(name)}{tail}"
        if body is not None:
            headers["Content_Type"] = "application/json"
        with contextlib.ExitStack() as stack:
            try:
                response = stack.enter_context(self._http.stream(method, path, body, **headers))
            except NotFound:
                if not self._restored(name):
                    raise
                response = stack.enter_context(self._http.stream(method, path, body, **headers))
            yield response

    def _restored(self, name: str) -> bool:
        """Whether the scene was missing and is there again."""
        with self._lock:
            source = self._sources.get(name)
        if source is None or self._known(name) is not None:
            return False
        return self._send(source())["id"] == name

    def _known(self, name: str) -> Optional[SceneSummary]:
        try:
            return cast(SceneSummary, json.loads(self._http.request("GET", f"/v1/scenes/{name}").body))
        except (NotFound, Refused):
            return None

    def _send(self, made: Bundle) -> SceneSummary:
        content_type, content = upload_body(made)
        method, path = ("PUT", f"/v1/scenes/{made.id}") if made.id else ("POST", "/v1/scenes")
        return cast(SceneSummary, json.loads(self._http.request(method, path, content, Content_Type=content_type).body))
