"""The stability map: reading its table, the search for a border, the verdict on a run, the figure."""

import importlib.machinery
import importlib.util
import json
from pathlib import Path

import pytest
from border import judge, search, table
from engine.client import Engine
from report import sections, stability

ROOT = Path(__file__).resolve().parents[2]
_loader = importlib.machinery.SourceFileLoader("stability_program", str(ROOT / "compare/stability"))
program = importlib.util.module_from_spec(importlib.util.spec_from_loader("stability_program", _loader))
_loader.exec_module(program)
AXIS = table.Axis("a", table.SceneEntry("s", Path("s.toml"), {}), "-", 1.0, ["k={}"], low=0.01, high=100.0)


def border_at(limit, axis=AXIS, end=100.0, bisections=8):
    return search.find_border(axis, end, lambda value: judge.Outcome(judge.HOLDS if value <= limit else judge.BLOW_UP, "big"),
                              bisections)


def test_the_shipped_table_is_read():
    read = table.read(ROOT / "compare/stability.toml")
    assert {"first order", "limited"} <= set(read.methods)
    assert len({axis.name for axis in read.axes}) == len(read.axes)


@pytest.mark.parametrize("limit", [2.0, 37.0, 99.0])
def test_a_border_is_enclosed(limit):
    found = border_at(limit)
    assert found.holds <= limit < found.fails
    assert found.fails / found.holds < 1.02
    assert found.kind == judge.BLOW_UP


def test_an_axis_that_holds_to_its_end_has_no_border():
    found = border_at(1000.0)
    assert (found.holds, found.fails) == (100.0, None)


def test_a_nominal_value_that_fails_is_said():
    found = border_at(0.5)
    assert (found.holds, found.fails) == (None, 1.0)


def test_given_values_are_the_only_ones_tried():
    axis = table.Axis("a", AXIS.scene, "-", 1.0, ["k={}"], 1.0, 16.0, values=[1.0, 2.0, 4.0, 8.0, 16.0])
    found = border_at(5.0, axis, 16.0)
    assert (found.holds, found.fails) == (4.0, 8.0)
    assert all(value in axis.values for value, _, _ in found.tried)


def record(kind="finished", reason="", warnings=()):
    return {"steps": 10, "core_seconds": 0.1, "exit": {"kind": kind, "reason": reason}, "warnings": list(warnings)}


def test_a_run_that_ends_with_a_warning_does_not_hold():
    warning = {"monitor": "liquid volume", "value": 1e-3, "limit": 1e-5}
    assert judge.Runner.classify(record(warnings=[warning]), ()).kind == judge.DETECTED
    assert "liquid volume" in judge.Runner.classify(record(warnings=[warning]), ()).why
    assert judge.Runner.classify(record(warnings=[warning]), ["liquid volume"]).holds
    assert judge.Runner.classify(record(), ()).holds


def test_failures_are_told_apart():
    assert judge.Runner.classify(record("step collapse", "the u is not finite, says who?"), ()).kind == judge.COLLAPSE
    assert judge.Runner.classify(record("not finite", "step collapse"), ()).kind == judge.BLOW_UP
    assert judge.Runner.classify(record("alarm", "step collapse"), ()).kind == judge.BLOW_UP


def test_curves_are_compared_at_common_times():
    a = [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]
    assert judge.distance(a, [(0.0, 0.0), (2.0, 2.0)]) == pytest.approx(0.0)
    assert judge.distance(a, [(0.0, 0.0), (1.0, 1.5), (2.0, 2.0)]) == pytest.approx(0.5)
    assert judge.distance(a, []) == float("inf")


FAKE = """#!/usr/bin/python3
# Stands in for granvof: finishes, and moves by as much as its step is wrong.
import json, pathlib, sys
arguments = sys.argv
out = pathlib.Path(arguments[arguments.index("--out") + 1])
sets = dict(arguments[i + 1].split("=", 1) for i, a in enumerate(arguments) if a == "--set")
out.mkdir(parents=True, exist_ok=True)
cfl = float(sets.get("numerics.cfl", 0.4))
error = float(sets.get("k", 0)) * cfl
if "refused" in sets:
    print("k: got 7", file=sys.stderr)
    sys.exit(2)
while "forever" in sets:
    pass
(out / "series.csv").write_text(f"time [s],y_solid_mean [m]\\n0,1\\n1,{1 + error}\\n")
(out / "run.json").write_text(json.dumps({"steps": 1, "core_seconds": 0.0, "warnings": json.loads(sets.get("warnings", "[]")),
    "exit": {"state": "finished", "kind": "finished", "reason": ""}, "resolved_case": f"[numerics]\\ncfl = {cfl}\\ndt_max = 1\\n"}))
"""


