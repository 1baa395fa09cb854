"""What the page says first: one line a scene and quantity, causes, scenes."""

import pytest

from report import overview, results


@pytest.fixture
def loaded(verify_directory):
    return results.load(verify_directory)


def line_of(loaded, run, quantity):
    return next(line for line in overview.at_a_glance(loaded, ["run-out", "snapshots-s1"])
                if line["run"] == run and line["quantity"] == quantity)


def test_a_line_has_its_error_cost_and_verdict(loaded):
    line = line_of(loaded, "s1", "run_out")
    assert line["errors"] == {"DEM": "33 %", "published": None, "theory": None}  # 2.0 against 1.5
    assert line["cost_ratio"] == pytest.approx(220 / 2.2)  # the mean of two records
    assert line["verdict"] == "differs" and line["unexpected"] and (line["agree"], line["rows"]) == (0, 1)
    assert line["plot"] == "run-out"


def test_what_is_only_reported_has_a_verdict_of_its_own(loaded):
    assert line_of(loaded, "s1-other", "run_out")["verdict"] == "reported only"


def test_instants_of_a_quantity_are_one_line(loaded, make_row):
    loaded.rows = [make_row(metric=f"run_out@{at}", value=value, verdict=verdict, id=str(at))
                   for at, value, verdict in ((2, 1.65, "agrees"), (5, 3.0, "expected failure"))]
    line = line_of(loaded, "s1", "run_out")
    assert line["errors"]["DEM"] == "10 to 100 %" and line["verdict"] == "expected failure" and line["agree"] == 1


def test_an_error_to_nothing_is_in_its_unit(make_row):
    assert overview.error_of([make_row(value=0.003, reference=0.0, unit="m")]) == "0.003 m"
    assert overview.error_of([make_row(value=0.003, reference=0.0)]) == "0.003 h0"  # a run-out
    assert overview.error_of([make_row(value=0.003, reference=0.0, metric="flat_top")]) == "0.003"
    assert overview.error_of([make_row(value=167.04, reference=0.0, unit="Pa")]) == "170 Pa"
    assert overview.error_of([make_row(value=None)]) is None


def lines_of(loaded, rows):
    loaded.rows = rows
    return overview.at_a_glance(loaded, [])


def test_a_curve_replaces_its_instants(loaded, make_row):
    rows = [make_row(metric=f"run_out@{at}", value=3.0, verdict=verdict, id=str(at), unexpected=False)
            for at, verdict in ((2, "agrees"), (5, "expected failure"))]
    curve = make_row(metric="run_out_curve", value=0.36, reference=0.0, band=0.045, verdict="expected failure", id="c", unexpected=False)
    (line,) = lines_of(loaded, [*rows, curve])
    assert (line["quantity"], line["errors"]["DEM"], line["tolerance"]) == ("run_out", "0.36 h0", "0.05 h0, band 0.045 h0")
    assert (line["rows"], line["instants"]) == (1, "1 of 2 instants agree")
    (line,) = lines_of(loaded, [*rows, curve | {"value": None, "verdict": "not run"}])  # nothing to replace them by
    assert line["errors"]["DEM"] == "100 %" and line["rows"] == 3 and not line["instants"]


def test_what_is_unexpected_at_an_instant_is_seen_beside_its_curve(loaded, make_row):
    (line,) = lines_of(loaded, [make_row(unexpected=True), make_row(metric="run_out_curve", reference=0.0, verdict="agrees", id="c",
                                                                   unexpected=False)])
    assert line["unexpected"]


def test_first_stands_what_others_judge_and_a_user_decides_on(loaded, make_row):
    first = [make_row(), make_row(scene="s2", reference_kind="published")]
    rest = [make_row(metric="solid_volume"), make_row(metric="energy_share-drag"), make_row(metric="power-motion"),
            make_row(scene="slab", metric="speed", reference_kind="theory"),
            make_row(metric="base_pressure_peak", asserted=False)]
    lines = lines_of(loaded, first + rest)
    assert [(line["run"], line["quantity"]) for line in lines if line["decides"]] == [("s1", "run_out"), ("s2", "run_out")]
    assert len([line for line in lines if not line["decides"]]) == len(rest)


def test_presets_of_a_scene_stand_side_by_side(loaded, make_row):
    loaded.runs["s1-other"] = {"case": "s1"}
    lines = lines_of(loaded, [make_row(scene=run, metric=metric) for run in ("s1", "s2", "s1-other") for metric in ("run_out@2", "height")])
    assert [(line["quantity"], line["run"]) for line in lines] == [
        ("run_out", "s1"), ("run_out", "s1-other"), ("height", "s1"), ("height", "s1-other"), ("run_out", "s2"), ("height", "s2")]


def test_bounds_and_what_is_conserved_are_not_at_a_glance(make_row):
    assert overview.of_interest(make_row())
    assert overview.of_interest(make_row(reference_kind="theory", reference=0.2))
    assert not overview.of_interest(make_row(reference_kind="theory", reference=0.0))
    assert not overview.of_interest(make_row(reference_kind="theory", tolerance="at most, within 0 [-]"))
    assert not overview.of_interest(make_row(reference_kind="regression"))


def test_expected_failures_stand_under_their_cause(loaded, make_row):
    known = {"reason": "r", "distance": 1.0}
    loaded.rows = [make_row(id=str(place), verdict="expected failure", expected_failure=known | {"cause": cause})
                   for place, cause in enumerate(["rare", "toe", "toe"])] + [make_row()]
    groups = overview.by_cause(loaded)
    assert [(group["key"], len(group["rows"])) for group in groups] == [("toe", 2), ("rare", 1)]
    assert groups[0]["text"] == "The toe is <thin>." and "No cause" in groups[1]["text"]


def test_a_scene_is_open_where_something_does_not_agree(loaded):
    scenes = {scene["case"]: scene for scene in overview.by_scene(loaded)}
    assert scenes["s1"]["open"] and not scenes["float-full-r02"]["open"]
    assert {row["scene"] for row in scenes["s1"]["rows"]} == {"s1", "s1-other"}
    assert scenes["s1"]["rows"][0]["unexpected"]
