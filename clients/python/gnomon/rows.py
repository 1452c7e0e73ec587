"""Evaluations as tables."""

from __future__ import annotations

from typing import Any, Dict, List

from .reports import EvaluationReport


class Rows(List[Dict[str, Any]]):
    """A dict for each variant, without anything nested but `variant` and `problems`: `pandas.DataFrame(rows)`."""

    report: EvaluationReport


def flat_rows(report: EvaluationReport) -> Rows:
    """Errors under their own names, the time of a stage as `stages.NAME`."""
    rows = Rows()
    for row in report["rows"]:
        flat: Dict[str, Any] = {key: value for key, value in row.items() if key not in ("metrics", "stages")}
        flat.update(row.get("metrics", {}))
        flat.update({f"stages.{name}": value for name, value in row.get("stages", {}).items()})
        rows.append(flat)
    rows.report = report
    return rows
