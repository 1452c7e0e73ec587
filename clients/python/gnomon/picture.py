"""Any view as a picture for people."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Picture = npt.NDArray[np.uint8]


def picture_of(view: str, values: npt.NDArray[Any]) -> Picture:
    """uint8: colors as they are, indices as colors, numbers in grey from their least (black) to their greatest;
    shares and directions at their own scale."""
    if values.dtype == np.uint8:
        return values
    if values.dtype == np.int32:
        return _colors_of_indices(values)
    if view == "normal":
        return _bytes(0.5 + 0.5 * values)
    if view in ("shadow", "reference", "blendWeight"):
        return _bytes(values)
    if view in ("color", "albedo", "cascades", "texelGrid", "lightContribution", "error") and values.ndim == 3:
        return _srgb(values)
    finite = np.isfinite(values)
    low, high = (float(values[finite].min()), float(values[finite].max())) if finite.any() else (0.0, 1.0)
    grey = _bytes(np.where(finite, (np.where(finite, values, low) - low) / ((high - low) or 1.0), 1.0))
    return grey if grey.ndim == 2 or grey.shape[2] != 2 else np.dstack([grey, np.zeros_like(grey[:, :, :1])])


def _bytes(share: Any) -> Picture:
    picture: Picture = np.rint(np.clip(np.nan_to_num(share), 0, 1) * 255).astype(np.uint8)
    return picture


def _srgb(linear: npt.NDArray[Any]) -> Picture:
    """Clipped at 1, without tone mapping; of an alpha that was multiplied in, undone."""
    color, alpha = np.clip(linear[:, :, :3], 0, 1), linear[:, :, 3:]
    if alpha.size:
        color = np.clip(color / np.where(alpha > 0, alpha, 1), 0, 1)
    curve = np.where(color <= 0.0031308, 12.92 * color, 1.055 * color ** (1 / 2.4) - 0.055)
    return _bytes(np.concatenate([curve, alpha], axis=2))


def _colors_of_indices(indices: npt.NDArray[Any]) -> Picture:
    """Neighbouring indices get colors that differ; -1 is black."""
    mixed = (indices.astype(np.int64) + 1) * 2654435761 & 0xFFFFFFFF
    colors = np.stack([64 + (mixed >> shift) % 192 for shift in (8, 16, 24)], axis=2)
    return np.where(indices[:, :, None] < 0, 0, colors).astype(np.uint8)
