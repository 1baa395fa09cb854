"""The gallery: every scene of `make verify` with its picture, what it is and what its rows say."""

import re
import tomllib
from pathlib import Path

import numpy as np
from PIL import Image

from report import film, gallery

ROOT = Path(__file__).resolve().parent.parent.parent
LARGEST = 1_500_000  # bytes of all pictures


def scenes_of_verify():
    """Cases of the runs that a check of `make verify` names, and the runs beside those are of the same."""
    checks = tomllib.loads((ROOT / "compare/checks.toml").read_text())["check"]
    named = [run for check in checks if check.get("frequency") in ("short", "verify")
             for run in (check["run"] if isinstance(check["run"], list) else [check["run"]])]
    known = gallery.cases_of(ROOT)
    return {known[run] for run in named}


def test_every_scene_of_verify_is_in_it():
    lines = [line for line in (ROOT / "docs/gallery.md").read_text().splitlines() if line.startswith("| ![")]
    shown = {re.match(r"\| !\[([^]]*)\]\(([^)]*)\)", line).groups() for line in lines}
    assert len(scenes_of_verify()) > 20
    assert scenes_of_verify() <= {case for case, _ in shown}
    for case, picture in shown:
        with Image.open(ROOT / "docs" / picture) as image:
            assert max(image.size) > 40 and len(image.getcolors()) > 1, case
    assert sum(path.stat().st_size for path in (ROOT / gallery.PICTURES).iterdir()) < LARGEST


def test_a_line_says_what_is_shown_and_how_it_was_judged(tmp_path):
    (tmp_path / "compare").mkdir()
    (tmp_path / "cases/invariance").mkdir(parents=True)
    (tmp_path / "compare/checks.toml").write_text('[[run]]\nid = "a"\n[[run]]\nid = "a-advised"\nbeside = "a"\n'
                                                  '[[run]]\nid = "r-paper"\ncase = "invariance/r"\n[[run]]\nid = "unseen"\n')
    (tmp_path / "cases/a.toml").write_text('[scene]\ntitle = "A column"\n')
    (tmp_path / "cases/invariance/r.toml").write_text('[scene]\ntitle = "A raft"\n')
    (tmp_path / gallery.PICTURES).mkdir(parents=True)
    (tmp_path / gallery.picture_of("invariance/r")).touch()
    rows = [{"scene": "r-paper", "verdict": "differs"}, {"scene": "a", "verdict": "agrees"}, {"scene": "a-advised", "verdict": "agrees"},
            {"scene": "a", "verdict": "expected failure"}, {"scene": "no run", "verdict": "agrees"}]
    assert gallery.table({"rows": rows}, tmp_path).splitlines()[2:] == [
        "| not among the runs of `make verify` | [a](../cases/a.toml): A column | 2 agrees, 1 expected failure |",
        "| ![invariance/r](gallery/invariance-r.png) | [invariance/r](../cases/invariance/r.toml): A raft | 1 differs |"]


def test_a_picture_is_that_of_the_middle_of_its_run(verify_directory, tmp_path, monkeypatch):
    monkeypatch.setattr(gallery, "cases_of", lambda _: {"s1-other": "s1", "s1": "s1", "nowhere": "nowhere"})
    solid = np.zeros((2, 4))
    solid[0, :2] = 0.63  # at the floor, on the left
    shots = [(time, factor * solid, 0 * solid, None) for time, factor in ((0.0, 0.0), (0.5, 1.0), (1.0, 0.0))]
    monkeypatch.setattr(gallery.results, "snapshots", lambda entry: shots)
    gallery.write_pictures(verify_directory, tmp_path)
    assert [path.name for path in (tmp_path / gallery.PICTURES).iterdir()] == ["s1.png"]
    picture = np.asarray(Image.open(tmp_path / gallery.picture_of("s1")).convert("RGB")).astype(int)
    assert picture.shape == (gallery.HIGH + 2, gallery.WIDE + 2, 3)
    brown = picture[..., 0] > 1.5 * picture[..., 2]
    assert brown[gallery.HIGH // 2 + 1:-1, 1:gallery.WIDE // 2 + 1].all() and brown.sum() == gallery.HIGH * gallery.WIDE // 4


def test_a_column_of_few_cells_is_wide_enough_to_see():
    image = gallery.small(film.pixels_of(np.full((300, 2), 0.6), np.ones((300, 2))))
    assert image.size == (gallery.LEAST_ACROSS + 2, gallery.HIGH + 2)
