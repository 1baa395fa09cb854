"""Files of the right kind whose content nobody means: too deep, of other types and shapes, no names. Every reader refuses them with
the error it has for that, which is one line."""

import json
import sys

import h5py
import numpy as np
import pytest

import granvof
import granvof_files
from border import table
from report import of_a_run, results, sections

DEPTH = 100_000
DEEP_JSON = {"arrays": "[" * DEPTH + "]" * DEPTH, "objects": '{"a":' * DEPTH + "1" + "}" * DEPTH}
DEEP_TOML = {"arrays": "a = " + "[" * DEPTH + "]" * DEPTH, "inline tables": "a = " + "{a = " * DEPTH + "1" + "}" * DEPTH,
             "a key": "a" + ".a" * DEPTH + " = 1", "a header": "[a" + ".a" * DEPTH + "]", "a key in quotes": '"a"' + '."a"' * DEPTH + " = 1",
             "a key with blanks": "a" + " . a" * DEPTH + " = 1"}


def refused(error, read, *given):
    with pytest.raises(error) as said:
        read(*given)
    assert len(str(said.value)) < 1000 and "\n" not in str(said.value)


def put(path, text):
    path.write_text(text)
    return path


@pytest.mark.parametrize("text", DEEP_JSON.values(), ids=DEEP_JSON)
def test_json_that_is_too_deep(tmp_path, text):
    refused(ValueError, granvof_files.json_of, put(tmp_path / "run.json", text))
    refused(results.Damaged, results.read_json, tmp_path / "run.json")
    refused(granvof.NotARun, granvof.read_facts, tmp_path / "run.json")
    (tmp_path / "charts").mkdir()
    put(tmp_path / "charts/charts.json", text)
    refused(results.Damaged, sections.read, tmp_path / "charts")


@pytest.mark.parametrize("text", DEEP_TOML.values(), ids=DEEP_TOML)
def test_toml_that_is_too_deep(tmp_path, text):
    refused(ValueError, granvof_files.toml_of, put(tmp_path / "given.toml", text))
    refused(table.TableError, table.read, tmp_path / "given.toml")
    refused(granvof.NotARun, of_a_run.scene_of, {"resolved_case": text})


def test_a_key_may_be_as_deep_as_the_solver_takes_it():
    parts = granvof_files.MOST_KEY_PARTS
    assert granvof_files.toml_in("a" + ".a" * (parts - 1) + " = 1")
    refused(ValueError, granvof_files.toml_in, "a" + ".a" * parts + " = 1")


def test_fields_that_are_too_deep(small_run):
    with h5py.File(small_run / "fields.h5", "r+") as file:
        group = file
        for _ in range(sys.getrecursionlimit()):
            group = group.create_group("g")
    refused(granvof.NotARun, granvof.read_fields, small_run / "fields.h5")
    refused(results.Damaged, lambda: list(results.instants({"directory": small_run})))


def changed(name, value):
    def change(file):
        if name in file.attrs:
            file.attrs[name] = value
        elif name == "time":
            file["t0000"].attrs[name] = value
        else:
            del file["t0000"][name]
            file["t0000"][name] = value
    return change


def huge(file):
    """A whole number of bytes that no machine has, in a file of a few."""
    del file["t0000/f_s"]
    file["t0000"].create_dataset("f_s", shape=(10**6, 10**6, 10**6), chunks=(1, 1, 1000), dtype="f8")


def group(file):
    del file["t0000/f_s"]
    file["t0000"].create_group("f_s")


def twice(file):
    file.copy("t0000", "t0001")


ODD_FIELDS = {
    "huge": huge, "a group": group, "two of one time": twice, "times": changed("time", np.zeros(9)), "no time": changed("time", np.nan),
    "a word for a time": changed("time", "x"), "a word for cells": changed("cells", "x"), "one cell": changed("cells", np.array([4])),
    "cells below 0": changed("cells", np.array([-4, 3, 2])), "cells beyond all": changed("cells", np.array([2**62] * 3)),
    "other cells": changed("cells", np.array([4, 2, 3])), "one origin": changed("origin", np.array([0.0])),
    "no spacing": changed("spacing", np.zeros(3)), "spacing not a number": changed("spacing", np.full(3, np.nan)),
    "a title that is no text": changed("scene", np.bytes_(b"\xff")), "words": changed("f_s", np.array([b"abc"] * 24)),
    "one value": changed("f_s", 1.0), "nothing": changed("f_s", h5py.Empty("f8")), "complex": changed("f_s", np.zeros((2, 3, 4), complex)),
    "whole numbers": changed("f_s", np.zeros((2, 3, 4), int)), "compound": changed("f_s", np.zeros((2, 3, 4), [("a", "f8")])),
}


@pytest.mark.parametrize("change", ODD_FIELDS.values(), ids=ODD_FIELDS)
def test_fields_of_other_types_and_shapes(small_run, change):
    with h5py.File(small_run / "fields.h5", "r+") as file:
        change(file)
    refused(granvof.NotARun, granvof.read_fields, small_run / "fields.h5")


@pytest.mark.parametrize("change", [huge, group, changed("f_s", 1.0), changed("time", "x"), changed("f_s", np.zeros((2, 3, 4), complex))])
def test_instants_that_are_to_be_drawn(small_run, change):
    with h5py.File(small_run / "fields.h5", "r+") as file:
        change(file)
    refused(results.Damaged, lambda: list(results.instants({"directory": small_run})))


def test_a_series_with_a_cell_without_end(tmp_path):
    path = put(tmp_path / "series.csv", "time [s],front_dense [m]\n0,0." + "1" * 200_000 + "\n")
    refused(granvof.NotARun, granvof.read_series, path)


ODD = [None, "x", "", [], {}, -1, float("inf"), float("nan"), 10**400, True, [None], "../x", "\ud800"]


@pytest.mark.parametrize("key", ["scene", "title", "resolved_case", "grid", "grid.cells", "grid.spacing", "exit", "exit.state", "warnings",
                                 "host", "case_hash", "version"])
def test_a_record_of_other_types_is_shown_or_refused(run_to_show, monkeypatch, key):
    facts = json.loads((run_to_show / "run.json").read_text())
    monkeypatch.setattr(of_a_run, "series_plots", lambda *_: [])  # of nothing that is tried here
    monkeypatch.setattr(of_a_run, "film", lambda *_: None)
    for draw in ("snapshot_plot", "plan_plot"):
        monkeypatch.setattr(of_a_run.snapshots, draw, lambda *_: [])
    monkeypatch.setattr(of_a_run.states, "state_plot", lambda *_: [])
    for value in ODD:
        table, _, last = key.rpartition(".")
        odd = facts | ({table: facts[table] | {last: value}} if table else {key: value})
        put(run_to_show / "run.json", json.dumps(odd))
        try:
            page = of_a_run.show(run_to_show)
        except granvof.NotARun as said:
            assert "\n" not in str(said)
            continue
        assert page == run_to_show / "report/report.html" and page.read_text().rstrip().endswith("</html>")
