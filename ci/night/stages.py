"""Runs numbered stages, each with its own log, time, time limit and status; an interrupted run can be resumed."""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Callable, Sequence

from granvof_files import json_of, write_json
from night.together import ends_with_parent

GUARD = str(Path(__file__).resolve().parent / "guard.py")
PASSED, FAILED, TIMED_OUT, BLOCKED, NOT_AVAILABLE = "passed", "failed", "timed out", "blocked", "not available"
FLOOR = 30 * 60.0  # seconds that a stage gets of a short total, as far as its own limit and the total go
GRACE = 15.0  # longer than the guard's own; seconds between the polite and the hard end of a stage that takes too long


@dataclass(frozen=True)
class Stage:
    """`commands` run one after the other in `directory` until one fails. `action`, if any, runs after them in this
    process and returns whether all is well. Where `part` (a file below `directory`) is missing, the stage is not
    available. A stage is blocked unless all stages in `needs` passed."""

    name: str
    directory: Path
    time_limit: float  # seconds
    commands: Sequence[Sequence[str]] = ()
    action: Callable[[], bool] | None = None
    needs: Sequence[str] = ()
    part: str = ""


@dataclass
class Outcome:
    status: str
    seconds: float


@dataclass
class StageRun:
    """State of one nightly run; lives in `directory`/state.json and is written after every stage."""

    directory: Path
    facts: dict[str, str] = field(default_factory=dict)
    outcomes: dict[str, Outcome] = field(default_factory=dict)
    finished: bool = False

    @classmethod
    def load(cls, directory: Path) -> "StageRun":
        """ValueError, one line, where its state is damaged."""
        path = directory / "state.json"
        try:
            data = json_of(path)
            outcomes = {name: Outcome(**outcome) for name, outcome in data["outcomes"].items()}
            return cls(directory, data["facts"], outcomes, data["finished"])
        except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise ValueError(f"{path} cannot be read ({' '.join(str(error).split())}); --fresh starts anew") from error

    def save(self) -> None:
        data = {"facts": self.facts, "finished": self.finished,
                "outcomes": {name: vars(outcome) for name, outcome in self.outcomes.items()}}
        write_json(self.directory / "state.json", data)


def _end_group(process: subprocess.Popen) -> None:
    """Ends a command and everything it started: politely, then for good."""
    try:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait(timeout=GRACE)
    except (ProcessLookupError, subprocess.TimeoutExpired):
        pass
    try:
        os.killpg(process.pid, signal.SIGKILL)  # children may outlive the one that was asked
    except ProcessLookupError:
        pass
    process.wait()


def _run_commands(stage: Stage, log_path: Path) -> str:
    deadline = time.monotonic() + stage.time_limit
    with log_path.open("w", encoding="utf-8", errors="replace") as log:
        for command in stage.commands:
            log.write(f"$ {' '.join(command)}\n")
            log.flush()
            try:
                process = subprocess.Popen([sys.executable, GUARD, *command], cwd=stage.directory, stdin=subprocess.DEVNULL,
                                           stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
                                           preexec_fn=ends_with_parent)
            except OSError as error:
                log.write(f"{error}\n")
                return FAILED
            try:
                code = process.wait(timeout=max(0.0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                _end_group(process)
                log.write(f"\nended after its time limit of {stage.time_limit:g} s\n")
                return TIMED_OUT
            except BaseException:  # interrupted: leave nothing behind
                _end_group(process)
                raise
            if code != 0:
                log.write(f"\nexit code {code}\n")
                return FAILED
    return PASSED


def run_stage(stage: Stage, number: int, run: StageRun) -> Outcome:
    started = time.monotonic()
    blockers = [name for name in stage.needs if run.outcomes[name].status != PASSED]
    if blockers:
        status = BLOCKED
    elif stage.part and not (stage.directory / stage.part).exists():
        status = NOT_AVAILABLE
    else:
        status = _run_commands(stage, run.directory / f"{number}-{stage.name}.log")
    if stage.action and not blockers and not stage.action() and status == PASSED:
        status = FAILED
    return Outcome(status, round(time.monotonic() - started, 2))


def fitted(stages: Sequence[Stage], left: float) -> Stage:
    """The first of the stages, with what it may take where all of them have `left` seconds: its limit if there is room for
    the limits of all, else its share of them, but no less than FLOOR where its limit and what is left are that much."""
    own = stages[0].time_limit
    share = left * own / sum(stage.time_limit for stage in stages)
    return replace(stages[0], time_limit=max(0.0, min(own, max(FLOOR, share), left)))


def run_stages(stages: Sequence[Stage], run: StageRun, say: Callable[[str], None], total: float = math.inf) -> None:
    """Runs what has no outcome yet; saves the state after each stage. In `total` seconds all must be done; the last stage, the
    report, has its own limit of them kept free."""
    deadline = time.monotonic() + total - (stages[-1].time_limit if len(stages) > 1 else 0.0)
    for number, stage in enumerate(stages, 1):
        if number < len(stages) and total < math.inf:
            due = [one for one in stages[number - 1:-1] if one.name not in run.outcomes]
            stage = fitted(due, deadline - time.monotonic()) if due and due[0] is stage else stage
        head = f"{number}/{len(stages)} {stage.name:<12}"
        if stage.name in run.outcomes:
            say(f"{head} {run.outcomes[stage.name].status} (before)")
            continue
        say(f"{head} ...")
        outcome = run_stage(stage, number, run)
        run.outcomes[stage.name] = outcome
        run.save()
        say(f"{head} {outcome.status}, {outcome.seconds:.0f} s")
