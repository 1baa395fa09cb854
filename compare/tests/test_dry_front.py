"""The front of the collapse in air beside its record: what the README praises has its picture."""

import pytest
from report import collapse, figures, results, style


@pytest.fixture
def loaded(verify_directory):
    """canary-dry by two sets of choices, with two recorded seeds."""
    loaded = results.load(verify_directory)
    one = loaded.curves["s1"]
    one = one | {"curves": {"run_out_quantile": one["curves"]["run_out"]}}
    loaded.curves = {"canary-dry": one, "canary-dry-frictional": one, "s1": loaded.curves["s1"]}
    loaded.records = {"canary-dry": {"seed1": one, "seed2": one}}
    return loaded


def test_every_set_of_choices_stands_beside_the_beads(loaded, tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr(style, "save", lambda figure, directory, name: drawn.append(figure) or name)
    assert collapse.dry_front_plot(loaded, tmp_path) == ["dry-front"]
    labels = [line.get_label() for line in drawn[0].axes[0].lines]
    assert labels == ["continuum, preset paper", "continuum, frictional restitution", "DEM-VOF (mean and range of 2 seeds)"]


def test_there_is_none_without_runs_and_records(loaded, tmp_path):
    loaded.curves, loaded.records = {}, {}
    assert collapse.dry_front_plot(loaded, tmp_path) == []


def test_the_page_links_it(loaded, tmp_path):
    assert collapse.dry_front_plot in figures.PLOTS and "99.5 %" in figures.caption("dry-front")
    plots = ["run-out", "dry-front", "snapshots-canary-dry"]
    assert figures.plot_of("canary-dry-frictional", "canary-dry", "run_out_quantile", plots) == "dry-front"
    assert figures.plot_of("s1", "s1", "run_out_quantile", plots) == "run-out"
