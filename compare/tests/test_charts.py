"""Charts of error against cost, and their section of the report, from made-up studies."""

import json

import pytest
from report import charts, sections

METHODS = [{"name": "first", "set": [], "about": "the paper's"}, {"name": "second", "set": ["a.b=1"], "about": ""}]


def point(method, cell, cost, failure=""):
    return {"method": method, "cell": cell, "set": [], "failure": failure, "version": "0.1.0 (abc)",
            "case_hash": "0123456789abcdef", "host": "A Processor", "core_seconds": cost, "core_s_per_s": cost,
            "work_units_per_s": 10 * cost}


def study(**changed):
    chart = {"case": "s1", "left_out": ["second on 0.625 mm (too dear)"], "dem_cost": 2000.0, "lines": ["s1: for 10 % use <first>"],
             "points": [point("first", 0.005, 1.0), point("first", 0.0025, 8.0), point("second", 0.005, 2.0, "step collapse"),
                        point("second", 0.0025, 12.0)],
             "panels": [{"quantity": "run_out", "curve": True, "against": "own finest grid", "source": "first on 1.25 mm",
                         "defined": True, "floor": 0.02, "note": "", "errors": [0.2, 0.1, None, 0.0], "pareto": [0, 1, 3]},
                        {"quantity": "run_out", "curve": True, "against": "DEM", "source": "", "defined": False, "floor": 0.0,
                         "note": "no record", "errors": [None] * 4, "pareto": []}]}
    return {"date": "2026-01-02T00:00:00Z", "methods": METHODS, "charts": [chart | changed]}


@pytest.fixture
def drawn(monkeypatch):
    """Axes as they are when a chart is saved."""
    seen = []
    monkeypatch.setattr(charts.style, "save", lambda figure, directory, name: seen.append(figure) or name)
    return seen


def test_a_chart_has_a_panel_for_each_reference_there_is(drawn):
    assert charts.draw_all(study(), None) == ["error-cost-s1"]
    axes = [axis for axis in drawn[0].axes]
    assert len(axes) == 1
    assert axes[0].get_xscale() == axes[0].get_yscale() == "log"
    lines = {line.get_label(): line for line in axes[0].get_lines()}
    assert list(lines["first"].get_xdata()) == [1.0, 8.0]
    assert list(lines["second"].get_ydata()) == [0.25 * 0.02]  # an error of 0 is drawn within the reference's uncertainty
    assert "failed" in lines and lines["failed"].get_ydata()[0] > 0.2
    assert lines["cost of DEM-VOF (demvof)"].get_xdata()[0] == 2000.0
    front = next(line for label, line in lines.items() if label.startswith("Pareto"))
    assert len(front.get_xdata()) == 3


def test_other_programs_are_points_where_they_can_be_judged(drawn):
    content = study(others=[{"name": "parcels", "source": "peers/parcels", "about": "25 grains", "core_s_per_s": 40.0},
                            {"name": "demvof", "source": "", "about": "", "core_s_per_s": 2000.0}])
    content["charts"][0]["panels"][0]["other_errors"] = [0.3, None]
    charts.draw_all(content, None)
    lines = {line.get_label(): line for line in drawn[0].axes[0].get_lines()}
    assert (lines["parcels (25 grains)"].get_xdata()[0], lines["parcels (25 grains)"].get_ydata()[0]) == (40.0, 0.3)
    assert "demvof" not in lines


def test_points_of_others_on_one_line_are_joined_and_marked(drawn):
    beads = {"source": "variants/beads", "about": "", "line": "coarse-grained beads"}
    content = study(others=[{"name": "demvof, k = 1.5", "core_s_per_s": 80.0} | beads, {"name": "demvof, k = 2", "core_s_per_s": 40.0} | beads,
                            {"name": "demvof, k = 3", "core_s_per_s": 20.0} | beads,
                            {"name": "parcels", "source": "", "about": "", "line": "", "core_s_per_s": 30.0}])
    content["charts"][0]["panels"][0]["other_errors"] = [0.1, 0.2, None, 0.3]
    charts.draw_all(content, None)
    axis = drawn[0].axes[0]
    lines = {line.get_label(): line for line in axis.get_lines()}
    assert list(lines["coarse-grained beads"].get_xdata()) == [40.0, 80.0]
    assert list(lines["coarse-grained beads"].get_ydata()) == [0.2, 0.1]
    assert lines["parcels"].get_linestyle() == "None"
    marks = {text.get_text() for text in axis.texts}
    assert {"k = 1.5", "k = 2"} <= marks and not {"k = 3", "parcels"} & marks


