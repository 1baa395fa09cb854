"""A comparison made up from formulas, as granvof-compare would write it."""

import json
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
COMPARE = ROOT / "build/release/compare/granvof-compare"  # holds the run engine
sys.path[:0] = [str(ROOT / "compare"), str(ROOT / "solver/python")]


def label_of(check, at):
    """Metric of a row of results, from a check of the table and an instant or None: as metric_label() of compare/output/text.cpp."""
    parts = [f"@{at:g}"] if at is not None else []
    parts += [f"-{check[key]}" for key in ("against", "column", "term", "scheme") if key in check]
    return "".join([check["metric"], *parts]) + (f" ({check['label']})" if "label" in check else "")


@pytest.fixture
def label():
    return label_of


def row_of(**changed):
    row = {"id": "s1.run_out@10.DEM", "scene": "s1", "metric": "run_out@10", "value": 2.0, "unit": "-", "reference": 1.5,
           "reference_kind": "DEM", "reference_source": "reference/results/s1", "band": 0.1, "tolerance": "0.05 [-]",
           "verdict": "differs", "unexpected": True, "asserted": True, "frequency": "verify", "note": "", "deviation": 0.5,
           "distance": 0.45}
    return row | changed


def rows_of_a_comparison():
    rows = [row_of(),
            row_of(id="a", scene="s2", metric="run_out@10", verdict="not run", unexpected=False, reference=None,
                     deviation=None, distance=None, note="no record of 's2'"),
            row_of(id="b", scene="s1", metric="core_seconds", unit="core-s", value=2.2, reference=3, verdict="agrees",
                     unexpected=False, distance=0.0, deviation=-0.8),
            row_of(id="c", scene="s1", metric="late <creep>", verdict="expected failure", unexpected=False,
                     expected_failure={"reason": "no arrest & thin layers", "distance": 0.5, "cause": "toe"})]
    for ratio in (0.2, 0.4, 0.6, 0.8):
        name = f"float-full-r{10 * ratio:02.0f}"
        rows.append(row_of(id=f"{name}.share", scene=name, metric="immersed_share", value=ratio + 0.001, reference=ratio,
                             reference_kind="theory", verdict="agrees", unexpected=False, distance=0.0, deviation=0.001))
        rows.append(row_of(id=f"{name}.share.DEM", scene=name, metric="immersed_share", value=ratio + 0.001, reference=ratio - 0.01,
                             verdict="agrees", unexpected=False, distance=0.0, deviation=0.011))
        rows.append(row_of(id=f"{name}.period", scene=f"{name}-nodrag", metric="period", unit="s", value=ratio, reference=ratio,
                             reference_kind="theory", verdict="agrees", unexpected=False, distance=0.0, deviation=0.0))
    rows += [row_of(id="d", scene="s1", metric="slope_drift", verdict="not run", unexpected=False, reference=None, value=None,
                    deviation=None, distance=None),
             row_of(id="e", scene="s1-other", metric="run_out@10", value=1.9, verdict="reported only", unexpected=False, asserted=False,
                    distance=0.35, deviation=0.4, tolerance="0.05 [-], reported only")]
    return rows


def make_run(name):
    return {"id": name, "case": name, "set": [], "state": "usable", "reason": "", "version": "0.1.0", "commit": "abc1234",
            "date": "2026-01-01T00:00:00Z", "case_hash": "0123456789abcdef", "host": "A Processor", "exit": "finished",
            "numbers": {"cells": 96, "steps": 100, "core_seconds": 2.2, "simulated_time": 0.7, "cell_steps_per_second": 1e6}}


def make_fields(path, phi_of_x):
    x = (np.arange(12) + 0.5) / 12
    f_s = np.zeros((1, 8, 12))
    alpha = np.zeros_like(f_s)
    alpha[0, :6] = 1.0
    path.mkdir(parents=True, exist_ok=True)
    with h5py.File(path / "fields.h5", "w") as file:
        for index, time in enumerate(np.linspace(0.0, 0.7, 5)):
            group = file.create_group(f"t{index:04}")
            group.attrs["time"] = time
            f_s[0, :4, :3 + index] = 0.57 - 0.1 * (index % 2)
            group["f_s"], group["alpha"], group["phi"] = f_s, alpha, np.broadcast_to(phi_of_x(x), f_s.shape)


@pytest.fixture(scope="session")
def compare():
    """The program granvof-compare."""
    assert COMPARE.exists(), "`make build` builds granvof-compare"
    return COMPARE


@pytest.fixture
def make_row():
    return row_of


@pytest.fixture
def make_rows():
    return rows_of_a_comparison


