"""A server, and what can be asked of it."""

from __future__ import annotations

import json
import os
from http.client import HTTPException
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union, cast
from urllib.parse import quote

from . import keywords
from .bundle import Source
from .frame import Frame, read_frame
from .json_form import Spec, encoded, frame_spec
from .jobs import Job
from .local_server import LocalServer
from .problems import ConnectionFailed
from .progress import Progress
from .reports import BakeReport, Capabilities, EvaluationReport, NodeSummary, PlanReport, SceneSummary, SequenceReport
from .reports import Job as JobReport
from .rows import Rows, flat_rows
from .scene_calls import Scene, SceneCalls, SceneLike
from .streams import events, sequence_parts
from .transport import Transport
from .typed_calls import method_of
from .warned import Warned
from .webm import check_video_name, save_video, whole_file

USUAL_VIEWS = ("color", "depth", "ids", "shadow")
MOST_FAILURES = 3  # of a sequence, one after the other
Patch = Mapping[str, Any]


class Session:
    """Talks to `server`, or GNOMON_SERVER, or starts a server of its own, which ends with the session.

    `flags` are those of `gnomon serve` for a server of its own. `key`, or GNOMON_KEY, is the secret of a server that
    asks for one. `timeout` is how many seconds the server may be silent, `patience` how many in all a request may wait
    while the server is busy, restarts or cannot be reached. A session may be used by several threads.
    """

    def __init__(self, server: Optional[str] = None, *, key: Optional[str] = None,
                 binary: Union[str, Path, None] = None, flags: Sequence[str] = (), timeout: float = 630,
                 patience: float = 60, progress: bool = False):
        url = server or (None if binary or flags else os.environ.get("GNOMON_SERVER"))
        self._own = None if url else LocalServer(*flags, binary=binary)
        self.url = url or cast(LocalServer, self._own).url
        self.progress = progress
        self._http = Transport(self.url, key or os.environ.get("GNOMON_KEY"), timeout, patience)
        self._warned = Warned()
        self._scenes = SceneCalls(self._http, self._warned)

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def close(self) -> None:
        self._http.close()
        if self._own is not None:
            self._own.close()

    def upload(self, source: Source, files: Mapping[str, Source] = {}, *, strict: bool = False,
               allow_outside_files: bool = False) -> Scene:
        """Stores a scene, unless the server has it: a .glb or .gltf by its path (with what it names beside it) or its
        bytes, and further files by name. `strict` refuses a model that violates glTF, instead of repairing it.
        `allow_outside_files` sends also what a model names outside of its folder."""
        return self._scenes.upload(source, files, strict, allow_outside_files)

    def scene(self, scene: SceneLike) -> SceneSummary:
        """What a scene holds."""
        return cast(SceneSummary, json.loads(self._scenes.request(scene, "GET", "").body))

    def nodes(self, scene: SceneLike) -> Iterator[NodeSummary]:
        """The nodes of a scene's file by their index, which `ids` shows: name, parent, triangles."""
        return self._scenes.nodes(scene)

    def list(self) -> Iterator[SceneSummary]:
        """All scenes of the server, by id."""
        after = ""
        while True:
            page = json.loads(self._http.request("GET", "/v1/scenes" + (f"?after={quote(after)}" if after else "")).body)
            yield from page["scenes"]
            if "next" not in page:
                return
            after = page["next"]

    def delete(self, scene: Union[Scene, str]) -> None:
        """Removes a scene from the server."""
        name = scene.id if isinstance(scene, Scene) else scene
        self._scenes.forget(name)
        self._http.request("DELETE", f"/v1/scenes/{quote(name)}")

    def capabilities(self) -> Capabilities:
        """What draws, its fingerprint, and the server's limits."""
        return cast(Capabilities, json.loads(self._http.request("GET", "/v1/capabilities").body))

    @method_of(keywords.frame)
    def frame(self, scene: SceneLike, spec: Optional[Spec] = None, **fields: Any) -> Frame:
        """Renders. `fields` are those of a FrameSpec, on top of `spec`, and `sun=(azimuth, elevation)` in degrees.
        Without `views`, these are color, depth, ids and shadow."""
        asked = {"views": list(USUAL_VIEWS), **frame_spec(spec, **fields)}
        reply = self._scenes.request(scene, "POST", "/frames", asked, Accept="application/zip")
        return self._frame_of(scene, reply.body)

    @method_of(keywords.picture)
    def picture(self, scene: SceneLike, spec: Optional[Spec] = None, media_type: str = "image/png",
                **fields: Any) -> bytes:
        """A frame as a file: image/png, image/x-exr, image/tiff, image/jpeg, image/webp or application/x-npy."""
        return self._scenes.request(scene, "POST", "/frames", frame_spec(spec, **fields), Accept=media_type).body

    @method_of(keywords.frame)
    def plan(self, scene: SceneLike, spec: Optional[Spec] = None, **fields: Any) -> PlanReport:
        """What a frame would do, without rendering it."""
        report = json.loads(self._scenes.request(scene, "POST", "/plan", frame_spec(spec, **fields)).body)
        self._warn(scene, report)
        return cast(PlanReport, report)

    @method_of(keywords.evaluate)
    def evaluate(self, scene: SceneLike, spec: Optional[Spec] = None, *, variants: Optional[Sequence[Patch]] = None,
                 sweep: Optional[str] = None, repeats: Optional[int] = None, referenceSamples: Optional[int] = None,
                 path: Optional[Any] = None, **fields: Any) -> Rows:
        """Speed against error: a row for each variant, as pandas.DataFrame takes them. `Rows.report` has all."""
        asked = {"spec": frame_spec(spec, **fields), "variants": variants, "sweep": sweep, "repeats": repeats,
                 "referenceSamples": referenceSamples, "path": path}
        report = self._events(scene, "/evaluations", asked, "evaluating", lambda data: (data["done"], data["of"]))
        return flat_rows(cast(EvaluationReport, report))

    @method_of(keywords.frame)
    def bake(self, scene: SceneLike, spec: Optional[Spec] = None, **fields: Any) -> BakeReport:
        """Bakes the light maps of a frame's lights, ahead of the frames that look them up."""
        asked = frame_spec(spec, **fields)
        report = self._events(scene, "/bakes", asked, "baking", lambda data: (data["done"] + data["share"], data["of"]))
        return cast(BakeReport, report)

    def baked(self, scene: SceneLike, key: str, media_type: str = "model/gltf-binary",
              light: Union[int, str, None] = None) -> bytes:
        """A bake as a file: model/gltf-binary, image/png or image/x-exr; of one light, or of "environment"."""
        query = "" if light is None else f"?light={light}"
        return self._scenes.request(scene, "GET", f"/bakes/{quote(key)}{query}", Accept=media_type).body

    @method_of(keywords.sequence)
    def sequence(self, scene: SceneLike, spec: Optional[Spec] = None, *, frames: Optional[Sequence[Patch]] = None,
                 keys: Optional[Sequence[Patch]] = None, count: Optional[int] = None, stable: bool = True,
                 **fields: Any) -> Iterator[Frame]:
        """Frames as they are drawn: one for each merge patch of `frames` over the spec, or `count` of them between
        `keys`. Leaving the loop stops the server's work. A connection that is lost meanwhile is made again."""
        asked = sequence_request(spec, frames, keys, count, stable, fields)
        return self._frames(scene, asked, (count if frames is None else len(frames)) or 0)

    @method_of(keywords.sequence)
    def submit(self, scene: SceneLike, spec: Optional[Spec] = None, *, frames: Optional[Sequence[Patch]] = None,
               keys: Optional[Sequence[Patch]] = None, count: Optional[int] = None, stable: bool = True,
               **fields: Any) -> Job:
        """The same frames as those of `sequence`, drawn in the background."""
        asked = sequence_request(spec, frames, keys, count, stable, fields)
        reply = self._scenes.request(scene, "POST", "/sequences", asked, Prefer="respond-async")
        return self._job(json.loads(reply.body))

    def job(self, name: str) -> Job:
        """A job by its id."""
        return self._job(json.loads(self._http.request("GET", f"/v1/jobs/{quote(name)}").body))

    def jobs(self) -> List[Job]:
        """The jobs of the session's key, the newest first."""
        return [self._job(report) for report in json.loads(self._http.request("GET", "/v1/jobs").body)["jobs"]]

    def _job(self, report: JobReport) -> Job:
        scene = report["scene"]
        return Job(self._http, report, lambda content, index: self._frame_of(scene, content, index), self.progress)

    @method_of(keywords.video)
    def video(self, scene: SceneLike, path: Union[str, Path], spec: Optional[Spec] = None, *,
              frames: Optional[Sequence[Patch]] = None, keys: Optional[Sequence[Patch]] = None, count: Optional[int] = None,
              stable: bool = True, framesPerSecond: Optional[float] = None, videoQuality: Optional[int] = None,
              **fields: Any) -> SequenceReport:
        """A sequence as a WebM of its first view: `path` ends in .webm. The file appears once it is whole; a video that
        breaks off is not gone on with."""
        check_video_name(path)
        asked = {"spec": frame_spec(spec, **fields), "frames": frames, "keys": keys, "count": count, "stable": stable,
                 "framesPerSecond": framesPerSecond, "videoQuality": videoQuality}
        of = (count if frames is None else len(frames)) or 0
        bar = Progress("rendering", self.progress)
        try:
            with whole_file(path) as file, \
                    self._scenes.stream(scene, "POST", "/sequences", encoded(given(asked)), Accept="video/webm") as reply:
                report = cast(SequenceReport, save_video(reply, file, lambda done: bar.at(done, of)))
        finally:
            bar.close()
        self._warn(scene, report)
        return report

    def _frames(self, scene: SceneLike, asked: Dict[str, Any], of: int) -> Iterator[Frame]:
        """The frames of a sequence. A reply that breaks off is gone on with behind its last whole frame, which gives the
        same frames; not for ever, if no more of them come."""
        bar = Progress("rendering", self.progress)
        done, failures = 0, 0
        try:
            while True:
                try:
                    with self._scenes.stream(scene, "POST", "/sequences", encoded(asked), Accept="multipart/mixed") as reply:
                        for part in sequence_parts(reply):
                            frame = self._frame_of(scene, part.content, done)
                            done, failures = done + 1, 0
                            asked = {**asked, "first": done, "carried": json.loads(part.headers["Gnomon-Carried"])}
                            yield frame
                            bar.at(done, of)
                    return
                except (ConnectionError, HTTPException) as error:
                    self._http.check_cancelled()
                    failures += 1
                    if isinstance(error, ConnectionFailed) or failures > MOST_FAILURES:
                        raise
                    if 0 < of <= done:
                        return
        finally:
            bar.close()

    def _events(self, scene: SceneLike, tail: str, asked: Dict[str, Any], what: str,
                share: Callable[[Dict[str, Any]], Tuple[float, float]]) -> Any:
        """The event `result` of a long work, its progress shown meanwhile."""
        bar = Progress(what, self.progress)
        try:
            with self._scenes.stream(scene, "POST", tail, encoded(given(asked)), Accept="text/event-stream") as response:
                for event in events(response):
                    if event.name == "progress":
                        bar.at(*share(event.data))
                    elif event.name == "result":
                        return event.data
        finally:
            bar.close()
        raise ConnectionError("the server's events ended without a result")

    def _frame_of(self, scene: SceneLike, content: bytes, index: int = 0) -> Frame:
        name = self._scenes.id_of(scene)
        frame = read_frame(content, lambda spec, media_type: self.picture(name, spec, media_type), index,
                           lambda: self._scenes.node_names(name))
        self._warn(name, frame.report)
        return frame

    def _warn(self, scene: SceneLike, report: Mapping[str, Any]) -> None:
        self._warned.of_frame(self._scenes.id_of(scene), report.get("warnings", []))


def sequence_request(spec: Optional[Spec], frames: Optional[Sequence[Patch]], keys: Optional[Sequence[Patch]],
                     count: Optional[int], stable: bool, fields: Mapping[str, Any]) -> Dict[str, Any]:
    """A sequence whose frames are arrays."""
    first: Dict[str, Any] = {"views": list(USUAL_VIEWS), **frame_spec(spec, **fields)}
    first["output"] = {**first.get("output", {}), "format": "npz"}
    return given({"spec": first, "frames": frames, "keys": keys, "count": count, "stable": stable})


def given(fields: Mapping[str, Any]) -> Dict[str, Any]:
    return {name: value for name, value in fields.items() if value is not None}