def test_what_was_not_run_is_shown_from_what_is_kept(tmp_path):
    write = lambda path, content: (path.parent.mkdir(parents=True, exist_ok=True), path.write_text(json.dumps(content)))
    write(tmp_path / "out/charts/points.json", study())
    write(tmp_path / "out/advise/s1.json", {
        "scene": "s1", "version": "0.1.0 (abc)", "summary": ["s1: run_out to 5 %", "cheapest: first on 5 mm"],
        "steps": [{"configuration": "first on 5 mm", "error": 0.031, "core_s_per_s": 1.0, "remark": "within the tolerance"},
                  {"configuration": "second on 5 mm", "error": None, "core_s_per_s": 0.0, "remark": "step collapse"}]})
    write(tmp_path / "out/stability/stability.json", {"axes": [], "points": []})
    kept = tmp_path / "kept"
    assert charts.main(["--charts", str(tmp_path / "out/charts"), "--keep", str(kept)]) == 0
    assert {str(path.relative_to(kept)) for path in kept.glob("**/*.json")} == {
        "charts/points.json", "advise/s1.json", "stability/stability.json"}
    assert charts.from_kept(kept, tmp_path / "clone/charts")
    (shown,) = sections.read_all(tmp_path / "clone")
    assert shown.title.endswith("(kept results)")
    assert "0.1.0 (abc)" in shown.text[0] and "2026-01-02" in shown.text[0]
    assert shown.tables[0]["rows"][0] == ["first on 5 mm", "3.1 %", 1.0, "within the tolerance"]
    assert shown.tables[0]["rows"][1][1] == "-"
    assert not charts.from_kept(tmp_path / "nothing", tmp_path / "clone/charts")


def test_a_chart_that_was_not_drawn_stays_as_it_is_kept(tmp_path):
    write = lambda path, content: (path.parent.mkdir(parents=True, exist_ok=True), path.write_text(json.dumps(content)))
    older = study() | {"date": "2025-01-02T00:00:00Z", "methods": METHODS[:1] + [METHODS[1] | {"name": "gone"}]}
    older["charts"] += study(case="s2")["charts"]
    write(tmp_path / "kept/charts/points.json", older)
    write(tmp_path / "out/charts/points.json", study(left_out=[]))
    for _ in range(2):  # what was kept beside others is kept again
        assert charts.main(["--charts", str(tmp_path / "out/charts"), "--keep", str(tmp_path / "kept")]) == 0
    kept = charts.load(tmp_path / "kept/charts")
    assert [(chart["case"], chart["date"][:4], len(chart["left_out"])) for chart in kept["charts"]] == [("s1", "2026", 0), ("s2", "2025", 1)]
    assert [method["name"] for method in kept["methods"]] == ["first", "second", "gone"]
    assert charts.made(kept) == "s1: 0.1.0 (abc), 2026-01-02; s2: 0.1.0 (abc), 2025-01-02"


def test_a_chart_without_a_reference_is_not_drawn(drawn):
    content = study()
    content["charts"][0]["panels"] = content["charts"][0]["panels"][1:]
    assert charts.draw_all(content, None) == []


def test_missing_charts_are_named(tmp_path, capsys):
    assert charts.main(["--charts", str(tmp_path)]) == 2
    assert "no points.json" in capsys.readouterr().err


def test_the_report_shows_charts_and_ablations(tmp_path):
    (tmp_path / "charts").mkdir()
    (tmp_path / "charts/points.json").write_text(json.dumps(study()))
    ablated = {"scene": "s1", "set": [], "version": "0.1.0", "case_hash": "0123456789abcdef", "host": "A Processor",
               "metrics": [{"metric": "run_out@10", "unit": "-", "tolerance": "0.05 [-]", "full": 2.2, "reference": 1.7}],
               "rows": [{"part": part, "set": [], "about": "", "applies": applies, "failure": failure, "dispensable": False,
                         "core_seconds": 2.0, "core_s_per_s": 3.0, "work_units_per_s": 30.0, "effects": effects}
                        for part, applies, failure, effects in [
                            ("full model", True, "", [{"value": 2.2, "change": 0.0, "tolerance": 0.05, "beyond": False}]),
                            ("no LES", True, "", [{"value": 2.5, "change": 0.3, "tolerance": 0.05, "beyond": True}]),
                            ("Theta off", True, "step collapse", []), ("2D", False, "in 2D already", [])]]}
    (tmp_path / "ablate/s1").mkdir(parents=True)
    (tmp_path / "ablate/s1/ablate.json").write_text(json.dumps(ablated))
    picture = tmp_path / "picture.png"
    assert charts.main(["--charts", str(tmp_path / "charts"), "--picture", str(picture)]) == 0
    assert 1000 < picture.stat().st_size < 100_000
    assert (tmp_path / "charts/error-cost-s1.pdf").exists()
    (shown,) = sections.read_all(tmp_path)
    assert [figure["name"] for figure in shown.figures] == ["charts-error-cost-s1"]
    assert "s1: for 10 % use <first>" in shown.text
    assert any("left out: second on 0.625 mm" in text for text in shown.text)
    assert shown.tables[0]["rows"] == [["reference", "1.7", "-"], ["full model", "2.2", 2.0], ["no LES", "+0.3 *", 2.0], ["Theta off", "failed", 2.0]]
