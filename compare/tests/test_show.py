"""compare/show: film, plots and a page of any run directory."""

import json
import os
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent.parent
CASE = '[scene]\ndimensions = 2\n[tank]\nsize = [0.12, 0.08]\ngravity = 9.81\n[bed]\nheight = 0.04\n[time]\nunit = "column"\n'


@pytest.fixture
def directory(tmp_path):
    run = tmp_path / "mine"
    run.mkdir()
    (run / "series.csv").write_text("time [s],front_dense [m],p_base [Pa]\n0,0.1,\n0.5,0.2,\n")
    (run / "run.json").write_text(json.dumps({
        "scene": "mine", "title": "A <collapse>", "resolved_case": CASE, "grid": {"cells": [12, 8, 1], "spacing": [0.01, 0.01, 1.0]},
        "core_seconds": 2.5, "version": "0.2.0", "exit": {"state": "failed", "reason": "step collapse"}, "warnings": []}))
    with h5py.File(run / "fields.h5", "w") as file:
        for place, time in enumerate(np.linspace(0.0, 0.5, 6)):
            group = file.create_group(f"t{place:04}")
            group.attrs["time"] = time
            solid = np.zeros((1, 8, 12))
            solid[0, :4, :3 + place] = 0.57
            group["f_s"], group["alpha"] = solid, np.ones_like(solid)
    return run


def show(*directories):
    return subprocess.run([ROOT / "compare/show", *directories], capture_output=True, text=True,
                          env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"})


def test_a_run_has_film_plots_and_a_page_of_its_own(directory):
    ended = show(directory)
    assert ended.returncode == 0, ended.stderr
    assert ended.stdout.strip() == str(directory / "report/report.html")
    made = {path.name for path in (directory / "report").iterdir()}
    assert {"film.apng", "series-fronts.png", "snapshots-mine.png", "report.html"} <= made
    assert "series-pressure-at-the-base.png" not in made  # the column is empty
    with Image.open(directory / "report/film.apng") as moving:
        assert moving.n_frames == 6
    page = (directory / "report/report.html").read_text()
    assert page.count("data:image/png;base64,") == 3
    assert "A &lt;collapse&gt;" in page and "did not finish: step collapse" in page


def test_what_is_no_run_is_one_line_and_the_others_are_shown(directory, tmp_path):
    ended = show(tmp_path / "nowhere", directory)
    assert ended.returncode == 2 and ended.stderr.count("\n") == 1 and "nowhere/series.csv" in ended.stderr
    assert (directory / "report/report.html").exists()
    (directory / "run.json").write_text('{"scene": "mine"}')
    ended = show(directory)
    assert ended.returncode == 2 and ended.stderr.count("\n") == 1 and "run.json" in ended.stderr