def make_comparison(root):
    names = ["s1", "s2", "s1-loose", "sw-2d", "dam-break", "sedimentation", "rondon-loose"] + [f"float-full-r0{r}{kind}" for r in (2, 4, 6, 8) for kind in ("", "-nodrag")]
    t = np.linspace(0, 6, 200)
    curves = {}
    for name in names:
        if name in ("s1", "float-full-r02"):  # drawing is slow; two scenes are enough
            make_fields(root / "runs" / name, lambda x: np.floor(4 * x) % 2)
        scene = {"title": name, "tank": [0.12, 0.08, 0.01], "dimensions": 2, "cells": [12, 8, 1], "spacing": [0.01, 0.01, 0.01],
                 "gravity": 9.81, "density_ratio": 0.2, "drag": True, "end": 6.0, "time_unit": 0.07, "field_times": [0, 0.7],
                 "bed": {"lower": [0, 0, 0], "upper": [0.05, 0.04, 0], "solid_fraction": 0.57}}
        given = {"run_out": (t, t / 3), "excess_base_pressure": (t, np.exp(-t)), "y_c_deviation": (t, np.cos(t)),
                 "y_solid_mean_deviation": (t, np.cos(t)), "front_dense": (t, t / 3), "scaled_liquid_front": (t, 1 + t),
                 "solid_level_0.25": (t, 0.05 - t / 200), "solid_level_0.55": (t, t / 200)}
        curves[name] = {"scene": scene, "directory": str(root / "runs" / name),
                        "curves": {key: {"x": list(x), "y": list(y)} for key, (x, y) in given.items()}}
    for seed, cost in ((1, 200.0), (2, 240.0)):
        (root / f"records/seed{seed}").mkdir(parents=True)
        (root / f"records/seed{seed}/record.json").write_text(json.dumps({"core_seconds": cost}))
        (root / f"records/seed{seed}/fields.h5").symlink_to(root / "runs/s1/fields.h5")
    records = {"s1": {f"seed{seed}": curves["s1"] | {"directory": str(root / f"records/seed{seed}")} for seed in (1, 2)}, "s2": {"seed1": curves["s2"]}}
    directory = root / "verify"
    directory.mkdir()
    (directory / "results.json").write_text(json.dumps({
        "date": "2026-01-02T00:00:00Z", "frequency": "verify", "unexpected": 1, "counts": {}, "causes": {"toe": "The toe is <thin>."},
        "runs": [make_run(name) for name in names] + [make_run("s1-other") | {"case": "s1"}], "results": rows_of_a_comparison()}))
    (directory / "curves.json").write_text(json.dumps({"runs": curves, "records": records}))
    return directory


@pytest.fixture
def verify_directory(tmp_path):
    return make_comparison(tmp_path)


@pytest.fixture(scope="session")
def reported(tmp_path_factory):
    """A comparison with its report, drawn once; not to be changed."""
    from report import report

    directory = make_comparison(tmp_path_factory.mktemp("reported"))
    section = {"title": "What went wrong", "figures": [], "tables": [{"columns": ["file", "fault", "by"], "rows": [
        ["solver/operators/a_long_name_of_a_file.cpp", "old → new", "Suite.ALongNameOfATest"], ["solver/run/b.cpp", 1.5, ""]]}]}
    (directory.parent / "faults").mkdir()
    (directory.parent / "faults/faults.json").write_text(json.dumps(section))
    assert report.main(["--verify", str(directory), "--kept", str(directory / "nothing")]) == 0
    return directory


def fill_instant(group):
    group.attrs["time"] = 0.0
    for name in ("f_s", "alpha", "p_c", "theta", "phi"):
        group[name] = np.zeros((2, 3, 4))
    group["u_s"] = group["u_c"] = np.zeros((2, 3, 4, 3))


@pytest.fixture
def small_run(tmp_path):
    """A run directory with one instant."""
    run = tmp_path / "run"
    run.mkdir()
    (run / "series.csv").write_text("time [s],front_dense [m]\n0,0.1\n0.5,0.2\n")
    (run / "run.json").write_text(json.dumps({"scene": "s1"}))
    with h5py.File(run / "fields.h5", "w") as file:
        file.attrs["cells"], file.attrs["spacing"], file.attrs["origin"] = [4, 3, 2], [0.1, 0.2, 0.5], [0.0, 0.0, 0.0]
        file.attrs["scene"] = np.bytes_("s1")
        fill_instant(file.create_group("t0000"))
    return run


@pytest.fixture
def linked_run(small_run):
    """The run as it is while it goes on: an instant a file."""
    (small_run / "fields").mkdir()
    with h5py.File(small_run / "fields/t0000.h5", "w") as piece:
        fill_instant(piece.create_group("instant"))
    link_to(small_run, "fields/t0000.h5")
    return small_run


def link_to(run, file_name):
    with h5py.File(run / "fields.h5", "r+") as file:
        del file["t0000"]
        file["t0000"] = h5py.ExternalLink(file_name, "/instant")


@pytest.fixture
def relink():
    """Leads the instant of a run to another file."""
    return link_to


CASE_TO_SHOW = '[scene]\ndimensions = 2\n[tank]\nsize = [0.12, 0.08]\ngravity = 9.81\n[bed]\nheight = 0.04\n[time]\nunit = "column"\n'


@pytest.fixture
def run_to_show(tmp_path):
    return write_run_to_show(tmp_path / "mine")


@pytest.fixture(scope="session")
def run_shown(tmp_path_factory):
    """One for all who only look at it."""
    return write_run_to_show(tmp_path_factory.mktemp("shown") / "mine")


def write_run_to_show(run):
    """A run of six instants with all that compare/show needs."""
    run.mkdir()
    (run / "series.csv").write_text("time [s],front_dense [m],p_base [Pa]\n0,0.1,\n0.5,0.2,\n")
    (run / "run.json").write_text(json.dumps({
        "scene": "mine", "title": "A <collapse>", "resolved_case": CASE_TO_SHOW,
        "grid": {"cells": [12, 8, 1], "spacing": [0.01, 0.01, 1.0]},
        "core_seconds": 2.5, "version": "0.2.0", "exit": {"state": "failed", "reason": "step collapse"}, "warnings": []}))
    with h5py.File(run / "fields.h5", "w") as file:
        for place, time in enumerate(np.linspace(0.0, 0.5, 6)):
            group = file.create_group(f"t{place:04}")
            group.attrs["time"] = time
            solid = np.zeros((1, 8, 12))
            solid[0, :4, :3 + place] = 0.57
            group["f_s"], group["alpha"] = solid, np.ones_like(solid)
    return run
