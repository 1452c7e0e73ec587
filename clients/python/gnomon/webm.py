"""A sequence's video while it is received: its frames are counted, and the text at its end is found."""

from __future__ import annotations

import contextlib
import json
import os
import secrets
from pathlib import Path
from typing import Any, BinaryIO, Callable, Iterator, Optional, Tuple, Union

from .problems import problem_from

SEGMENT, CLUSTER, TAGS = 0x18538067, 0x1F43B675, 0x1254C367
TAG, SIMPLE_TAG, NAME, STRING = 0x7373, 0x67C8, 0x45A3, 0x4487


def check_video_name(path: Union[str, Path]) -> None:
    if Path(path).suffix.lower() != ".webm":
        raise ValueError(f"a video is a WebM, so its name ends in .webm; got {os.fspath(path)}")


@contextlib.contextmanager
def whole_file(path: Union[str, Path]) -> Iterator[BinaryIO]:
    """A file that is put in place once all of it is written; else there is none."""
    unfinished = f"{os.fspath(path)}.{secrets.token_hex(4)}"
    with open(unfinished, "xb") as file:
        try:
            yield file
            file.close()
            os.replace(unfinished, path)
        except BaseException:
            os.unlink(unfinished)
            raise


class _Copied:
    """Reads a stream exactly, and writes all that it reads."""

    def __init__(self, stream: Union[BinaryIO, Any], file: BinaryIO):
        self._stream = stream
        self._file = file

    def read(self, size: int, keep: bool = True) -> bytes:
        pieces = []
        while size > 0:
            piece = self._stream.read(min(size, 1 << 20))
            if not piece:
                raise ConnectionError("the video ended without its report")
            self._file.write(piece)
            size -= len(piece)
            if keep:
                pieces.append(piece)
        return b"".join(pieces)

    def number(self) -> Tuple[int, int]:
        """A number of EBML (RFC 8794), whose first bits give its length; and how many bytes that is."""
        first = self.read(1)
        length = 9 - first[0].bit_length()
        if length > 8:
            raise ConnectionError("the video is broken")
        return int.from_bytes(first + self.read(length - 1), "big"), length


def _within(data: bytes, name: int) -> bytes:
    """What the first element of this id holds."""
    at = 0
    while at < len(data):
        id_length = 9 - data[at].bit_length()
        found, at = int.from_bytes(data[at:at + id_length], "big"), at + id_length
        size_length = 9 - data[at].bit_length()
        size, at = int.from_bytes(data[at:at + size_length], "big") - (1 << 7 * size_length), at + size_length
        if found == name:
            return data[at:at + size]
        at += size
    raise ConnectionError("the video is broken")


def save_video(stream: Union[BinaryIO, Any], file: BinaryIO, on_frame: Callable[[int], Optional[object]]) -> Any:
    """Copies a video to a file, and gives its report. Its problem is raised, and a ConnectionError without its end."""
    source = _Copied(stream, file)
    frames = 0
    while True:
        name, _ = source.number()
        size, length = source.number()
        if name == SEGMENT:
            continue
        content = source.read(size - (1 << 7 * length), keep=name == TAGS)
        if name == CLUSTER:
            frames += 1
            on_frame(frames)
        elif name == TAGS:
            tag = _within(_within(content, TAG), SIMPLE_TAG)
            text = _within(tag, STRING)
            if _within(tag, NAME) == b"GNOMON_PROBLEM":
                raise problem_from(0, text)
            return json.loads(text)
