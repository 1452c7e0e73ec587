"""Shadowed pictures of glTF scenes as NumPy arrays, by a Gnomon server."""

from . import camera, spec
from .async_session import AsyncSession
from .default_session import render
from .frame import Frame, read_frame
from .jobs import Job
from .local_server import LocalServer
from .orbit import orbit
from .problems import (BadRequest, Busy, ConnectionFailed, DigestMismatch, Item, JobCancelled, JobFailed, NotFound, Problem,
                       Refused, ServerFault, TimedOut, TooLarge)
from .rows import Rows
from .scene_calls import Scene
from .session import Session
from .warned import GnomonWarning

__all__ = ["AsyncSession", "BadRequest", "Busy", "ConnectionFailed", "DigestMismatch", "Frame", "GnomonWarning", "Item",
           "Job", "JobCancelled", "JobFailed", "LocalServer", "NotFound", "Problem", "Refused", "Rows", "Scene",
           "ServerFault", "Session", "TimedOut", "TooLarge", "camera", "orbit", "read_frame", "render", "spec"]
