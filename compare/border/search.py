"""Bisection for the border of an axis, from its nominal value towards each end."""

import math
from dataclasses import dataclass, field


@dataclass
class Border:
    """What was found towards one end: the last value that holds, the first that fails (None: the end itself holds)."""
    end: float
    holds: float | None
    fails: float | None = None
    kind: str = ""
    why: str = ""
    tried: list = field(default_factory=list)  # (value, kind, why)


def between(axis, a, b):
    """A value half-way; None where there is none left."""
    if axis.values is not None:
        i, j = sorted((axis.values.index(a), axis.values.index(b)))
        return axis.values[(i + j) // 2] if j - i > 1 else None
    return math.sqrt(a * b) if axis.scale == "log" else 0.5 * (a + b)


def find_border(axis, end, judge, bisections):
    """judge(value) -> Outcome. The nominal value is judged first: an axis without a point that holds has no border."""
    border = Border(end, None)

    def holds(value):
        outcome = judge(value)
        border.tried.append((value, outcome.kind, outcome.why))
        if outcome.holds:
            border.holds = value
        else:
            border.fails, border.kind, border.why = value, outcome.kind, outcome.why
        return outcome.holds

    if not holds(axis.nominal) or holds(end):
        return border
    for _ in range(bisections):
        value = between(axis, border.holds, border.fails)
        if value is None:
            break
        holds(value)
    return border
