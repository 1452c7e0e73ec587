"""A server of this process's own, on a free port of this machine."""

from __future__ import annotations

import io
import os
import shutil
import subprocess
import tempfile
import threading
import weakref
from pathlib import Path
from typing import Any, Dict, Optional, Sequence, Tuple, Union

# Ends of pipes whose closing ends a server. A process that is forked would hold them, too, and closes its copies.
_held: "weakref.WeakSet[io.FileIO]" = weakref.WeakSet()
_opening = threading.Lock()


def _opened() -> Tuple[int, io.FileIO]:
    """A pipe's ends: for the server's standard input, and the one that this process alone holds until it ends."""
    with _opening:
        read, write = os.pipe()
        held = io.FileIO(write, "w")
        _held.add(held)
        return read, held


def _close_in_child() -> None:
    for each in list(_held):
        each.close()
    _opening.release()


os.register_at_fork(before=_opening.acquire, after_in_parent=_opening.release, after_in_child=_close_in_child)


def find_binary(binary: Union[str, Path, None] = None) -> str:
    """The path of `gnomon`: as given, or GNOMON_BINARY, or on the PATH."""
    named = str(binary) if binary is not None else os.environ.get("GNOMON_BINARY", "")
    found = shutil.which(named or "gnomon")
    if found is None:
        where = f"{named!r} is no program" if named else "there is no `gnomon` on the PATH"
        raise FileNotFoundError(f"{where}: name the program by binary= or GNOMON_BINARY, or a server by server= or "
                                "GNOMON_SERVER")
    return found


class LocalServer:
    """`gnomon serve` with further flags and environment variables; ends with `close()`, with a `with` block, and with
    this process, however that ends."""

    def __init__(self, *flags: str, binary: Union[str, Path, None] = None, variables: Optional[Dict[str, str]] = None):
        own = {name: value for name, value in os.environ.items() if not name.startswith("GNOMON_")}
        command: Sequence[str] = [find_binary(binary), "serve", "--until-stdin-closes", "--bind", "127.0.0.1", "--port", "0",
                                  *flags]
        self._log = tempfile.TemporaryFile()
        self._owner = os.getpid()
        standard_input, self._held = _opened()
        try:
            self._process = subprocess.Popen(command, stdin=standard_input, stdout=subprocess.PIPE, stderr=self._log,
                                             text=True, env={**own, **(variables or {})}, start_new_session=True)
        finally:
            os.close(standard_input)
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line.startswith("listening on "):
            self._process.wait()
            log = self.log()
            self.close()
            raise RuntimeError(f"the server did not start: {line.strip()}\n{log}")
        self.url = line[len("listening on "):].strip()

    @property
    def pid(self) -> int:
        return self._process.pid

    def log(self) -> str:
        """What the server has written so far."""
        size = os.fstat(self._log.fileno()).st_size
        return os.pread(self._log.fileno(), size, 0).decode("utf-8", "replace")

    def close(self) -> None:
        """Ends the server; requests in progress have the time that `--grace` gives them. A process that was forked from
        this one leaves it running."""
        if self._owner != os.getpid():
            return
        if self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(30)
            except subprocess.TimeoutExpired:
                self._process.kill()
        self._process.wait()
        self._held.close()
        if self._process.stdout is not None:
            self._process.stdout.close()
        self._log.close()

    def __enter__(self) -> "LocalServer":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()
