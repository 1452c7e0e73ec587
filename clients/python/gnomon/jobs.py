"""A sequence that the server draws in the background."""

from __future__ import annotations

import json
import time
from typing import TYPE_CHECKING, Callable, Iterator, Optional, Tuple, cast

from .frame import Frame
from .problems import Item, JobCancelled, JobFailed, NotFound
from .progress import Progress
from .reports import Job as JobReport

if TYPE_CHECKING:
    from .transport import Transport

LONGEST_WAIT = 20  # seconds of one request


class Job:
    """Outlives the session that made it: `session.job(id)` finds it again."""

    def __init__(self, http: "Transport", report: JobReport, frame_of: Callable[[bytes, int], Frame],
                 shows_progress: bool = False):
        self._http = http
        self._frame_of = frame_of
        self._shows_progress = shows_progress
        self.id = report["id"]
        self.report = report  # as it was last seen

    def refresh(self, wait: int = 0) -> JobReport:
        """What the server says of it now, or once it has ended, at most `wait` seconds later."""
        reply = self._http.request("GET", self.report["address"], Prefer=f"wait={wait}")
        self.report = cast(JobReport, json.loads(reply.body))
        return self.report

    @property
    def progress(self) -> Tuple[int, int]:
        """Frames that are drawn, and that are to be."""
        report = self.refresh()
        return report["done"], report["of"]

    def wait(self, timeout: Optional[float] = None) -> JobReport:
        """Returns when it is done. JobFailed where a frame could not be drawn, JobCancelled where it was removed,
        TimeoutError after so many seconds."""
        deadline = None if timeout is None else time.monotonic() + timeout
        bar = Progress("rendering", self._shows_progress)
        try:
            while True:
                left = LONGEST_WAIT if deadline is None else deadline - time.monotonic()
                if left <= 0:
                    raise TimeoutError(f"the job has {self.report['done']} of {self.report['of']} frames")
                try:
                    report = self.refresh(1 if self._shows_progress else max(1, min(LONGEST_WAIT, int(left))))
                except NotFound:
                    raise JobCancelled(f"the job {self.id} is not there any more") from None
                bar.at(report["done"], report["of"])
                if report["state"] == "done":
                    return report
                if report["state"] == "failed":
                    raise JobFailed([Item(*(str(each.get(name, "")) for name in ("code", "pointer", "detail", "limit", "actual")))
                                     for each in report["problems"]])
                if report["state"] == "cancelled":
                    raise JobCancelled(f"the job {self.id} was removed")
        finally:
            bar.close()

    def frame(self, index: int) -> Frame:
        """A frame that is drawn already; NotFound where it is not."""
        content = self._http.request("GET", self.report["frames"].replace("{index}", str(index))).body
        return self._frame_of(content, index)

    def frames(self) -> Iterator[Frame]:
        """All frames in order, each as soon as it is there."""
        for index in range(self.report["first"], self.report["first"] + self.report["of"]):
            while True:
                try:
                    found = self.frame(index)
                    break
                except NotFound:
                    if self.refresh()["state"] in ("failed", "cancelled"):
                        self.wait()
                    time.sleep(0.05)
            yield found

    def cancel(self) -> None:
        """Ends it and removes its pictures."""
        self._http.request("DELETE", self.report["address"])

    def __repr__(self) -> str:
        return f"<gnomon.Job {self.id} {self.report['state']} {self.report['done']}/{self.report['of']}>"
