"""A rendered frame: its views as arrays, and its report."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, Mapping, Optional, Tuple, Union, cast

import numpy as np
import numpy.typing as npt

from . import png
from .picture import Picture, picture_of
from .reports import FrameReport

Array = npt.NDArray[Any]
Redraw = Callable[[Dict[str, Any], str], bytes]  # (spec, media type) -> the file
Names = Callable[[], Dict[int, str]]
MEDIA_TYPES = {".png": "image/png", ".exr": "image/x-exr", ".tiff": "image/tiff", ".tif": "image/tiff",
               ".jpg": "image/jpeg", ".jpeg": "image/jpeg", ".webp": "image/webp", ".npy": "application/x-npy"}


class Frame:
    """Every view that was asked for is an attribute: `frame.color`, `frame.depth`. Rows come first, from the top.

    `color` and other pictures are uint8 (H, W, 3), or (H, W, 4) where the background is not opaque, or float32 with
    `output.arrayColors` linear. `ids`, `instances`, `materials`, `casterIds` are int32, -1 = nothing. `depth` is in
    metres, infinite where nothing is. `normal` and `position` are float32 (H, W, 3), `motion` (H, W, 2), `shadow` and
    other numbers (H, W).
    """

    color: Array
    depth: Array
    normal: Array
    ids: Array
    instances: Array
    materials: Array
    albedo: Array
    position: Array
    motion: Array
    shadow: Array
    reference: Array
    error: Array
    casterIds: Array

    def __init__(self, views: Mapping[str, Array], report: FrameReport, content: bytes = b"",
                 redraw: Optional[Redraw] = None, index: int = 0, names: Optional[Names] = None):
        self.views = views
        self.report = report
        self.index = index  # in a sequence
        self._content = content
        self._redraw = redraw
        self._names = names

    def __getattr__(self, name: str) -> Array:
        views = self.__dict__.get("views", {})
        if name in views:
            return cast(Array, views[name])
        raise AttributeError(f"this frame has no {name!r}; its views are {', '.join(views)}: ask for others by views=[...]")

    def __dir__(self) -> Any:
        return [*super().__dir__(), *self.views]

    def __repr__(self) -> str:
        height, width = self.size[::-1]
        return f"<gnomon.Frame {width} x {height}: {', '.join(self.views)}>"

    @property
    def size(self) -> Tuple[int, int]:
        """Width and height."""
        height, width = next(iter(self.views.values())).shape[:2]
        return width, height

    @property
    def timings(self) -> Dict[str, float]:
        """Milliseconds of each stage."""
        return self.report.get("stages", {})

    @property
    def names(self) -> Dict[int, str]:
        """The name of every node of the scene by its index, as `ids` and `casterIds` have it; "" for -1, where nothing
        is, and for nodes without a name. The server is asked when it is first needed."""
        if self._names is None:
            raise ValueError("this frame belongs to no session, which knows the names of nodes")
        return self._names()

    def picture(self, view: Optional[str] = None) -> Picture:
        """A view as uint8 for people to look at; the first unless one is named."""
        name = view or next(iter(self.views))
        return picture_of(name, getattr(self, name))

    def npz(self, **arrays: npt.ArrayLike) -> bytes:
        """An .npz as the server sent it, with all views and the report, and with further arrays, such as labels of a data
        set."""
        if not arrays:
            return self._content
        whole = io.BytesIO(self._content)
        with zipfile.ZipFile(whole, "a") as archive:
            for name, values in arrays.items():
                if name in self.views:
                    raise ValueError(f"{name!r} is a view of the frame")
                with archive.open(zipfile.ZipInfo(f"{name}.npy"), "w") as file:
                    np.save(file, values, allow_pickle=False)
        return whole.getvalue()

    def save(self, path: Union[str, Path], view: Optional[str] = None) -> None:
        """Writes .npz (all views and the report), or .npy .png .exr .tiff .jpg .webp, for which the server draws the
        frame once more; but a PNG of `color` is written from the array. The first view unless one is named; an .exr
        has all."""
        path = Path(path)
        suffix = path.suffix.lower()
        if suffix == ".npz":
            path.write_bytes(self.npz())
            return
        if suffix not in MEDIA_TYPES:
            raise ValueError(f"{path.name!r} does not end in {' '.join(['.npz', *MEDIA_TYPES])}")
        name = view or next(iter(self.views))
        values = getattr(self, name)
        if suffix == ".png" and values.dtype == np.uint8:
            path.write_bytes(png.encode(values))
            return
        if self._redraw is None:
            raise ValueError("this frame belongs to no session: only .npz, and .png of colors, can be written")
        views = [name] if view or suffix != ".exr" else list(self.views)
        path.write_bytes(self._redraw({**self.report["spec"], "views": views}, MEDIA_TYPES[suffix]))

    def __getstate__(self) -> Dict[str, Any]:
        """Pickled as it is read from a file: without its session."""
        return {**self.__dict__, "_redraw": None, "_names": None}

    def _repr_png_(self) -> bytes:
        return png.encode(self.picture())


class StoredArrays(Mapping[str, Array]):
    """The arrays of a .npz, each read on first access."""

    def __init__(self, content: bytes, names: Tuple[str, ...]):
        self._content = content
        self._names = names
        self._read: Dict[str, Array] = {}

    def __getitem__(self, name: str) -> Array:
        if name not in self._names:
            raise KeyError(name)
        if name not in self._read:
            with zipfile.ZipFile(io.BytesIO(self._content)) as archive:
                self._read[name] = np.load(io.BytesIO(archive.read(f"{name}.npy")), allow_pickle=False)
        return self._read[name]

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def read_frame(content: bytes, redraw: Optional[Redraw] = None, index: int = 0, names: Optional[Names] = None) -> Frame:
    """The frame in a .npz as the server sends it, and as `save` writes it."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        report = json.loads(archive.read("report.json"))
        views = tuple(name[:-len(".npy")] for name in archive.namelist() if name.endswith(".npy"))
    return Frame(StoredArrays(content, views), report, content, redraw, index, names)
