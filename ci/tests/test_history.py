"""The history keeps what it is given, replaces a run recorded twice, and keeps hosts apart."""

import sqlite3

import pytest

from night.history import Cost, History, Metric, Run, StageRow


def run(day, value=1.0, cost=3.0, host="machine", frequency="nightly", **facts):
    metric = Metric("s1-run-out", "s1", "run_out@10", "-", value, 2.0, "agrees", False)
    return Run(f"night-{day:02}", f"2025-01-{day:02}T01:00:00.000000Z", f"{day:040x}", host, frequency,
               (StageRow(1, "build", "passed", 5.0),), (metric,), (Cost("s1", "s", cost),), **facts)


@pytest.fixture
def history(tmp_path):
    history = History(tmp_path / "deep" / "history.sqlite")
    yield history
    history.close()


def test_points_come_back_in_order(history):
    for day in (3, 1, 2):
        history.record(run(day, value=float(day)))
    assert [p.value for p in history.metric_points("s1-run-out")] == [1.0, 2.0, 3.0]
    assert [p.value for p in history.metric_points("s1-run-out", before="2025-01-03T01:00:00.000000Z")] == [1.0, 2.0]
    assert history.metric_points("s1-run-out")[0].commit == f"{1:040x}"


def test_a_run_recorded_twice_counts_once(history):
    history.record(run(1, value=1.0))
    history.record(run(1, value=5.0))
    assert [p.value for p in history.metric_points("s1-run-out")] == [5.0]
    assert len(history.cost_points("s1", "machine")) == 1


def test_missing_value_is_kept_as_missing(history):
    history.record(run(1, value=None))
    assert history.metric_points("s1-run-out")[0].value is None


def test_costs_of_other_hosts_are_kept_apart(history):
    history.record(run(1, cost=3.0, host="slow"))
    history.record(run(2, cost=1.0, host="fast"))
    assert [p.value for p in history.cost_points("s1", "fast")] == [1.0]
    assert history.hosts("s1") == ["fast", "slow"]


def test_last_run_is_the_one_of_the_same_frequency(history):
    history.record(run(1, value=1.0, frequency="weekly"))
    history.record(run(2, value=2.0))
    (metric,) = history.metrics_of_last_run("2025-01-09", "weekly")
    assert metric.value == 1.0
    assert history.metrics_of_last_run("2025-01-01", "nightly") == []


def test_survives_reopening(tmp_path):
    path = tmp_path / "history.sqlite"
    first = History(path)
    first.record(run(1))
    first.close()
    second = History(path)
    assert len(second.metric_points("s1-run-out")) == 1
    second.close()


def test_a_run_that_breaks_half_way_leaves_nothing(history):
    double = run(1)
    with pytest.raises(sqlite3.IntegrityError):
        history.record(Run(double.name, double.date, double.commit, double.host, double.frequency, double.stages,
                           double.metrics * 2, double.costs))
    assert history.metric_points("s1-run-out") == []


def test_other_schema_is_refused(tmp_path):
    path = tmp_path / "history.sqlite"
    database = sqlite3.connect(path)
    database.execute("pragma user_version = 99")
    database.commit()
    database.close()
    with pytest.raises(ValueError, match="99"):
        History(path)
