"""What comes piece by piece: events, and the parts of multipart/mixed."""

from __future__ import annotations

import json
from email.message import Message
from email.parser import BytesHeaderParser
from http.client import HTTPResponse
from typing import Any, BinaryIO, Iterator, NamedTuple, Union

from .problems import problem_from


class Event(NamedTuple):
    name: str
    data: Any


class Part(NamedTuple):
    headers: Message
    content: bytes


def events(stream: Union[BinaryIO, Any]) -> Iterator[Event]:
    """The events of text/event-stream, their data read as JSON; an event `problem` is raised."""
    name, data = "message", []
    for raw in stream:
        line = raw.decode("utf-8").rstrip("\r\n")
        field, _, value = line.partition(":")
        value = value[1:] if value.startswith(" ") else value
        if field == "event":
            name = value
        elif field == "data":
            data.append(value)
        elif not line and data:
            text = "\n".join(data)
            if name == "problem":
                raise problem_from(0, text.encode())
            yield Event(name, json.loads(text))
            name, data = "message", []


def parts(stream: Union[BinaryIO, Any], boundary: str) -> Iterator[Part]:
    """The parts of multipart/mixed, each as soon as it is there."""
    mark = b"--" + boundary.encode()
    line = stream.readline()
    while line.rstrip(b"\r\n") != mark:
        if not line or line.rstrip(b"\r\n") == mark + b"--":
            return
        line = stream.readline()
    while True:
        head = b""
        line = stream.readline()
        while line not in (b"\r\n", b"\n", b""):
            head += line
            line = stream.readline()
        headers = BytesHeaderParser().parsebytes(head)
        length = headers.get("Content-Length")
        content = _exactly(stream, int(length)) if length is not None else b""
        before = len(content)
        line = stream.readline()
        pieces = [content]
        while line.rstrip(b"\r\n") not in (mark, mark + b"--"):
            if not line:
                raise ConnectionError("the reply ended in the middle of a part")
            pieces.append(line)
            line = stream.readline()
        whole = b"".join(pieces)
        yield Part(headers, whole[:-2] if len(whole) > before else whole)
        if line.rstrip(b"\r\n") == mark + b"--":
            return


def _exactly(stream: Union[BinaryIO, Any], length: int) -> bytes:
    pieces = []
    while length > 0:
        piece = stream.read(min(length, 1 << 20))
        if not piece:
            raise ConnectionError("the reply ended in the middle of a part")
        pieces.append(piece)
        length -= len(piece)
    return b"".join(pieces)


def sequence_parts(reply: HTTPResponse) -> Iterator[Part]:
    """The frames of a sequence's multipart/mixed. Its problem is raised, and a ConnectionError without its end."""
    for part in parts(reply, str(reply.headers.get_param("boundary"))):
        kind = part.headers.get_content_type()
        if kind == "application/problem+json":
            raise problem_from(0, part.content)
        if kind == "application/json":
            return
        yield part
    raise ConnectionError("the sequence ended without its report")
