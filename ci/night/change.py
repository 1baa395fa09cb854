"""Has a number changed against its own past? Robust to outliers and to a noisy machine.

A new value counts as changed if it leaves the median of the past by more than

    max(width * sigma, relative * |median|, absolute)

where sigma, the noise from night to night, is estimated from the median of |x[i] - x[i-1]|. A few bad nights move neither
median; nor does one step or a slow drift widen sigma, as it would the deviation from the median (MAD). Below LEAST_STEPS
differences sigma says nothing and the floors alone hold.
"""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass, replace
from typing import Sequence

# The median of |x - y| of two normal numbers is sigma * sqrt(2) / 1.4826.
STEP_TO_SIGMA = 1.4826 / math.sqrt(2.0)
LEAST_STEPS = 5


@dataclass(frozen=True)
class Rule:
    """When a deviation counts. `needed`: past values below which nothing is said; `confirm`: successive values,
    the new one included, that must all have left the median to the same side."""

    width: float
    relative: float
    absolute: float
    needed: int
    confirm: int
    window: int = 20


# A metric is computed by a deterministic code: one past value is enough, and a small change is a change.
METRIC = Rule(width=4.0, relative=1e-3, absolute=1e-12, needed=1, confirm=1)
# What is held against zero (an error of volume, a speed at rest) is rounding below this, in any of the units in use.
AGAINST_ZERO = replace(METRIC, absolute=1e-6)
# A cost is measured on a machine that others use: only a change that comes back the next night counts.
COST = Rule(width=4.0, relative=0.10, absolute=0.05, needed=4, confirm=2)


@dataclass(frozen=True)
class Change:
    """state: "no history", "no change", "suspect" (beyond the limit, not yet confirmed), "up" or "down"."""

    state: str
    value: float | None
    median: float | None = None
    limit: float | None = None

    @property
    def changed(self) -> bool:
        return self.state in ("up", "down", "vanished", "appeared")


def noise(past: Sequence[float]) -> float:
    """sigma of the noise from night to night; 0 where the past is too short to tell."""
    steps = [abs(b - a) for a, b in zip(past, past[1:])]
    return STEP_TO_SIGMA * statistics.median(steps) if len(steps) >= LEAST_STEPS else 0.0


def _limit(past: Sequence[float], rule: Rule) -> tuple[float, float]:
    median = statistics.median(past)
    return median, max(rule.width * noise(past), rule.relative * abs(median), rule.absolute)


def detect(past: Sequence[float | None], value: float | None, rule: Rule) -> Change:
    """Compares `value` with `past` (oldest first; None: that night gave no value)."""
    known = [x for x in past if x is not None]
    if value is not None and not math.isfinite(value):
        raise ValueError(f"not a finite number: {value}")
    if any(not math.isfinite(x) for x in known):
        raise ValueError("the history holds a number that is not finite")
    if value is None:
        return Change("vanished" if past and past[-1] is not None else "no history", None)
    if past and not known:
        return Change("appeared", value)
    if len(known) < rule.needed:
        return Change("no history", value)

    # The values that must confirm the new one are not part of the past it is compared with.
    recent = known[len(known) - (rule.confirm - 1):] if rule.confirm > 1 else []
    base = known[: len(known) - len(recent)][-rule.window:]
    if len(base) < max(1, rule.needed - len(recent)):
        return Change("no history", value)
    median, limit = _limit(base, rule)
    sides = [math.copysign(1.0, x - median) if abs(x - median) > limit else 0.0 for x in [*recent, value]]
    if sides[-1] == 0.0:
        return Change("no change", value, median, limit)
    if any(side != sides[-1] for side in sides):
        return Change("suspect", value, median, limit)
    return Change("up" if sides[-1] > 0 else "down", value, median, limit)
