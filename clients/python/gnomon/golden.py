"""Pictures compared with stored ones."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple, Optional, Union

import numpy as np

from . import png
from .frame import Frame
from .picture import Picture


class Tolerance(NamedTuple):
    """What may differ: the largest difference of any channel of a pixel, and the mean over all, of 255."""

    max: float = 0
    mean: float = 0


class Difference(NamedTuple):
    max: float
    mean: float

    def within(self, tolerance: Tolerance) -> bool:
        return self.max <= tolerance.max and self.mean <= tolerance.mean


def difference(left: Picture, right: Picture) -> Difference:
    """ValueError for pictures of different shapes."""
    if left.shape != right.shape:
        raise ValueError(f"pictures of {left.shape} and {right.shape} can't be compared")
    apart = np.abs(left.astype(int) - right.astype(int))
    return Difference(float(apart.max()), float(apart.mean()))


def diff_picture(left: Picture, right: Picture) -> Picture:
    """Left, right, and their difference, eight times as strong, side by side."""
    one, other = _rgb(left), _rgb(right)
    apart = np.clip(np.abs(one.astype(int) - other.astype(int)) * 8, 0, 255).astype(np.uint8)
    return np.concatenate([one, other, apart], axis=1)


def _rgb(picture: Picture) -> Picture:
    """An opacity is shown over black."""
    if picture.ndim == 2:
        return np.repeat(picture[:, :, None], 3, axis=2)
    if picture.shape[2] == 4:
        shown: Picture = (picture[:, :, :3].astype(int) * picture[:, :, 3:] // 255).astype(np.uint8)
        return shown
    return picture


def check(frame: Union[Frame, Picture], stored: Path, failures: Path, tolerance: Tolerance, view: Optional[str] = None,
          update: bool = False) -> None:
    """AssertionError unless the frame looks like the stored PNG; what differs is then a picture in `failures`."""
    now = frame.picture(view) if isinstance(frame, Frame) else frame
    if update:
        stored.parent.mkdir(parents=True, exist_ok=True)
        stored.write_bytes(png.encode(now))
        return
    if not stored.exists():
        raise AssertionError(f"there is no {stored}: --gnomon-update writes it")
    before = png.decode(stored.read_bytes())
    if before.shape != now.shape:
        raise AssertionError(f"{stored.name} has the shape {before.shape}, the frame {now.shape}")
    apart = difference(now, before)
    if not apart.within(tolerance):
        failures.mkdir(parents=True, exist_ok=True)
        shown = failures / f"{stored.stem}-diff.png"
        shown.write_bytes(png.encode(diff_picture(now, before)))
        raise AssertionError(f"{stored.name} differs by {apart.max:g} at most and {apart.mean:.3g} in the mean; accepted: "
                             f"{tolerance.max:g} and {tolerance.mean:g}. Now, stored, difference x 8: {shown}")
