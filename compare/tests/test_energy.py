"""The figure of the energy budget: it draws every term of the ledger, and what is drawn closes."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from report import energy, results

ROOT = Path(__file__).resolve().parent.parent.parent
SOLVER = ROOT / "build/release/solver/granvof"
TIME = np.linspace(0.0, 1.0, 11)
SHORT = ["time.end=5", "model.preset=advised"]
TABLE = f"""
[[run]]
id = "canary"
set = {json.dumps(SHORT)}

[[check]]
run = "canary"
metric = "solid_volume_error"
reference = {{ kind = "theory", value = 0, source = "(1)" }}
tolerance = {{ absolute = 1e-9, unit = "-" }}
frequency = "short"
"""


def a_term(name, kind, energy_at_end, never_gains=False):
    return {"name": name, "kind": kind, "label": f"label of {name}", "never_gains": never_gains}, energy_at_end * TIME


def entry_of(*terms, rest):
    curves = {f"energy:{term['name']}": values for term, values in terms} | {"energy:open": rest * TIME}
    return {"ledger": [term for term, _ in terms], "scene": {"time_unit": 1.0},
            "curves": {name: {"x": list(TIME), "y": list(values)} for name, values in curves.items()}}


@pytest.fixture
def entry():
    """Changes and losses as `granvof-compare` signs them: together 0.25 J that nothing accounts for."""
    return entry_of(a_term("energy_potential", "stored", -8.0), a_term("energy_kinetic", "stored", 1.0),
                    a_term("lost_drag", "dissipated", 3.0, True), a_term("lost_outflow", "outside", 2.0),
                    a_term("gained_walls", "outside", -0.75), a_term("lost_numerical_time", "numerical", 2.0, True),
                    a_term("lost_numerical_solid", "numerical", 1.0), a_term("of_which", "part", 5.0),
                    a_term("energy_residual", "residual", -0.25), rest=0.25)


@pytest.fixture(scope="module")
def real(compare, tmp_path_factory):
    """The entry of a short run of the canary, its ledger and curves as the programs state them."""
    assert SOLVER.exists(), "`make build` builds granvof"
    folder = tmp_path_factory.mktemp("real")
    sets = [word for override in SHORT for word in ("--set", override)]
    (folder / "checks.toml").write_text(TABLE, encoding="utf-8")
    for command in ([SOLVER, "run", ROOT / "cases/canary.toml", *sets, "--threads", "1", "--out", "runs/canary"],
                    [compare, "check", "--runs", "runs", "--checks", "checks.toml", "--frequency", "short", "--cases", ROOT / "cases",
                     "--records", "none", "--leave-out", "canary", "--out", "verify"]):
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
    return json.loads((folder / "verify/curves.json").read_text(encoding="utf-8"))["runs"]["canary"]


# As many millionths of what is turned over as sums of nine digits may be off.
def test_what_is_drawn_of_a_real_run_closes_up_to_the_rest(real):
    shown = energy.drawn(real)
    drawn = shown.stored + shown.stacked + shown.lines
    turned_over = sum(np.abs(term.energy) for term in drawn)
    assert turned_over[-1] > 0.0
    assert np.abs(sum(term.energy for term in drawn) - shown.rest.energy).max() < 1e-6 * turned_over.max()
    assert len(drawn) == sum(term["kind"] not in ("part", "residual") for term in real["ledger"]) > 15
    for term in shown.stacked:
        assert term.energy.min() >= 0.0, f"{term.label} is stacked, and gains"
    # it would be seen if one of them were left out: each that acts is more than that
    acting = [term for term in drawn if np.abs(term.energy).max() > 1e-4 * turned_over.max()]
    assert len(acting) > 8


def test_what_is_drawn_closes_up_to_the_rest(entry):
    shown = energy.drawn(entry)
    total = sum(term.energy for term in shown.stored + shown.stacked + shown.lines)
    assert total == pytest.approx(shown.rest.energy, abs=1e-12)
    assert shown.rest.label == "label of energy_residual"


def test_every_term_but_parts_is_drawn_once(entry):
    shown = energy.drawn(entry)
    labels = [term.label for term in shown.stored + shown.stacked + shown.lines + [shown.rest]]
    assert sorted(labels) == sorted(term["label"] for term in entry["ledger"] if term["kind"] != "part")


def test_what_can_gain_is_not_stacked(entry):
    assert [term.label for term in energy.drawn(entry).stacked] == ["label of lost_drag", "label of lost_numerical_time"]


def test_the_figure_holds_the_values_of_its_terms(entry, tmp_path, monkeypatch):
    axes = []
    monkeypatch.setattr(energy.style, "stamp", lambda figure, facts: axes.extend(figure.axes))
    monkeypatch.setattr(energy.style, "save", lambda figure, directory, name, pdf: name)
    loaded = results.Results(tmp_path, "", "", [], {}, curves={"a": entry})
    monkeypatch.setattr(results.Results, "facts", lambda self, run: "", raising=False)
    assert energy.energy_plot(loaded, "a", tmp_path) == ["energy-a"]
    left, right = axes
    lines = sum(line.get_ydata() for axis in axes for line in axis.lines if len(line.get_ydata()) == len(TIME)
                and line.get_label() != "label of energy_residual")
    tops = [path.vertices for area in right.collections for path in area.get_paths()]
    stacked = max(vertices[:, 1].max() for vertices in tops)
    assert stacked == pytest.approx(5000.0)
    assert lines[-1] + stacked == pytest.approx(1e3 * 0.25)
    assert len(left.lines) == 3


def test_a_run_without_a_ledger_has_no_figure(entry, tmp_path):
    for without in (entry | {"ledger": []}, entry | {"curves": {}}):
        loaded = results.Results(tmp_path, "", "", [], {}, curves={"a": without})
        assert energy.drawn(without) is None
        assert energy.energy_plot(loaded, "a", tmp_path) == []
