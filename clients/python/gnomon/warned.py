"""What a server has found odd about scenes and frames, as warnings of Python."""

from __future__ import annotations

import re
import sys
import threading
import warnings
from typing import Iterable, Mapping, Set, Tuple


class GnomonWarning(UserWarning):
    """A scene, or what was asked of it, is drawn differently from what one may expect."""


class Warned:
    """Warns of each thing once for each scene."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._told: Set[Tuple[str, str]] = set()

    def of_scene(self, scene: str, texts: Iterable[str]) -> None:
        self._tell(scene, {text: text for text in texts})

    def of_frame(self, scene: str, texts: Iterable[str]) -> None:
        """What the scene's warnings have said already is left out, and what differs from an earlier frame's in numbers
        alone."""
        self._tell(scene, {text: re.sub(r"[0-9.]+", "0", text) for text in texts})

    def _tell(self, scene: str, kinds: Mapping[str, str]) -> None:
        with self._lock:
            news = [text for text, kind in kinds.items() if self._told.isdisjoint({(scene, text), (scene, kind)})]
            self._told.update((scene, kind) for kind in kinds.values())
        for text in news:
            warnings.warn(text, GnomonWarning, stacklevel=_outside())


def _outside() -> int:
    """The stack level, as the function that calls this counts it, of the first one outside of this package."""
    level = 1
    frame = sys._getframe(1)
    inside = (__name__.partition(".")[0], "contextlib")  # a frame between calls of the package
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).partition(".")[0] in inside:
        frame = frame.f_back
        level += 1
    return level
