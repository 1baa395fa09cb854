"""The energy of a run beside that of the beads: terms, table, plot, and files that are no budget."""

import re
from pathlib import Path

import numpy as np
import pytest

from report import energy, figures, ledgers, results, style

OURS = {"time [s]": (0, 1), "energy_kinetic [J]": (0, 2), "energy_potential [J]": (10, 3), "energy_granular [J]": (0, 0.5),
        "energy_elastic [J]": (1, 1), "lost_drag [J]": (0, 1), "lost_friction [J]": (0, 2), "lost_collisions [J]": (0, 0.5),
        "lost_viscosity [J]": (0, 0.25), "gained_dilatancy [J]": (0, 0.25), "gained_shear_dilatancy [J]": (0, 0),
        "lost_numerical_time [J]": (0, 0.75), "lost_numerical_momentum [J]": (0, 0.25), "energy_residual [J]": (0, 0)}
BEADS = {"time [s]": (0, 1), "energy_kinetic [J]": (0, 1), "energy_potential [J]": (20, 13), "energy_granular [J]": (0.5, 1),
         "energy_spin [J]": (0, 0.5), "energy_elastic [J]": (0, 0), "lost_drag [J]": (0, 1.5), "lost_contacts [J]": (0, 2),
         "lost_walls [J]": (0, 0.5), "gained_gate [J]": (0, 0.25), "lost_viscosity [J]": (0, 0.25),
         "lost_numerical_time [J]": (0, 0.5), "lost_numerical_pressure [J]": (0, 0.25), "energy_residual [J]": (0, -0.25)}


def write_series(directory, columns):
    directory.mkdir(parents=True, exist_ok=True)
    rows = [columns, *zip(*columns.values())]
    (directory / "series.csv").write_text("".join(",".join(str(value) for value in row) + "\n" for row in rows))
    return directory


@pytest.fixture
def pair(tmp_path):
    return write_series(tmp_path / "ours", OURS), write_series(tmp_path / "beads", BEADS)


def test_terms_are_changes_in_what_both_count_alike(pair):
    ours, beads = (ledgers.read_ledger(directory)[1] for directory in pair)
    assert {term: curve[-1] for term, curve in ours.items()} == {
        "released": 7, "motion": 2, "agitation": 0.5, "elastic": 0, "contacts": 2.25, "walls": 0, "drag": 1, "viscosity": 0.25, "numerics": 1,
        "open": 0}
    assert {term: curve[-1] for term, curve in beads.items()} == {
        "released": 7, "motion": 1, "agitation": 1, "elastic": 0, "contacts": 2, "walls": 0.25, "drag": 1.5, "viscosity": 0.25,
        "numerics": 0.75, "open": -0.25}
    for changes in (ours, beads):  # released = stored + lost, less what is not accounted for
        assert changes["released"] == pytest.approx(sum(curve for term, curve in changes.items() if term not in ("released", "open"))
                                                    - changes["open"])


def test_the_table_has_each_term_of_each_directory(pair, capsys):
    assert ledgers.main(["--at", "0.5,1", *map(str, pair)]) == 0
    text = capsys.readouterr().out
    assert text.splitlines()[0] == "t = 0.5 s"
    assert [line.split()[-2:] for line in text.splitlines() if "between grains" in line] == [["1125.000", "1000.000"], ["2250.000", "2000.000"]]


def test_a_run_is_beside_the_record_that_judges_it_or_that_of_its_case(verify_directory):
    loaded = results.load(verify_directory)
    loaded.runs["of-beads"] = {"id": "of-beads", "case": "beads/s1-beads", "record": "s1"}
    assert [loaded.record_of(run) for run in ("of-beads", "s1", "none")] == ["s1", "s1", "none"]


