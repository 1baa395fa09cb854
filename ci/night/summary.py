"""What a night found: changes against the past, in a short text for mail or chat, and an exit code."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Sequence

from night import blessings, stages
from night.blessings import Blessing
from night.change import AGAINST_ZERO, COST, METRIC, Change, detect
from night.history import History, Metric, Run


COST_UNIT = "core-s"  # of the rows of the table that judge a cost


@dataclass
class Findings:
    broken_stages: list[str] = field(default_factory=list)   # "verify: failed"
    missing_stages: list[str] = field(default_factory=list)  # not available in this version
    unexpected: list[Metric] = field(default_factory=list)
    metrics: dict[str, Change] = field(default_factory=dict)  # check id -> change, all checks of the run
    costs: dict[str, Change] = field(default_factory=dict)
    appeared: list[str] = field(default_factory=list)  # checks that the last run of this frequency had not
    vanished: list[str] = field(default_factory=list)
    unusable: Sequence[str] = ()  # runs that could not be compared

    def changed_metrics(self) -> list[str]:
        return [name for name, change in self.metrics.items() if change.changed]

    def slower(self) -> list[str]:
        return [name for name, change in self.costs.items() if change.state == "up"]

    def exit_code(self) -> int:
        bad = (self.broken_stages or self.unexpected or self.changed_metrics() or self.slower() or self.vanished
               or self.unusable)
        return 1 if bad else 0


def find(run: Run, history: History, blessed: Sequence[Blessing]) -> Findings:
    """Compares a run with what the history holds from before its date."""
    found = Findings(unusable=run.unusable)
    for stage in run.stages:
        if stage.status == stages.NOT_AVAILABLE:
            found.missing_stages.append(stage.name)
        elif stage.status != stages.PASSED:
            found.broken_stages.append(f"{stage.name}: {stage.status}")
    found.unexpected = [metric for metric in run.metrics if metric.unexpected]

    def past(points, key):
        since = blessings.last_date(list(blessed), key)
        return [point.value for point in points if point.date >= since]

    for metric in run.metrics:
        if metric.unit == COST_UNIT:
            continue  # a cost, which varies from night to night; those of all runs are compared as costs below
        points = history.metric_points(metric.id, before=run.date)
        found.metrics[metric.id] = detect(past(points, metric.id), metric.value,
                                            AGAINST_ZERO if metric.reference == 0 else METRIC)
    for cost in run.costs:
        points = history.cost_points(cost.name, run.host, before=run.date)
        found.costs[cost.name] = detect(past(points, f"cost:{cost.name}"), cost.value, COST)

    before = {metric.id for metric in history.metrics_of_last_run(run.date, run.frequency)}
    now = {metric.id for metric in run.metrics}
    if before:
        found.appeared = sorted(now - before)
        found.vanished = sorted(before - now)
    return found


def _number(value: float | None) -> str:
    return "none" if value is None else f"{value:.6g}"


def _change_line(name: str, change: Change, unit: str) -> str:
    if change.median is None:
        return f"  {name}: {change.state}, now {_number(change.value)} {unit}"
    return f"  {name}: {_number(change.median)} -> {_number(change.value)} {unit} ({change.state}, limit {_number(change.limit)})"


def headline(found: Findings) -> str:
    parts = []
    if found.broken_stages:
        parts.append("stages not passed: " + ", ".join(found.broken_stages))
    for count, what in ((len(found.unexpected), "unexpected verdicts"), (len(found.changed_metrics()), "changed metrics"),
                        (len(found.unusable), "runs without a result"), (len(found.slower()), "slower"),
                        (len(found.vanished), "checks gone")):
        if count:
            parts.append(f"{count} {what}")
    if parts:
        return "; ".join(parts)
    if found.metrics and all(change.state == "no history" for change in found.metrics.values()):
        return "nothing wrong, and no past to compare with"
    return "no change"


def text(run: Run, found: Findings) -> str:
    """The summary: its first line says it all."""
    lines = [f"granvof nightly, commit {run.commit[:12]}, {run.date}: {headline(found)}", ""]
    lines += [f"stage {s.number} {s.name:<12} {s.status:<14} {s.seconds:8.0f} s" for s in run.stages]

    def section(title: str, rows: list[str]) -> None:
        if rows:
            lines.extend(["", title, *rows])

    units = {m.id: m.unit for m in run.metrics}
    cost_units = {c.name: c.unit for c in run.costs}
    section("unexpected verdicts", [
        f"  {m.scene} {m.metric}: {m.verdict}, {_number(m.value)} {m.unit} for {_number(m.reference)}" for m in found.unexpected])
    section("changed metrics (accept one with ci/bless)",
            [_change_line(name, found.metrics[name], units[name]) for name in found.changed_metrics()])
    for state, title in (("up", "slower"), ("down", "faster"), ("suspect", "cost to watch (one night only)")):
        section(title, [_change_line(name, change, cost_units[name])
                        for name, change in found.costs.items() if change.state == state])
    section("runs that could not be compared", [f"  {line}" for line in run.unusable])
    section("checks that are gone", [f"  {name}" for name in found.vanished])
    section("new checks", [f"  {name}" for name in found.appeared])
    section("stages left out", [f"  {name}" for name in run.without])
    section("not available in this version", [f"  {name}" for name in found.missing_stages])
    without = sum(1 for change in found.metrics.values() if change.state == "no history")
    counts: dict[str, int] = {}
    for metric in run.metrics:
        counts[metric.verdict] = counts.get(metric.verdict, 0) + 1
    lines += ["", f"{len(run.metrics)} checks ({', '.join(f'{n} {v}' for v, n in sorted(counts.items())) or 'none ran'}), "
              f"{without} without a past; {len(run.costs)} costs"]
    return "\n".join(lines) + "\n"
