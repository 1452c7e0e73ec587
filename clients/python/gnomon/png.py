"""PNG of 8 bits a channel, from and to arrays (H, W), (H, W, 3) and (H, W, 4)."""

from __future__ import annotations

import struct
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

Picture = npt.NDArray[np.uint8]
SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3, 6: 4}


def encode(picture: Picture) -> bytes:
    rows = picture[:, :, None] if picture.ndim == 2 else picture
    kind = {channels: code for code, channels in CHANNELS.items()}.get(rows.shape[2])
    if picture.dtype != np.uint8 or kind is None:
        raise ValueError(f"a PNG takes uint8 of 1, 3 or 4 channels, not {picture.dtype} {picture.shape}")
    height, width = rows.shape[:2]
    up = rows.reshape(height, -1).copy()
    up[1:] -= rows.reshape(height, -1)[:-1]
    filtered = np.concatenate([np.full((height, 1), 2, np.uint8), up], axis=1)
    head = struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0)
    return SIGNATURE + _chunk(b"IHDR", head) + _chunk(b"IDAT", zlib.compress(filtered.tobytes(), 6)) + _chunk(b"IEND", b"")


def _chunk(name: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


def decode(data: bytes) -> Picture:
    """ValueError for what is no such PNG: 16 bits, palettes and interlacing are not read."""
    if data[:8] != SIGNATURE:
        raise ValueError("this is no PNG")
    head, packed, at = b"", [], 8
    while at + 12 <= len(data):
        (length,) = struct.unpack_from(">I", data, at)
        name, content = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        if name == b"IHDR":
            head = content
        elif name == b"IDAT":
            packed.append(content)
        at += 12 + length
    if len(head) != 13:
        raise ValueError("this PNG has no head")
    width, height, bits, kind, _, _, interlaced = struct.unpack(">IIBBBBB", head)
    if bits != 8 or kind not in CHANNELS or interlaced:
        raise ValueError("only PNGs of 8 bits a channel in grey, RGB or RGBA are read")
    channels = CHANNELS[kind]
    try:
        raw = np.frombuffer(zlib.decompress(b"".join(packed)), np.uint8)
    except zlib.error as error:
        raise ValueError(f"this PNG is broken: {error}") from error
    if raw.size != height * (1 + width * channels):
        raise ValueError("this PNG has too few or too many bytes")
    rows = raw.reshape(height, -1)
    picture = np.zeros((height + 1, width, channels), np.uint8)
    for y in range(height):
        picture[y + 1] = _unfiltered(int(rows[y, 0]), rows[y, 1:].reshape(width, channels), picture[y])
    return picture[1:, :, 0] if channels == 1 else picture[1:]


def _unfiltered(kind: int, row: Picture, above: Picture) -> Any:
    if kind == 0:
        return row
    if kind == 1:
        return np.cumsum(row, axis=0, dtype=np.uint8)
    if kind == 2:
        return row + above
    if kind not in (3, 4):
        raise ValueError(f"this PNG has a filter of kind {kind}")
    done = row.astype(int)
    over = above.astype(int)
    left = corner = np.zeros(row.shape[1], int)
    for x in range(len(row)):
        guess = (left + over[x]) // 2 if kind == 3 else _paeth(left, over[x], corner)
        left, corner = (done[x] + guess) & 255, over[x]
        done[x] = left
    return done


def _paeth(left: Any, above: Any, corner: Any) -> Any:
    by_left, by_above, by_corner = abs(above - corner), abs(left - corner), abs(left + above - 2 * corner)
    return np.where((by_left <= by_above) & (by_left <= by_corner), left, np.where(by_above <= by_corner, above, corner))
