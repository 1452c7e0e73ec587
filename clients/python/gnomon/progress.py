"""A progress bar, where tqdm is installed."""

from __future__ import annotations

import importlib
from typing import Any, Optional


class Progress:
    def __init__(self, what: str, shown: bool):
        self._what = what
        self._bar: Optional[Any] = None
        self._shown = shown

    def at(self, done: float, of: float) -> None:
        if not self._shown:
            return
        if self._bar is None:
            try:
                tqdm = importlib.import_module("tqdm.auto").tqdm
            except ImportError:
                self._shown = False
                return
            self._bar = tqdm(total=of, desc=self._what)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
