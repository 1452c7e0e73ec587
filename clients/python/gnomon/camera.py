"""Cameras as people have them."""

from __future__ import annotations

from typing import Any, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from .spec import Camera, CameraPose, Intrinsics, Matrix, Perspective, Vector

Axes = Literal["opengl", "opencv"]
Array = npt.NDArray[np.float64]


def look_at(eye: Vector, target: Vector = (0, 0, 0), up: Optional[Vector] = None,
            fovYDegrees: Optional[float] = None) -> Camera:
    """A camera at `eye` that looks at `target`."""
    lens = None if fovYDegrees is None else Perspective(fovYDegrees=fovYDegrees)
    return Camera(eye=np.asarray(eye, float), target=np.asarray(target, float),
                  up=None if up is None else np.asarray(up, float), perspective=lens)


def from_pose(worldFromCamera: Matrix, axes: Axes = "opencv",
              K: Union[Intrinsics, Matrix, None] = None) -> Camera:
    """A camera by a 4 x 4 matrix that takes its points into the world, and its 3 x 3 calibration or `intrinsics`."""
    matrix = np.asarray(worldFromCamera, float)
    if matrix.shape != (4, 4):
        raise ValueError(f"a pose is a 4 x 4 matrix, not one of shape {matrix.shape}")
    lens = K if K is None or isinstance(K, Intrinsics) else intrinsics(K)
    return Camera(pose=CameraPose(worldFromCamera=matrix, axes=axes), intrinsics=lens)


def intrinsics(K: Matrix, scale: float = 1.0, near: Optional[float] = None, far: Optional[float] = None) -> Intrinsics:
    """The lens of a calibration matrix, pixel centres at integers as in OpenCV. `scale` is the frame's size as a
    share of the calibrated pictures': 0.5 for a frame of half their width and height."""
    matrix = np.asarray(K, float)
    if matrix.shape != (3, 3):
        raise ValueError(f"a calibration is a 3 x 3 matrix, not one of shape {matrix.shape}")
    if matrix[0, 1] != 0 or matrix[1, 0] != 0 or matrix[2].tolist() != [0, 0, 1]:
        raise ValueError("a lens has no skew: K is [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]")
    cx, cy = (float((matrix[row, 2] + 0.5) * scale - 0.5) for row in (0, 1))
    return Intrinsics(fx=float(matrix[0, 0] * scale), fy=float(matrix[1, 1] * scale), cx=cx, cy=cy, near=near, far=far)


def pose(eye: Vector, target: Vector = (0, 0, 0), up: Vector = (0, 1, 0), axes: Axes = "opencv") -> Array:
    """The 4 x 4 matrix that takes points of a camera at `eye`, which looks at `target`, into the world."""
    back = _unit(np.asarray(eye, float) - np.asarray(target, float))
    right = _unit(np.cross(np.asarray(up, float), back))
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2] = right, np.cross(back, right), back
    matrix[:3, 3] = np.asarray(eye, float)
    if axes == "opencv":
        matrix[:, 1:3] *= -1
    return matrix


def _unit(vector: Any) -> Array:
    length = np.linalg.norm(vector)
    if length == 0:
        raise ValueError("eye and target must differ, and up must not be parallel to the direction of view")
    unit: Array = np.asarray(vector / length, float)
    return unit
