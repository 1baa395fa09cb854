"""The history of the nightly run: one SQLite file with every metric, cost and verdict of every run."""

from __future__ import annotations

import sqlite3
from dataclasses import dataclass
from pathlib import Path

from granvof_files import is_there, required

SCHEMA_VERSION = 1
SCHEMA = """
create table run (
  id integer primary key,
  date text not null,            -- ISO 8601, UTC, of the start
  commit_hash text not null,
  host text not null,            -- costs are compared between runs of one host only
  frequency text not null,       -- nightly or weekly
  name text not null unique      -- of the run's directory
);
create table stage (
  run integer not null references run(id) on delete cascade,
  number integer not null, name text not null, status text not null, seconds real not null,
  primary key (run, number)
);
create table metric (
  run integer not null references run(id) on delete cascade,
  id text not null,              -- of the check, unique in the table of checks
  scene text not null, metric text not null, unit text not null,
  value real, reference real, verdict text not null, unexpected integer not null,
  primary key (run, id)
);
create table cost (
  run integer not null references run(id) on delete cascade,
  name text not null, unit text not null, value real not null,
  primary key (run, name)
);
"""


@dataclass(frozen=True)
class Metric:
    id: str
    scene: str
    metric: str
    unit: str
    value: float | None
    reference: float | None
    verdict: str
    unexpected: bool


@dataclass(frozen=True)
class Cost:
    name: str
    unit: str
    value: float


@dataclass(frozen=True)
class StageRow:
    number: int
    name: str
    status: str
    seconds: float


@dataclass(frozen=True)
class Run:
    name: str
    date: str
    commit: str
    host: str
    frequency: str
    stages: tuple[StageRow, ...] = ()
    metrics: tuple[Metric, ...] = ()
    costs: tuple[Cost, ...] = ()
    unusable: tuple[str, ...] = ()  # runs that could not be compared, and why; for the summary alone
    without: tuple[str, ...] = ()   # stages that were left out; likewise


@dataclass(frozen=True)
class Point:
    """One night of one number."""

    date: str
    commit: str
    value: float | None
    verdict: str = ""
    run: str = ""  # its directory's name


class History:
    """Opens or creates the file. Raises ValueError if it is damaged or was written by another version of the schema."""

    def __init__(self, path: Path):
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            self._open(path)
        except (sqlite3.Error, OSError) as error:
            raise ValueError(f"{path} is no history of the nightly run: {error}") from error

    def _open(self, path: Path) -> None:
        self._db = sqlite3.connect(required(path) if is_there(path) else path, timeout=60)
        self._db.execute("pragma foreign_keys = on")
        version = self._db.execute("pragma user_version").fetchone()[0]
        if version == 0:
            with self._db:
                self._db.executescript(SCHEMA)
                self._db.execute(f"pragma user_version = {SCHEMA_VERSION}")
        elif version != SCHEMA_VERSION:
            raise ValueError(f"{path}: schema {version}, this program reads {SCHEMA_VERSION}")

    def close(self) -> None:
        self._db.close()

    def record(self, run: Run) -> None:
        """Adds a run; one of the same name is replaced, so that a resumed report stage may record again."""
        with self._db:
            self._db.execute("delete from run where name = ?", (run.name,))
            number = self._db.execute(
                "insert into run (date, commit_hash, host, frequency, name) values (?, ?, ?, ?, ?)",
                (run.date, run.commit, run.host, run.frequency, run.name),
            ).lastrowid
            self._db.executemany(
                "insert into stage values (?, ?, ?, ?, ?)",
                [(number, s.number, s.name, s.status, s.seconds) for s in run.stages],
            )
            self._db.executemany(
                "insert into metric values (?, ?, ?, ?, ?, ?, ?, ?, ?)",
                [(number, m.id, m.scene, m.metric, m.unit, m.value, m.reference, m.verdict, int(m.unexpected))
                 for m in run.metrics],
            )
            self._db.executemany("insert into cost values (?, ?, ?, ?)",
                                 [(number, c.name, c.unit, c.value) for c in run.costs])

    def metric_points(self, check: str, before: str | None = None) -> list[Point]:
        """All nights of one check, oldest first; `before`: only runs that started before that date."""
        rows = self._db.execute(
            "select run.date, run.commit_hash, metric.value, metric.verdict, run.name from metric join run on run.id = metric.run"
            " where metric.id = ? and (? is null or run.date < ?) order by run.date, run.id",
            (check, before, before))
        return [Point(*row) for row in rows]

    def cost_points(self, name: str, host: str, before: str | None = None) -> list[Point]:
        rows = self._db.execute(
            "select run.date, run.commit_hash, cost.value, '', run.name from cost join run on run.id = cost.run"
            " where cost.name = ? and run.host = ? and (? is null or run.date < ?) order by run.date, run.id",
            (name, host, before, before))
        return [Point(*row) for row in rows]

    def metrics_of_last_run(self, before: str, frequency: str) -> list[Metric]:
        """The rows of the last run of that frequency before that date that has any."""
        row = self._db.execute(
            "select run.id from run where date < ? and frequency = ?"
            " and exists (select 1 from metric where metric.run = run.id) order by date desc, id desc limit 1",
            (before, frequency)).fetchone()
        if row is None:
            return []
        rows = self._db.execute(
            "select id, scene, metric, unit, value, reference, verdict, unexpected from metric where run = ? order by rowid",
            (row[0],))
        return [Metric(*r[:-1], bool(r[-1])) for r in rows]

    def metric_names(self) -> list[tuple[str, str, str, str]]:
        """(check id, scene, metric, unit) of every check that ever ran."""
        return list(self._db.execute("select id, scene, metric, unit from metric group by id order by scene, metric, id"))

    def cost_names(self, host: str) -> list[tuple[str, str]]:
        return list(self._db.execute(
            "select cost.name, unit from cost join run on run.id = cost.run where host = ? group by cost.name order by cost.name", (host,)))

    def hosts(self, cost: str) -> list[str]:
        return [row[0] for row in self._db.execute(
            "select distinct host from cost join run on run.id = cost.run where cost.name = ? order by host", (cost,))]

    def last_date(self, frequency: str) -> str | None:
        """Start of the last run of that frequency that got through its reference stage."""
        return self._db.execute(
            "select max(date) from run join stage on stage.run = run.id"
            " where frequency = ? and stage.name = 'reference' and stage.status in ('passed', 'not available')",
            (frequency,)).fetchone()[0]
