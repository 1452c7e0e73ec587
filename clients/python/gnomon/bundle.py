"""A scene as it is uploaded: a model, and the files that it names."""

from __future__ import annotations

import hashlib
import json
import os
import re
import struct
import urllib.parse
from pathlib import Path
from typing import Dict, List, Mapping, NamedTuple, Tuple, Union

Source = Union[str, Path, bytes]


class Bundle(NamedTuple):
    model: bytes
    files: Dict[str, bytes]
    strict: bool = False  # refused where it violates glTF, instead of repaired

    @property
    def id(self) -> str:
        """The scene's id, or "" where only the server knows it: for a model with files."""
        return "" if self.files else hashlib.sha256(self.model).hexdigest()


def bundle(source: Source, files: Mapping[str, Source] = {}, strict: bool = False,
           allow_outside_files: bool = False) -> Bundle:
    """A .glb or .gltf by its path, with the files that it names, or its bytes; and further files by name."""
    more = {name: _content(each) for name, each in files.items()}
    model = _content(source)
    if isinstance(source, bytes):
        return Bundle(model, more, strict)
    named = files_beside(source, model, allow_outside_files)
    found = {name: path.read_bytes() for name, path in named.items() if os.path.isfile(path)}
    return Bundle(model, {**found, **more}, strict)


def files_beside(source: Union[str, Path], model: bytes, allow_outside_files: bool = False) -> Dict[str, Path]:
    """Where the files are that a model names, by their names in an upload. The server judges those that are missing.
    A file that is there and outside of the model's folder is an error, unless it is allowed."""
    folder = Path(source).parent
    found: Dict[str, Path] = {}
    for uri in uris(model):
        name, path = _file_of(uri)
        if name:
            found[name] = folder / path
            if not allow_outside_files and os.path.isfile(found[name]) and not _is_inside(found[name], folder):
                raise ValueError(f"{os.fspath(source)}: the model names {uri!r}, a file outside of its folder, which is "
                                 "read only with allow_outside_files=True")
    return dict(sorted(found.items()))


def uris(model: bytes) -> List[str]:
    """The addresses of the files that a glTF names, in either of its forms; none of what is no glTF."""
    text = model
    if model[:4] == b"glTF" and len(model) >= 20:
        text = model[20:20 + struct.unpack_from("<I", model, 12)[0]].rstrip(b"\0")
    try:
        gltf = json.loads(text)
        entries = [*gltf.get("buffers", []), *gltf.get("images", [])]
        return sorted({each["uri"] for each in entries if "uri" in each and _file_of(each["uri"])[0]})
    except (ValueError, TypeError, AttributeError):
        return []


def _file_of(uri: str) -> Tuple[str, str]:
    """The name of a file in an upload, and its path from the model's folder; "" where the URI names none. What leads
    upwards begins with "_up" for each step, an absolute path with "_root": as the server looks for them."""
    scheme = re.match("([A-Za-z][A-Za-z0-9+.-]*):", uri)
    if scheme and scheme[1].lower() != "file":
        return "", ""
    path = re.sub("^(?://[^/]*)?", "", uri[5:]) if scheme else uri
    path = urllib.parse.unquote(path).replace("\\", "/")
    if re.search("[\\x00-\\x1f\\x7f]", path):
        return "", ""
    kept: List[str] = []
    up: List[str] = []
    for segment in path.split("/"):
        if segment == ".." and kept:
            kept.pop()
        elif segment == "..":
            up.append("_up")
        elif segment not in ("", "."):
            kept.append(segment)
    start = ["_root"] if path.startswith("/") else up
    return ("/".join([*start, *kept]), path) if kept else ("", "")


def _is_inside(path: Path, folder: Path) -> bool:
    return folder.resolve() in path.resolve().parents


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
