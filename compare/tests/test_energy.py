"""The figure of the energy budget: it draws every term of the ledger, and what is drawn closes."""

import numpy as np
import pytest

from report import energy, results

TIME = np.linspace(0.0, 1.0, 11)


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
