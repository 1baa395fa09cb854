"""Reads what a verification left behind (results.json) and the measured times into rows of the history."""

from __future__ import annotations

import math
from pathlib import Path

from granvof_files import json_of
from night.history import Cost, Metric


def _number(value: object, where: str) -> float | None:
    if value is None:
        return None
    number = float(value)  # type: ignore[arg-type]
    if not math.isfinite(number):
        raise ValueError(f"{where}: not a finite number")
    return number


def read_verification(path: Path) -> tuple[list[Metric], list[Cost], list[str]]:
    """Metrics and core-seconds of a results.json, and the runs it could not use; all empty where there is none (the stage
    did not get so far). ValueError, one line, where it is damaged."""
    if not path.exists():
        return [], [], []
    try:
        return _verification(json_of(path))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise _damaged(path, error) from error


def _damaged(path: Path, error: Exception) -> ValueError:
    return ValueError(f"{path} cannot be read: " + " ".join(f"{type(error).__name__}: {error}".split()))


def _verification(data: dict) -> tuple[list[Metric], list[Cost], list[str]]:
    if not data["results"]:
        raise ValueError("there is no row in it")
    metrics = [
        Metric(r["id"], r["scene"], r["metric"], r["unit"], _number(r["value"], r["id"]),
               _number(r["reference"], r["id"]), r["verdict"], bool(r["unexpected"]))
        for r in data["results"]
    ]
    costs = [
        Cost(f"{run['id']} core-seconds", "s", float(run["numbers"]["core_seconds"]))
        for run in data["runs"]
        if run.get("numbers", {}).get("core_seconds") is not None
    ]
    unusable = [f"{run['id']}: {run['state']}, {run.get('reason') or 'no reason given'}"
                for run in data["runs"] if run.get("state", "usable") != "usable"]
    return metrics, costs, unusable


def read_times(path: Path) -> list[Cost]:
    """Costs of a times.json: {"name": {"value": seconds, "unit": "s"}, ...}; empty where there is none. ValueError, one
    line, where it is damaged."""
    if not path.exists():
        return []
    try:
        data = json_of(path)
        return [Cost(name, entry["unit"], float(entry["value"])) for name, entry in data.items()]
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise _damaged(path, error) from error
