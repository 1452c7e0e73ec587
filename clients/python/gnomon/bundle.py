"""A scene as it is uploaded: a model, and the files that it names."""

from __future__ import annotations

import hashlib
import json
import os
import re
import struct
import urllib.parse
from pathlib import Path
from typing import Dict, List, Mapping, NamedTuple, Union

Source = Union[str, Path, bytes]


class Bundle(NamedTuple):
    model: bytes
    files: Dict[str, bytes]

    @property
    def id(self) -> str:
        """The scene's id, or "" where only the server knows it: for a model with files."""
        return "" if self.files else hashlib.sha256(self.model).hexdigest()


def bundle(source: Source, files: Mapping[str, Source] = {}) -> Bundle:
    """A .glb or .gltf by its path, with what it names beside it, or its bytes; and further files by name."""
    more = {name: _content(each) for name, each in files.items()}
    model = _content(source)
    if isinstance(source, bytes):
        return Bundle(model, more)
    beside = files_beside(source, model)
    return Bundle(model, {**{name: path.read_bytes() for name, path in beside.items() if os.path.isfile(path)}, **more})


def files_beside(source: Union[str, Path], model: bytes) -> Dict[str, Path]:
    """Where the files are that a model names, by their names in an upload. The server judges those that are missing."""
    names = {re.sub("^(\\./+)+", "", urllib.parse.unquote(uri)) for uri in uris(model)}
    return {name: Path(source).parent / name for name in sorted(names)}


def uris(model: bytes) -> List[str]:
    """The addresses of buffers and images beside or below a glTF, in either of its forms; none of what is no glTF."""
    text = model
    if model[:4] == b"glTF" and len(model) >= 20:
        text = model[20:20 + struct.unpack_from("<I", model, 12)[0]]
    try:
        gltf = json.loads(text)
        entries = [*gltf.get("buffers", []), *gltf.get("images", [])]
        found = [each["uri"] for each in entries if "uri" in each]
        return sorted({uri for uri in found if _is_below(uri)})
    except (ValueError, TypeError, AttributeError):
        return []


def _is_below(uri: str) -> bool:
    path = urllib.parse.unquote(uri)
    return ":" not in path and "\\" not in path and not path.startswith("/") and ".." not in path.split("/")


def _content(source: Source) -> bytes:
    return source if isinstance(source, bytes) else Path(source).read_bytes()


class Body(NamedTuple):
    content_type: str
    content: bytes


def upload_body(made: Bundle) -> Body:
    if not made.files:
        return Body("model/gltf-binary" if made.model[:4] == b"glTF" else "model/gltf+json", made.model)
    boundary = "gnomon-" + hashlib.sha256(b"".join([made.model, *made.files.values()])).hexdigest()[:32]
    body = [_part(boundary, 'name="scene"; filename="scene"', made.model)]
    body += [_part(boundary, f'name="file"; filename="{_quoted(name)}"', each) for name, each in made.files.items()]
    return Body(f"multipart/form-data; boundary={boundary}", b"".join([*body, f"--{boundary}--\r\n".encode()]))


def _part(boundary: str, disposition: str, content: bytes) -> bytes:
    return f"--{boundary}\r\nContent-Disposition: form-data; {disposition}\r\n\r\n".encode() + content + b"\r\n"


def _quoted(name: str) -> str:
    """As browsers write it (WHATWG, multipart/form-data)."""
    return name.replace('"', "%22").replace("\r", "%0D").replace("\n", "%0A")
