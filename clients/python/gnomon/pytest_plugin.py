"""Fixtures for pytest: a session for all tests, and pictures compared with stored ones."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterator, Optional, Protocol, Tuple, Union

import pytest

from .frame import Frame
from .golden import Tolerance, check
from .picture import Picture
from .session import Session


class Golden(Protocol):
    def __call__(self, frame: Union[Frame, Picture], name: str,
                 tolerance: Union[Tolerance, Tuple[float, float], float] = Tolerance(), view: Optional[str] = None) -> None: ...


def pytest_addoption(parser: Any) -> None:
    group = parser.getgroup("gnomon", "pictures of glTF scenes")
    group.addoption("--gnomon-update", action="store_true", help="write the pictures that `golden` compares with")
    group.addoption("--gnomon-failures", default="gnomon-failures", metavar="FOLDER",
                    help="where pictures of what differs are written (gnomon-failures)")


@pytest.fixture(scope="session")
def gnomon_session() -> Iterator[Session]:
    """One session for all tests: GNOMON_SERVER, or a server of its own."""
    with Session() as session:
        yield session


@pytest.fixture
def golden(request: pytest.FixtureRequest) -> Golden:
    """`golden(frame, "name", tolerance=(max, mean), view=None)` compares with golden/name.png beside the test file."""

    def compare(frame: Union[Frame, Picture], name: str,
                tolerance: Union[Tolerance, Tuple[float, float], float] = Tolerance(), view: Optional[str] = None) -> None:
        accepted = Tolerance(*tolerance) if isinstance(tolerance, tuple) else Tolerance(tolerance, tolerance)
        folder = Path(str(request.path)).parent / "golden"
        failures = Path(str(request.config.rootpath)) / str(request.config.getoption("--gnomon-failures"))
        update = bool(request.config.getoption("--gnomon-update"))
        check(frame, folder / f"{name}.png", failures, accepted, view, update)

    return compare
