"""How wide the expected failures of compare/checks.toml are, against what was measured (compare/kept/verify: the rows of
`make verify`; of those due at night or weekly nothing is kept)."""

import tomllib
from pathlib import Path

import pytest
from report import kept_results

ROOT = Path(__file__).resolve().parent.parent.parent
WIDEST = 1.5  # distance of an expected failure over what it is off beyond its tolerance

# Off by a step once a threshold is passed, on either side of it by chance; the row's reason says which threshold.
THRESHOLDS = {
    "column-sourced-thick.series_difference-column-sourced.theory",
}


def listed(given):
    return given if isinstance(given, list) else [given]


def stated(table, label):
    """(run, metric as a row names it) -> distance, of every expected failure of a table of checks."""
    distances = {}
    for check in table["check"]:
        for failure in listed(check.get("expected_failure", [])):
            instants = listed(failure.get("at", check.get("at")))
            each = failure["distance"] if isinstance(failure["distance"], list) else [failure["distance"]] * len(instants)
            for run in listed(failure.get("run", check["run"])):
                distances |= {(run, label(check, at)): distance for at, distance in zip(instants, each, strict=True)}
    return distances


def measured():
    kept = kept_results.read(ROOT / "compare/kept/verify/results.json")
    return [row for row in kept["rows"] if row["verdict"] == "expected failure"]


@pytest.fixture
def distances(label):
    return stated(tomllib.loads((ROOT / "compare/checks.toml").read_text()), label)


def test_a_distance_is_found_by_run_and_metric(label):
    at = {"run": ["a", "b"], "metric": "m", "at": [1, 2.5], "against": "c", "label": "l",
          "expected_failure": [{"run": "a", "distance": [3, 4]}, {"run": "b", "at": 2.5, "distance": 5}]}
    assert stated({"check": [at, {"run": "d", "metric": "n", "expected_failure": {"distance": 6}}, {"run": "e", "metric": "n"}]}, label) == {
        ("a", "m@1-c (l)"): 3, ("a", "m@2.5-c (l)"): 4, ("b", "m@2.5-c (l)"): 5, ("d", "n"): 6}


def test_every_measured_failure_has_its_distance(distances):
    rows = measured()
    assert len(rows) > 150
    assert not [row["id"] for row in rows if (row["scene"], row["metric"]) not in distances]


def test_a_distance_is_the_one_measured_with_little_room(distances):
    wide = {row["id"]: f"{distance:g} for {abs(row['distance']):.3g}" for row in measured()
            if (distance := distances.get((row["scene"], row["metric"]), 0)) > WIDEST * abs(row["distance"])}
    assert {name: said for name, said in wide.items() if name not in THRESHOLDS} == {}
    assert THRESHOLDS <= set(wide), "no longer a threshold"
