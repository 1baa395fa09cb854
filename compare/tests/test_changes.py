"""What changed since the comparison before, and what is no change."""

import json

from report import page, results


def changed_rows(directory, rows):
    (directory / "results.previous.json").write_text(json.dumps({"date": "2026-01-01T00:00:00Z", "results": rows}))
    return {(row["id"], what) for row, _, what in results.changes(results.load(directory))}


def test_first_comparison_has_no_changes(verify_directory):
    loaded = results.load(verify_directory)
    assert results.changes(loaded) == []
    assert "No earlier comparison" in page.render(loaded, [])


def test_same_results_are_no_change(verify_directory, make_rows):
    assert changed_rows(verify_directory, make_rows()) == set()
    assert "No change since 2026-01-01" in page.render(results.load(verify_directory), [])


def test_changes_of_verdict_value_and_rows_are_found(verify_directory, make_row, make_rows):
    before = make_rows()
    before[0] = make_row(verdict="agrees")
    before[4] = before[4] | {"value": before[4]["value"] * 1.01}
    before[5] = before[5] | {"value": before[5]["value"] * 1.0005}  # below the threshold
    before[2] = before[2] | {"value": 9.9}  # cost
    before = [row for row in before if row["id"] != "a"] + [make_row(id="old")]
    found = changed_rows(verify_directory, before)
    assert {row_id for row_id, _ in found} == {"s1.run_out@10.DEM", "float-full-r02.share", "a", "old"}
    assert ("s1.run_out@10.DEM", "agrees → differs") in found
    assert ("a", "new") in found and ("old", "gone") in found


def test_rounding_noise_of_a_conserved_volume_is_no_change(verify_directory, make_row):
    noise = make_row(id="v", metric="solid_volume_error", value=1e-15, reference=0, verdict="agrees", distance=0.0, unexpected=False)
    loaded = results.load(verify_directory)
    loaded.rows, loaded.previous = [noise], {"v": noise | {"value": 7e-16}}
    assert results.changes(loaded) == []


def test_what_is_more_than_noise_is_a_change_within_an_absolute_tolerance_too(verify_directory, make_row):
    row = make_row(id="v", metric="drift", value=2e-3, reference=0, verdict="agrees", distance=0.0, unexpected=False)
    loaded = results.load(verify_directory)
    loaded.rows, loaded.previous = [row], {"v": row | {"value": 1e-3}}
    assert [found["id"] for found, _, _ in results.changes(loaded)] == ["v"]


def test_a_change_is_relative_to_the_larger_of_the_two():
    assert not results.moved(1.0, 1.0515, 0.05) and not results.moved(1.0515, 1.0, 0.05)
    assert results.moved(1.0, 1.06, 0.05) and results.moved(1.06, 1.0, 0.05)
