"""compare/show: film, plots and a page of any run directory."""

import os
import subprocess
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parent.parent.parent


def show(*directories):
    return subprocess.run([ROOT / "compare/show", *directories], capture_output=True, text=True,
                          env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"})


def test_a_run_has_film_plots_and_a_page_of_its_own(run_to_show):
    ended = show(run_to_show)
    assert ended.returncode == 0, ended.stderr
    assert ended.stdout.strip() == str(run_to_show / "report/report.html")
    made = {path.name for path in (run_to_show / "report").iterdir()}
    assert {"film.apng", "series-fronts.png", "snapshots-mine.png", "report.html"} <= made
    assert "series-pressure-at-the-base.png" not in made  # the column is empty
    with Image.open(run_to_show / "report/film.apng") as moving:
        assert moving.n_frames == 6
    page = (run_to_show / "report/report.html").read_text()
    assert page.count("data:image/png;base64,") == 3
    assert "A &lt;collapse&gt;" in page and "did not finish: step collapse" in page


def test_what_is_no_run_is_one_line_and_the_others_are_shown(run_to_show, tmp_path):
    ended = show(tmp_path / "nowhere", run_to_show)
    assert ended.returncode == 2 and ended.stderr.count("\n") == 1 and "nowhere/series.csv" in ended.stderr
    assert (run_to_show / "report/report.html").exists()
    (run_to_show / "run.json").write_text('{"scene": "mine"}')
    ended = show(run_to_show)
    assert ended.returncode == 2 and ended.stderr.count("\n") == 1 and "run.json" in ended.stderr
