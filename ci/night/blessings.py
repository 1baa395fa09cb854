"""Accepted changes: ci/blessings.csv, one row a blessing, each with the reason that was given for it.

After a blessing the past of that check before it no longer counts: the blessed value is the new normal.
"""

from __future__ import annotations

import csv
from dataclasses import astuple, dataclass, fields
from pathlib import Path

from granvof_files import opened

LEAST_WORDS = 4


@dataclass(frozen=True)
class Blessing:
    date: str    # ISO 8601, UTC
    commit: str  # at which the value was seen
    check: str   # id in the table of checks, or "cost:NAME"
    old: str     # median of the past, empty if there was none
    new: str     # the accepted value
    by: str
    reason: str


def read(path: Path) -> list[Blessing]:
    """All blessings; none where there is no file. ValueError, one line, where it is damaged."""
    if not path.exists():
        return []
    try:
        with opened(path, newline="", encoding="utf-8") as file:
            rows = csv.DictReader(file, strict=True)
            if list(rows.fieldnames or []) != [field.name for field in fields(Blessing)]:
                raise ValueError("its columns are not those of a list of blessings")
            read_rows = [Blessing(**row) for row in rows]
        if any(value is None for row in read_rows for value in astuple(row)):
            raise ValueError("a row is cut")
        return read_rows
    except (OSError, ValueError, TypeError, csv.Error) as error:
        raise ValueError(f"{path} cannot be read: {' '.join(str(error).split())}") from error


def check_reason(reason: str) -> str:
    """The reason, tidied; ValueError if it says nothing."""
    words = reason.split()
    if len(words) < LEAST_WORDS:
        raise ValueError(f"a blessing needs a written reason of at least {LEAST_WORDS} words: what changed, and why it is right")
    return " ".join(words)


def append(path: Path, blessing: Blessing) -> None:
    check_reason(blessing.reason)
    new = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow([field.name for field in fields(Blessing)])
        writer.writerow(astuple(blessing))


def last_date(blessings: list[Blessing], check: str) -> str:
    """Date of the last blessing of a check; empty (before every date) if there is none."""
    return max((b.date for b in blessings if b.check == check), default="")
