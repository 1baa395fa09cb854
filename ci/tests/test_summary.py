"""What a night reports, and its exit code."""

from dataclasses import replace

import pytest

from night import blessings, summary
from night.blessings import Blessing
from night.history import Cost, History, Metric, Run, StageRow


def night(day, value=2.16, cost=3.0, verdict="agrees", unexpected=False, stage="passed", ids=("run-out",), frequency="nightly"):
    metrics = tuple(Metric(i, "s1", i, "-", value, 2.0, verdict, unexpected) for i in ids)
    return Run(f"night-{day:02}", f"2025-01-{day:02}T01:00:00.000000Z", f"{day:040x}", "machine", frequency,
               (StageRow(1, "build", "passed", 1.0), StageRow(2, "verify", stage, 9.0)), metrics, (Cost("s1", "s", cost),))


@pytest.fixture
def history(tmp_path):
    history = History(tmp_path / "history.sqlite")
    yield history
    history.close()


def judge(history, run, blessed=()):
    found = summary.find(run, history, blessed)
    history.record(run)
    return found


def test_same_commit_twice_is_no_change(history):
    judge(history, night(1))
    found = judge(history, night(2))
    assert found.exit_code() == 0
    text = summary.text(night(2), found)
    assert text.splitlines()[0].endswith(": no change")
    assert "1 checks (1 agrees), 0 without a past; 1 costs" in text


def test_first_night_is_green_but_says_that_it_has_no_past(history):
    found = judge(history, night(1))
    assert found.exit_code() == 0
    text = summary.text(night(1), found)
    assert "1 without a past" in text and text.splitlines()[0].endswith(": nothing wrong, and no past to compare with")


def test_changed_metric_is_red_until_blessed(history):
    for day in (1, 2, 3):
        judge(history, night(day))
    run = night(4, value=2.5)
    found = judge(history, run)
    assert found.exit_code() == 1
    assert "run-out: 2.16 -> 2.5 - (up, limit" in summary.text(run, found)
    assert judge(history, night(5, value=2.5)).exit_code() == 1
    blessing = Blessing(night(5).date, night(5).commit, "run-out", "2.16", "2.5", "someone", "a better scheme for it")
    assert judge(history, night(6, value=2.5), [blessing]).exit_code() == 0
    assert judge(history, night(7, value=2.16), [blessing]).exit_code() == 1  # the old value is no longer normal


@pytest.mark.parametrize("before, now, code", [(2.1e-9, 6.1e-9, 0), (2.1e-9, 4e-6, 1), (0.2353, 0.2360, 1)])
def test_what_is_held_against_zero_has_rounding(history, before, now, code):
    def against_zero(run):
        return replace(run, metrics=tuple(replace(metric, reference=0.0) for metric in run.metrics))

    judge(history, against_zero(night(1, value=before)))
    assert judge(history, against_zero(night(2, value=now))).exit_code() == code


def test_a_row_that_judges_a_cost_is_no_metric(history):
    def cost_row(run):
        return replace(run, metrics=tuple(replace(metric, unit="core-s") for metric in run.metrics))

    judge(history, cost_row(night(1, value=2.64)))
    found = judge(history, cost_row(night(2, value=2.73)))
    assert found.exit_code() == 0 and not found.changed_metrics()


def test_a_run_without_a_result_is_red_and_named(history):
    judge(history, night(1))
    run = replace(night(2), unusable=("sw-2d: failed, the run did not finish: failed, step collapse",), without=("tests",))
    found = judge(history, run)
    assert found.exit_code() == 1
    text = summary.text(run, found)
    assert "1 runs without a result" in text.splitlines()[0] and "  sw-2d: failed, the run did not finish" in text
    assert "stages left out\n  tests\n" in text


def test_unexpected_verdict_is_red(history):
    judge(history, night(1, verdict="differs", unexpected=True))
    found = judge(history, night(2, verdict="differs", unexpected=True))
    assert found.exit_code() == 1
    assert "1 unexpected verdicts" in summary.headline(found)


@pytest.mark.parametrize("status", ["failed", "timed out", "blocked"])
def test_broken_stage_is_red(history, status):
    found = judge(history, night(1, stage=status))
    assert found.exit_code() == 1
    assert f"verify: {status}" in summary.headline(found)


def test_missing_part_is_named_but_not_red(history):
    run = night(1, stage="not available")
    found = judge(history, run)
    assert found.exit_code() == 0
    assert "not available in this version\n  verify" in summary.text(run, found)


def test_slower_is_red_on_the_second_night_and_faster_is_not(history):
    for day in range(1, 7):
        judge(history, night(day, cost=3.0))
    assert judge(history, night(7, cost=6.0)).exit_code() == 0
    found = judge(history, night(8, cost=6.0))
    assert found.exit_code() == 1 and found.slower() == ["s1"]


def test_faster_is_not_red(history):
    for day in range(1, 7):
        judge(history, night(day, cost=3.0))
    judge(history, night(7, cost=1.0))
    run = night(8, cost=1.0)
    found = judge(history, run)
    assert found.exit_code() == 0
    assert "faster" in summary.text(run, found)


def test_check_that_is_gone_is_red_and_a_new_one_is_not(history):
    judge(history, night(1, ids=("a", "b")))
    assert judge(history, night(2, ids=("a", "b", "c"))).appeared == ["c"]
    found = judge(history, night(3, ids=("a", "c")))
    assert found.vanished == ["b"] and found.exit_code() == 1


def test_weekly_checks_are_not_missed_in_between(history):
    judge(history, night(1, ids=("a",)))
    judge(history, night(2, ids=("a", "weekly-only"), frequency="weekly"))
    assert judge(history, night(3, ids=("a",))).vanished == []


def test_blessing_demands_a_reason(tmp_path):
    path = tmp_path / "blessings.csv"
    for reason in ("", "ok", "  better  now "):
        with pytest.raises(ValueError, match="reason"):
            blessings.append(path, Blessing("d", "c", "run-out", "1", "2", "me", reason))
    assert not path.exists()
    good = Blessing("2025", "c", "run-out", "1", "2", "me", 'limited flux, "nearer" to the finest grid, see chart')
    blessings.append(path, good)
    blessings.append(path, good)
    assert blessings.read(path) == [good, good]
