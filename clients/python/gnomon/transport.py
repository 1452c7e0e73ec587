"""HTTP to one server: kept connections, patience while it is busy, and requests that can be cancelled."""

from __future__ import annotations

import base64
import contextlib
import contextvars
import hashlib
import http.client
import os
import socket
import ssl
import threading
import time
import urllib.parse
from dataclasses import dataclass
from email.message import Message
from typing import Any, Dict, Iterator, List, Optional

from .problems import ConnectionFailed, DigestMismatch, problem_from

LOST = (http.client.RemoteDisconnected, http.client.BadStatusLine, ConnectionResetError, BrokenPipeError,
        ConnectionAbortedError)


class Cancelled(Exception):
    """The request was given up."""


class Cancel:
    """Gives up what a thread is waiting for: closes its connection, which stops the work on the server."""

    def __init__(self) -> None:
        self._event = threading.Event()
        self._lock = threading.Lock()
        self._socket: Optional[socket.socket] = None

    def watch(self, connection: Optional[socket.socket]) -> None:
        with self._lock:
            self._socket = connection
        self.check()

    def set(self) -> None:
        self._event.set()
        with self._lock:
            if self._socket is not None:
                with contextlib.suppress(OSError):
                    self._socket.shutdown(socket.SHUT_RDWR)

    def check(self) -> None:
        if self._event.is_set():
            raise Cancelled

    def wait(self, seconds: float) -> None:
        self._event.wait(seconds)
        self.check()


CANCEL: contextvars.ContextVar[Optional[Cancel]] = contextvars.ContextVar("gnomon_cancel", default=None)


@dataclass
class Reply:
    status: int
    headers: Message  # names in any case
    body: bytes


class Transport:
    def __init__(self, url: str, key: Optional[str] = None, timeout: float = 630, patience: float = 60):
        parts = urllib.parse.urlsplit(url if "//" in url else "http://" + url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise ValueError(f"a server's address is http://HOST:PORT or https://HOST, not {url!r}")
        self.url = f"{parts.scheme}://{parts.netloc}{parts.path.rstrip('/')}"
        self._parts = parts
        self._prefix = parts.path.rstrip("/")
        self._key = key
        self._timeout = timeout
        self._patience = patience
        self._idle: List[http.client.HTTPConnection] = []
        self._lock = threading.Lock()
        self._process = os.getpid()
        self._tls = ssl.create_default_context() if parts.scheme == "https" else None

    def close(self) -> None:
        with self._lock:
            idle, self._idle = self._idle, []
        for connection in idle:
            connection.close()

    def request(self, method: str, path: str, body: Optional[bytes] = None, **headers: str) -> Reply:
        """The whole reply, whose digest was checked; a `Problem` unless its status is 200 to 399."""
        with self.stream(method, path, body, **headers) as response:
            return whole_reply(response)

    @staticmethod
    def check_cancelled() -> None:
        cancel = CANCEL.get()
        if cancel is not None:
            cancel.check()

    @contextlib.contextmanager
    def stream(self, method: str, path: str, body: Optional[bytes] = None,
               **headers: str) -> Iterator[http.client.HTTPResponse]:
        """A reply that is read as it comes. Leaving the block early closes the connection and stops the work."""
        sent = {name.replace("_", "-"): value for name, value in headers.items()}
        if self._key:
            sent["Authorization"] = f"Bearer {self._key}"
        cancel = CANCEL.get()
        deadline = time.monotonic() + self._patience
        while True:
            connection, response = self._answer(method, path, body, sent, deadline, cancel)
            try:
                if response.status < 400:
                    yield response
                    return
                problem = problem_from(response.status, response.read(), _seconds(response.headers.get("Retry-After")))
            except (OSError, http.client.HTTPException):
                if cancel is not None:
                    cancel.check()
                raise
            finally:
                self._give_back(connection, response, cancel)
            if problem.status not in (429, 503) or not self._wait(problem.retry_after or 1.0, deadline, cancel):
                raise problem

    def _answer(self, method: str, path: str, body: Optional[bytes], headers: Dict[str, str], deadline: float,
                cancel: Optional[Cancel]) -> Any:
        """A connection and its reply's head. A kept connection may have been closed meanwhile, and a server that
        restarts refuses new ones: both are tried again."""
        delay = 0.1
        while True:
            kept = self._kept()
            connection = kept or self._connect()
            try:
                if connection.sock is None:
                    connection.connect()
                if cancel is not None:
                    cancel.watch(connection.sock)
                return connection, self._exchange(connection, method, path, body, headers)
            except (*LOST, ConnectionRefusedError) as error:
                connection.close()
                if cancel is not None:
                    cancel.check()
                if kept is None and not self._wait(delay, deadline, cancel):
                    raise ConnectionFailed(f"no answer from {self.url}: {error}") from error
                if kept is None:
                    delay = min(2 * delay, 2.0)
            except BaseException:
                connection.close()
                raise

    def _kept(self) -> Optional[http.client.HTTPConnection]:
        """A connection without a request. Those of the process that this one was forked from stay open there."""
        with self._lock:
            if self._process != os.getpid():
                while self._idle:
                    self._idle.pop().close()
                self._process = os.getpid()
            return self._idle.pop() if self._idle else None

    def _exchange(self, connection: http.client.HTTPConnection, method: str, path: str, body: Optional[bytes],
                  headers: Dict[str, str]) -> http.client.HTTPResponse:
        try:
            connection.request(method, self._prefix + path, body, headers)
        except (BrokenPipeError, ConnectionResetError):
            if connection.sock is None:
                raise
            # A server may refuse a body before it has all of it, and its answer says why.
        return connection.getresponse()

    def _connect(self) -> http.client.HTTPConnection:
        host, port = str(self._parts.hostname), self._parts.port
        if self._tls is not None:
            return http.client.HTTPSConnection(host, port, timeout=self._timeout, context=self._tls)
        return http.client.HTTPConnection(host, port, timeout=self._timeout)

    def _give_back(self, connection: http.client.HTTPConnection, response: http.client.HTTPResponse,
                   cancel: Optional[Cancel]) -> None:
        if cancel is not None:
            with contextlib.suppress(Cancelled):
                cancel.watch(None)
        if response.isclosed() and not response.will_close:
            with self._lock:
                self._idle.append(connection)
        else:
            response.close()
            connection.close()

    @staticmethod
    def _wait(seconds: float, deadline: float, cancel: Optional[Cancel]) -> bool:
        """Waits, unless that would take longer than there is patience."""
        if time.monotonic() + seconds > deadline:
            return False
        if cancel is not None:
            cancel.wait(seconds)
        else:
            time.sleep(seconds)
        return True


def whole_reply(response: http.client.HTTPResponse) -> Reply:
    content = response.read()
    check_digest(response.headers.get("Repr-Digest"), content)
    return Reply(response.status, response.headers, content)


def _seconds(text: Optional[str]) -> Optional[float]:
    return float(text) if text is not None and text.isdigit() else None


def check_digest(header: Optional[str], content: bytes) -> None:
    """RFC 9530: DigestMismatch where the header names another SHA-256 than the content's."""
    for each in (header or "").split(","):
        name, _, value = each.strip().partition("=")
        if name == "sha-256" and value.strip(":") != base64.b64encode(hashlib.sha256(content).digest()).decode():
            raise DigestMismatch(f"the reply's bytes do not match its Repr-Digest {value}")
