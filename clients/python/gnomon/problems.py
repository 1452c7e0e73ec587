"""What a server refuses, as exceptions that say where and why."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Type


@dataclass(frozen=True)
class Item:
    """One thing that is wrong: `pointer` says where, `limit` what would have been accepted, `actual` what came."""

    code: str
    pointer: str
    detail: str
    limit: str
    actual: str

    def __str__(self) -> str:
        text = f"{self.pointer}: {self.detail}" if self.pointer else self.detail
        if self.limit:
            text += f" Accepted: {self.limit}."
        if self.actual:
            text += f" Given: {self.actual}."
        return text


class Problem(Exception):
    """A server refused a request. `problems` has everything that is wrong with it."""

    def __init__(self, status: int, title: str, problems: List[Item], request_id: str = "",
                 retry_after: Optional[float] = None):
        super().__init__(status, title, problems, request_id, retry_after)
        self.status = status
        self.title = title
        self.problems = problems
        self.request_id = request_id
        self.retry_after = retry_after

    def __str__(self) -> str:
        return "\n".join([f"{self.title} (HTTP {self.status})", *(f"  {each}" for each in self.problems)])


class BadRequest(Problem):
    """400, 422 and the like: the request or the scene breaks a rule."""


class Refused(Problem):
    """401 and 403: no known key came with the request, or it does not allow this."""


class NotFound(Problem):
    """404: there is no such scene, bake, job or frame of a job."""


class TooLarge(Problem):
    """413: a limit was passed, which the problem names."""


class Busy(Problem):
    """429 and 503: still busy when the session's patience was over."""


class TimedOut(Problem):
    """504: the server's time for a request was over."""


class ServerFault(Problem):
    """500 and 507: a fault of the server, or a full disk."""


class JobFailed(Exception):
    """A frame of a job could not be drawn; `problems` says which and why."""

    def __init__(self, problems: List[Item]):
        super().__init__(problems)
        self.problems = problems

    def __str__(self) -> str:
        return "\n".join(["the job failed", *(f"  {each}" for each in self.problems)])


class JobCancelled(Exception):
    """The job was removed."""


class ConnectionFailed(ConnectionError):
    """No server answered within the session's patience."""


class DigestMismatch(Exception):
    """A reply's bytes are not those that its Repr-Digest names."""


KINDS: Dict[int, Type[Problem]] = {401: Refused, 403: Refused, 404: NotFound, 413: TooLarge, 429: Busy, 503: Busy,
                                   504: TimedOut, 500: ServerFault, 507: ServerFault}


def problem_from(status: int, body: bytes, retry_after: Optional[float] = None) -> Problem:
    """The exception of a reply of that status: its problem+json, or else the start of its text."""
    try:
        found: Any = json.loads(body)
    except ValueError:
        found = None
    items: List[Item] = []
    title, request_id = "", ""
    if isinstance(found, dict):
        title, request_id = str(found.get("title", "")), str(found.get("instance", ""))
        entries = found.get("problems")
        for each in entries if isinstance(entries, list) else []:
            if isinstance(each, dict):
                items.append(Item(*(str(each.get(key, "")) for key in ("code", "pointer", "detail", "limit", "actual"))))
        if not items and found.get("detail"):
            items.append(Item("", "", str(found["detail"]), "", ""))
        if status == 0 and isinstance(found.get("status"), int):
            status = found["status"]
    elif body:
        items.append(Item("", "", body[:200].decode("utf-8", "replace"), "", ""))
    return KINDS.get(status, BadRequest)(status, title or "Refused", items, request_id, retry_after)
