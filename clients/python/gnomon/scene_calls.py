"""Scenes by what they hold: uploaded once, and again where the server has dropped them."""

from __future__ import annotations

import contextlib
import http.client
import json
import re
import threading
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, Iterator, Mapping, NamedTuple, Optional, Set, Tuple, Union, cast
from urllib.parse import quote

from .bundle import Bundle, Source, bundle, files_beside, upload_body
from .json_form import encoded
from .problems import NotFound, Refused
from .reports import NodeList, NodeSummary, SceneSummary
from .transport import Reply, Transport, whole_reply
from .warned import Warned


class Scene(NamedTuple):
    id: str
    summary: SceneSummary


SceneLike = Union[Scene, str, Path, bytes]
NODES_ON_PAGE = 10_000
State = Optional[Tuple[int, int]]  # of a file: when it was written and its size; None where it is missing


class _File(NamedTuple):
    """A scene that was uploaded from a file."""

    id: str
    states: Dict[Path, State]  # of the model and the files beside it, as they were then


def _states(paths: Iterable[Path]) -> Dict[Path, State]:
    states: Dict[Path, State] = {}
    for path in paths:
        try:
            status = path.stat()
            states[path] = (status.st_mtime_ns, status.st_size)
        except (OSError, ValueError):
            states[path] = None
    return states


def is_scene_id(scene: SceneLike) -> bool:
    return isinstance(scene, str) and re.fullmatch("[0-9a-f]{64}", scene) is not None


class SceneCalls:
    """Calls below /v1/scenes/{id}. May be used by several threads."""

    def __init__(self, http: Transport, warned: Warned):
        self._http = http
        self._warned = warned
        self._lock = threading.Lock()
        self._sources: Dict[str, Callable[[], Bundle]] = {}
        self._files: Dict[str, _File] = {}
        self._names: Dict[str, Dict[int, str]] = {}
        self._conforming: Set[str] = set()  # ids of scenes that have passed as strict

    def upload(self, source: Source, files: Mapping[str, Source] = {}, strict: bool = False,
               allow_outside_files: bool = False) -> Scene:
        def read() -> Bundle:
            return bundle(source, files, strict, allow_outside_files)

        made = read()
        # One that the server has may have been repaired.
        is_judged = not strict or made.id in self._conforming
        summary = (self._known(made.id) if made.id and is_judged else None) or self._send(made)
        with self._lock:
            self._sources[summary["id"]] = (lambda: made) if isinstance(source, bytes) else read
            if strict:
                self._conforming.add(summary["id"])
        self._warned.of_scene(summary["id"], summary.get("warnings", []))
        return Scene(summary["id"], summary)

    def forget(self, name: str) -> None:
        with self._lock:
            self._sources.pop(name, None)
            self._files = {path: each for path, each in self._files.items() if each.id != name}
            self._names.pop(name, None)

    def id_of(self, scene: SceneLike) -> str:
        """A scene's id. A path or bytes are uploaded, once for as long as the files stay as they are."""
        if isinstance(scene, Scene):
            return scene.id
        if is_scene_id(scene):
            return cast(str, scene)
        if isinstance(scene, bytes):
            name = Bundle(scene, {}).id
            return name if name in self._sources else self.upload(scene).id
        path = Path(scene).absolute()
        with self._lock:
            known = self._files.get(str(path))
        if known is None or known.states != _states(known.states):
            states = _states([path, *files_beside(path, path.read_bytes()).values()])
            known = _File(self.upload(path).id, states)
            with self._lock:
                self._files[str(path)] = known
        return known.id

    def nodes(self, scene: SceneLike) -> Iterator[NodeSummary]:
        """The nodes of a scene's file, by index."""
        query = f"?limit={NODES_ON_PAGE}"
        while True:
            page = cast(NodeList, json.loads(self.request(scene, "GET", f"/nodes{query}").body))
            yield from page["nodes"]
            if "next" not in page:
                return
            query = f"?limit={NODES_ON_PAGE}&after={page['next']}"

    def node_names(self, scene: str) -> Dict[int, str]:
        """Asked for once."""
        with self._lock:
            known = self._names.get(scene)
        if known is None:
            known = {-1: "", **{each["node"]: each["name"] for each in self.nodes(scene)}}
            with self._lock:
                self._names[scene] = known
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
        query = "?strict=true" if made.strict else ""
        reply = self._http.request(method, path + query, content, Content_Type=content_type)
        return cast(SceneSummary, json.loads(reply.body))
