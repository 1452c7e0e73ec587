"""A session for asyncio: each call runs in a thread, and cancelling it closes its connection."""

from __future__ import annotations

import asyncio
import contextlib
import contextvars
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, AsyncIterator, Callable, Generator, List, Mapping, Optional, Sequence, TypeVar, Union, cast

from . import keywords
from .bundle import Source
from .frame import Frame
from .jobs import Job
from .json_form import Spec
from .reports import BakeReport, Capabilities, NodeSummary, PlanReport, SceneSummary, SequenceReport
from .reports import Job as JobReport
from .rows import Rows
from .scene_calls import Scene, SceneLike
from .session import Patch, Session
from .transport import CANCEL, Cancel
from .typed_calls import method_of

T = TypeVar("T")


class AsyncSession:
    """What `Session` has, to be awaited; `concurrency` calls run at once and further ones wait for their turn."""

    def __init__(self, server: Optional[str] = None, *, concurrency: int = 8, key: Optional[str] = None,
                 binary: Union[str, Path, None] = None, flags: Sequence[str] = (), timeout: float = 630,
                 patience: float = 60, progress: bool = False):
        self._threads = ThreadPoolExecutor(concurrency, thread_name_prefix="gnomon")
        self._start = lambda: Session(server, key=key, binary=binary, flags=flags, timeout=timeout, patience=patience,
                                      progress=progress)
        self._session: Optional[Session] = None

    async def __aenter__(self) -> "AsyncSession":
        self._session = await self._run(self._start)
        return self

    async def __aexit__(self, *_: Any) -> None:
        await self._run(self.session.close)
        self._threads.shutdown(wait=False)

    @property
    def session(self) -> Session:
        if self._session is None:
            raise RuntimeError("an AsyncSession is used in `async with`")
        return self._session

    async def _run(self, call: Callable[[], T], cancel: Optional[Cancel] = None) -> T:
        cancel = cancel or Cancel()
        context = contextvars.copy_context()
        context.run(CANCEL.set, cancel)
        try:
            return await asyncio.get_running_loop().run_in_executor(self._threads, context.run, call)
        except asyncio.CancelledError:
            cancel.set()
            raise

    async def upload(self, source: Source, files: Mapping[str, Source] = {}, *, strict: bool = False,
                     allow_outside_files: bool = False) -> Scene:
        return await self._run(lambda: self.session.upload(source, files, strict=strict,
                                                           allow_outside_files=allow_outside_files))

    async def scene(self, scene: SceneLike) -> SceneSummary:
        return await self._run(lambda: self.session.scene(scene))

    async def nodes(self, scene: SceneLike) -> List[NodeSummary]:
        return await self._run(lambda: [*self.session.nodes(scene)])

    async def list(self) -> List[SceneSummary]:
        return await self._run(lambda: [*self.session.list()])

    async def delete(self, scene: Union[Scene, str]) -> None:
        await self._run(lambda: self.session.delete(scene))

    async def capabilities(self) -> Capabilities:
        return await self._run(lambda: self.session.capabilities())

    @method_of(keywords.frame)
    async def frame(self, scene: SceneLike, spec: Optional[Spec] = None, **fields: Any) -> Frame:
        return await self._run(lambda: self.session.frame(scene, spec, **fields))

    @method_of(keywords.picture)
    async def picture(self, scene: SceneLike, spec: Optional[Spec] = None, media_type: str = "image/png",
                      **fields: Any) -> bytes:
        return await self._run(lambda: self.session.picture(scene, spec, media_type, **fields))

    @method_of(keywords.frame)
    async def plan(self, scene: SceneLike, spec: Optional[Spec] = None, **fields: Any) -> PlanReport:
        return await self._run(lambda: self.session.plan(scene, spec, **fields))

    @method_of(keywords.evaluate)
    async def evaluate(self, scene: SceneLike, spec: Optional[Spec] = None, **options: Any) -> Rows:
        return await self._run(lambda: self.session.evaluate(scene, spec, **options))

    @method_of(keywords.frame)
    async def bake(self, scene: SceneLike, spec: Optional[Spec] = None, **fields: Any) -> BakeReport:
        return await self._run(lambda: self.session.bake(scene, spec, **fields))

    async def baked(self, scene: SceneLike, key: str, media_type: str = "model/gltf-binary",
                    light: Union[int, str, None] = None) -> bytes:
        return await self._run(lambda: self.session.baked(scene, key, media_type, light))

    @method_of(keywords.sequence)
    async def submit(self, scene: SceneLike, spec: Optional[Spec] = None, **options: Any) -> Job:
        return await self._run(lambda: self.session.submit(scene, spec, **options))

    async def wait(self, job: Job, timeout: Optional[float] = None) -> JobReport:
        """That of the job; cancelling it leaves the job as it is."""
        return await self._run(lambda: job.wait(timeout))

    @method_of(keywords.video)
    async def video(self, scene: SceneLike, path: Union[str, Path], spec: Optional[Spec] = None,
                    **options: Any) -> SequenceReport:
        return await self._run(lambda: self.session.video(scene, path, spec, **options))

    @method_of(keywords.sequence)
    async def sequence(self, scene: SceneLike, spec: Optional[Spec] = None, *, frames: Optional[Sequence[Patch]] = None,
                       keys: Optional[Sequence[Patch]] = None, count: Optional[int] = None, stable: bool = True,
                       **fields: Any) -> AsyncIterator[Frame]:
        cancel = Cancel()
        made = cast(Generator[Frame, None, None], self.session.sequence(scene, spec, frames=frames, keys=keys, count=count, stable=stable, **fields))
        try:
            while True:
                frame = await self._run(lambda: next(made, None), cancel)
                if frame is None:
                    return
                yield frame
        finally:
            cancel.set()
            with contextlib.suppress(ValueError):  # a thread is still in it, and leaves it now
                made.close()