@pytest.fixture
def solver(tmp_path):
    path = tmp_path / "granvof"
    path.write_text(FAKE)
    path.chmod(0o755)
    return path


@pytest.fixture
def runner(solver, tmp_path, compare):
    with Engine(compare, solver) as engine:
        yield judge.Runner(engine, tmp_path, 20, keep=False)


@pytest.fixture
def scene(tmp_path):
    return table.SceneEntry("s", tmp_path / "s.toml", {"y_solid_mean": 0.01})


def test_a_wrong_answer_without_a_warning_is_found_at_half_the_step(runner, scene):
    assert runner.judge(scene, ["k=0.01"], "good").holds
    wrong = runner.judge(scene, ["k=1"], "wrong")
    assert wrong.kind == judge.UNDETECTED
    assert "y_solid_mean" in wrong.why
    assert runner.runs == 4


def test_what_depends_on_the_step_and_is_warned_of_is_detected(runner, scene):
    warned = ['warnings=[{"monitor": "elastic start", "value": 2, "limit": 1}]']
    assert runner.judge(scene, ["k=0.01"] + warned, "same", ["elastic start"]).holds
    assert runner.judge(scene, ["k=1"] + warned, "moved", ["elastic start"]).kind == judge.DETECTED


def test_a_run_beyond_its_core_seconds_counts_as_failed(runner, scene):
    runner.limit = 1
    found = runner.judge(scene, ["forever=1"], "endless")
    assert found.kind == judge.COLLAPSE and "1 core-s" in found.why


def test_a_case_that_is_refused_is_an_error_of_the_table(runner, scene):
    with pytest.raises(RuntimeError, match="endless: k: got 7"):
        runner.judge(scene, ["refused=1"], "endless")


@pytest.mark.parametrize("text, said", [
    ("[[axis]]\nname = 'a'\nscene = 'x'\nnominal = 1\nassign = []\nhigh = 2", "scene x given"),
    ("[scene.s]\ncase = 'nowhere.toml'\ncompare = {}", "there is no"),
    ("wrong = 1", "unknown key wrong"),
    ("[scene.s]\ncase = 't.toml'\ncompare = {}\n[[axis]]\nname = 'a'\nscene = 's'\nnominal = 1\nassign = []\nhigh = 0.5", "ascend"),
    ("[scene.s]\ncase = 't.toml'\ncompare = {}\n[[axis]]\nname = 'a'\nscene = 's'\nnominal = 1\nassign = []", "neither"),
])
def test_a_bad_table_is_refused(tmp_path, text, said):
    path = tmp_path / "t.toml"
    path.write_text(text)
    with pytest.raises(table.TableError, match=said):
        table.read(path)


def test_a_map_is_a_section_of_the_report(tmp_path):
    border = {"end": 0.629, "holds": 0.6, "fails": 0.61, "kind": judge.DETECTED, "why": "elastic start", "tried": []}
    axis = {"axis": "packing", "method": "limited", "unit": "-", "scale": "linear", "nominal": 0.57, "note": "",
            "borders": [border, border | {"end": 0.5, "holds": 0.5, "fails": None, "kind": None, "why": ""}]}
    result = {"date": "2026-01-02T00:00:00+00:00", "commit": "0.1.0 (abc)", "runs": 3, "core_seconds": 2.0, "axes": [axis],
              "points": [{"point": "no gas", "method": "limited", "kind": judge.HOLDS, "why": ""}]}
    (tmp_path / "stability").mkdir()
    (tmp_path / "stability/stability.json").write_text(json.dumps(result | program.section(result)))
    (shown,) = sections.read_all(tmp_path)
    rows = shown.tables[0]["rows"]
    assert rows[0][3] == "0.6" and "elastic start" in rows[0][4]
    assert rows[1][4] == "-" and rows[2][3] == "holds"
    assert "abc" in shown.made


def test_the_map_is_drawn(tmp_path):
    entry = {"axis": "packing", "method": "first order", "unit": "-", "scale": "linear", "nominal": 0.57, "borders": [
        {"end": 0.629, "holds": 0.6, "fails": 0.61, "kind": "wrong answer, detected", "why": "x"}]}
    other = entry | {"method": "limited", "borders": [{"end": 0.629, "holds": None, "fails": 0.57, "kind": "blow-up", "why": ""}]}
    verify = tmp_path / "verify"
    (tmp_path / "stability").mkdir()
    (tmp_path / "stability/stability.json").write_text(json.dumps({"axes": [entry, other]}))
    assert stability.map_plot(stability.load(verify), tmp_path) == ["stability-map"]
    assert (tmp_path / "stability-map.pdf").exists()
    assert stability.load(tmp_path / "elsewhere/verify") is None