def test_shares_are_of_what_was_released_in_between(pair, capsys):
    assert ledgers.main(["--shares", "--at", "0,0.5,1", *map(str, pair)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line for line in lines if line.startswith("t")] == ["t = 0 to 0.5 s", "t = 0.5 to 1 s"]
    assert [line.split()[-2:] for line in lines if "lost to drag" in line] == [["14.3", "21.4"]] * 2


def test_the_checks_count_the_same_terms():
    source = (Path(ledgers.__file__).parents[1] / "input/shared_ledger.cpp").read_text()
    terms = re.findall(r'\{"(\w+)",\s*\{([^}]*)\},\s*\{([^}]*)\}\}', source)
    named = {name: tuple(tuple(re.findall(r'"([^"]+)"', columns)) for columns in lists) for name, *lists in terms}
    assert named == {name: term[1:] for name, term in ledgers.TERMS.items() if name != "open"}


def test_a_series_without_a_budget_is_refused(tmp_path, capsys):
    directory = write_series(tmp_path / "old", {"time [s]": (0, 1), "p_base [Pa]": (0, 0)})
    assert ledgers.read_ledger(directory) is None
    assert ledgers.main(["--at", "1", str(directory)]) == 1
    assert "it has no energy budget" in capsys.readouterr().err


def test_a_run_and_its_record_are_drawn_where_both_have_a_budget(verify_directory, tmp_path):
    loaded = results.load(verify_directory)
    assert ledgers.ledger_plot(loaded, "s1", tmp_path) == []
    write_series(verify_directory.parent / "runs/s1", OURS)
    for seed in (1, 2):
        write_series(verify_directory.parent / f"records/seed{seed}", {"time [s]": (0, 1), "p_base [Pa]": (0, 0)})
    assert ledgers.ledger_plot(loaded, "s1", tmp_path) == []
    write_series(verify_directory.parent / "records/seed1", BEADS)
    assert ledgers.ledger_plot(loaded, "s1", tmp_path) == ["ledger-s1"]
    assert (tmp_path / "ledger-s1.png").exists()
    assert figures.caption("ledger-s1").startswith("s1: the energy of the run")
    (_, ours), beads = ledgers.ledgers_of(loaded, "s1")
    assert len(beads) == 1 and np.all(np.isfinite(ours["drag"]))


def test_a_damaged_series_is_named(verify_directory, tmp_path):
    loaded = results.load(verify_directory)
    (verify_directory.parent / "runs/s1/series.csv").write_text("time [s],lost_drag [J]\n0,zero\n")
    with pytest.raises(results.Damaged, match="series.csv cannot be shown"):
        ledgers.ledger_plot(loaded, "s1", tmp_path)


def test_legends_of_a_budget_cover_neither_data_nor_names(tmp_path, monkeypatch):
    t = np.linspace(0.0, 1.0, 20)
    stored = ["potential, both phases", "kinetic, both phases", "granular", "elastic, contacts"]
    lost = [f"numerics: transport of momentum {i}" for i in range(15)]
    ledger = [{"name": label, "label": label, "kind": kind, "never_gains": len(label) % 2 == 0}
              for kind, labels in (("stored", stored), ("numerical", lost), ("residual", ["open"])) for label in labels]

    curves = {f"energy:{term['name']}": {"x": list(t), "y": list(t)} for term in ledger}

    class Compared:
        def __init__(self):
            self.curves = {"canary-dry-frictional": {"scene": {"time_unit": 1.0}, "curves": curves, "ledger": ledger}}

        def facts(self, run):
            return [{"id": run, "case_hash": "18a1ced3", "host": "A Processor", "version": "0.2.0"}]

    drawn = []
    monkeypatch.setattr(style, "save", lambda figure, *_, **__: drawn.append(figure))
    energy.energy_plot(Compared(), "canary-dry-frictional", tmp_path)
    figure = drawn[0]
    figure.canvas.draw()
    pieces = {"name": figure._suptitle.get_window_extent()}
    for side, axis in zip(("left", "right"), figure.axes):
        pieces |= {f"{side} axes": axis.get_window_extent(), f"{side} legend": axis.get_legend().get_window_extent()}
        assert axis.get_window_extent().width > 0.35 * figure.bbox.width
    both = [(a, b) for a in pieces for b in pieces if a < b]
    assert [(a, b) for a, b in both if pieces[a].overlaps(pieces[b])] == []
    style.plt.close(figure)
