"""Cases of the beads' own material: as much solid as their records, and numbers that are those of the tests they name."""

import csv
import json
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "reference"), str(ROOT / "solver/python")]

import recorder  # noqa: E402
from granvof_files import toml_of  # noqa: E402

BEADS = sorted((ROOT / "cases/beads").glob("*-beads.toml"))


def records_of(case):
    return sorted((recorder.RESULTS / case.stem.removesuffix("-beads")).glob("seed*"))


def mean(numbers):
    return sum(numbers) / len(numbers)


def first_solid_volume(record):
    with open(record / "series.csv", newline="") as file:
        return float(next(csv.DictReader(file))["solid_volume [m3]"])


def monitors(record):
    return json.loads((record / "record.json").read_text())["monitors"]


def test_there_is_one_of_each_collapse_that_is_held_to_beads():
    assert [case.stem for case in BEADS] == ["canary-beads", "canary-dry-beads", "fw-2d-beads", "s1-beads", "s2-beads", "sw-2d-beads"]


@pytest.mark.parametrize("case", BEADS, ids=lambda case: case.stem)
def test_a_case_starts_with_as_much_solid_as_its_record_and_as_densely_packed(case):
    bed, records = toml_of(case)["bed"], records_of(case)
    assert len(records) == {"fw-2d-beads": 1, "canary-dry-beads": 4}.get(case.stem, 2)
    assert bed["solid_volume"] == pytest.approx(mean([first_solid_volume(record) for record in records]), rel=1e-4)
    assert bed["solid_fraction"] == pytest.approx(mean([monitors(record)["released_packing"] for record in records]), abs=1e-4)


def test_the_glass_is_what_the_element_tests_measured():
    material, measured = toml_of(ROOT / "cases/materials/glass-beads-0.8mm.toml"), monitors(recorder.RESULTS / "element/s1/seed1")
    contact = material["contact"]
    assert {"first_mu_s": material["solid"]["friction"], "first_mu_2": contact["fast_friction"],
            "first_I_0": contact["inertial_number"]} == {name: round(measured[name], 3) for name in ("first_mu_s", "first_mu_2", "first_I_0")}
    assert {"touching_loosest": contact["solid_fraction_min"], "touching_critical": contact["critical_solid_fraction"]} == {
        name: round(measured[name], 4) for name in ("touching_loosest", "touching_critical")}


# The chute of both: one program, one seed.
def test_the_chute_of_the_element_tests_is_that_of_the_bulk_friction():
    chute, measured = monitors(recorder.RESULTS / "bulk-friction/s1/seed1"), monitors(recorder.RESULTS / "element/s1/seed1")
    assert [measured[name] for name in ("mu_s", "mu_2", "I_0")] == pytest.approx([chute[name] for name in ("mu_s", "mu_2", "I_0")], rel=1e-3)


def test_the_polypropylene_is_what_the_element_tests_measured():
    material, measured = toml_of(ROOT / "cases/materials/polypropylene-beads-3.2mm.toml"), monitors(recorder.RESULTS / "element/sw-2d/seed1")
    contact = material["contact"]
    assert {"mu_s": material["solid"]["friction"], "mu_2": contact["fast_friction"], "I_0": contact["inertial_number"]} == {
        name: round(measured[name], 3) for name in ("mu_s", "mu_2", "I_0")}
    assert {"touching_loosest": contact["solid_fraction_min"], "touching_critical": contact["critical_solid_fraction"]} == {
        name: round(measured[name], 4) for name in ("touching_loosest", "touching_critical")}
