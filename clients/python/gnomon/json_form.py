"""Specs as the JSON that a server takes."""

from __future__ import annotations

import dataclasses
import json
from numbers import Real
from typing import Any, Dict, Iterable, Mapping, Optional, Tuple, Union, cast

import numpy as np

from .spec import FrameSpec

Spec = Union[FrameSpec, Mapping[str, Any]]


def to_json(value: Any) -> Any:
    """Dataclasses without their `None`, arrays as lists; a 4 x 4 `matrix` column by column, as glTF has it."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = ((field.name, getattr(value, field.name)) for field in dataclasses.fields(value))
        value = {name: each for name, each in fields if each is not None}
    if isinstance(value, Mapping):
        return {key: _member(key, each) for key, each in value.items()}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (list, tuple)):
        return [to_json(each) for each in value]
    return value


def _member(key: str, value: Any) -> Any:
    if key == "matrix" and value is not None and np.shape(value) == (4, 4):
        return np.asarray(value, dtype=float).T.ravel().tolist()
    return to_json(value)


def encoded(value: Any) -> bytes:
    """UTF-8; ValueError for numbers that JSON does not have."""
    return json.dumps(to_json(value), allow_nan=False, separators=(",", ":")).encode()


def _azimuth_and_elevation(sun: Any) -> Tuple[float, float]:
    pair = tuple(sun) if isinstance(sun, Iterable) and not isinstance(sun, str) else ()
    if len(pair) != 2 or not all(isinstance(each, Real) for each in pair):
        raise ValueError(f"sun is (azimuth, elevation) in degrees, as sun=(135, 40), not {sun!r}")
    return cast(Tuple[float, float], pair)


def frame_spec(spec: Optional[Spec] = None, sun: Optional[Tuple[float, float]] = None, **fields: Any) -> Dict[str, Any]:
    """The spec with `fields` set on top; `sun=(azimuth, elevation)` in degrees is short for one light."""
    if sun is not None:
        if "lights" in fields:
            raise TypeError("sun= is short for lights=[...] with one sun: give one of the two")
        azimuth, elevation = _azimuth_and_elevation(sun)
        fields["lights"] = [{"sun": {"azimuthDegrees": azimuth, "elevationDegrees": elevation}}]
    known = {field.name for field in dataclasses.fields(FrameSpec)}
    unknown = sorted(set(fields) - known)
    if unknown:
        raise TypeError(f"a FrameSpec has no {', '.join(unknown)}; it has {', '.join(sorted(known))}")
    base = {} if spec is None else to_json(spec)
    return {**base, **{name: to_json(each) for name, each in fields.items() if each is not None}}
