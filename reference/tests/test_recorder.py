"""Plan, state and making of records, without running demvof."""
import json
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

REFERENCE = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(REFERENCE))
import recorder  # noqa: E402

RUN = recorder.Run("s1", 2)


def finished_run(folder, exit_state="finished", command="demvof run cases/s1.toml --gate-closed"):
    folder.mkdir()
    (folder / "series.csv").write_text("time [s],slope [deg]\n0,\n1,0.33333333333333331\n")
    (folder / "run.json").write_text(json.dumps({"program": "demvof", "scene": "s1", "case_hash": "solver's",
                                               "command": command, "monitors": {"seed": 2.0}, "exit": {"state": exit_state, "reason": "at t = 3"}}))
    with h5py.File(folder / "fields.h5", "w") as file:
        file.attrs["scene"] = "s1"
        for n in range(9):
            group = file.create_group(f"t{n:04}")
            group.attrs["time"] = float(n)
            for field in ("f_s", "alpha", "p_c", "u_c"):
                group[field] = np.full((1, 4, 5), n, dtype="f8")
    state_what_was_written(folder)
    return folder


def state_what_was_written(folder):
    path = folder / "run.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"files": recorder.stated_files(folder)}))


def test_a_run_whose_files_are_not_those_it_wrote_is_no_record(tmp_path):
    for number, name in enumerate(("series.csv", "fields.h5")):
        run = finished_run(tmp_path / f"run{number}")
        (run / name).write_bytes((run / name).read_bytes()[:-9])
        with pytest.raises(recorder.RecordError, match=f"{name} (cannot be read|is cut|is not the file)"):
            recorder.make_record(RUN, run, "abc", tmp_path)
    silent = finished_run(tmp_path / "silent")
    facts = json.loads((silent / "run.json").read_text())
    del facts["files"]
    (silent / "run.json").write_text(json.dumps(facts))
    with pytest.raises(recorder.RecordError, match="earlier version"):
        recorder.make_record(RUN, silent, "abc", tmp_path)
    assert recorder.state(RUN, "abc", tmp_path) == "missing"


def test_a_record_states_its_own_files(tmp_path):
    folder = recorder.make_record(RUN, finished_run(tmp_path / "run"), "abc", tmp_path)
    facts = json.loads((folder / "record.json").read_text())
    series = facts["files"]["series.csv"]
    assert (series["rows"], series["end"], series["columns"]) == (2, 1.0, ["time [s]", "slope [deg]"])
    assert facts["files"]["fields.h5"]["instants"] == recorder.INSTANTS_KEPT
    recorder.require_files(folder, facts)
    (folder / "series.csv").write_text("time [s],slope [deg]\n0,\n1,0.333333334\n")
    with pytest.raises(recorder.RecordError, match="series.csv is not the file that was written"):
        recorder.require_files(folder, facts)


def test_a_record_in_which_a_digit_was_changed_is_refused(tmp_path):
    folder = recorder.make_record(RUN, finished_run(tmp_path / "run"), "abc", tmp_path)
    path = folder / "record.json"
    whole = path.read_text()
    assert recorder.facts_of(path)["case_hash"] == "abc"
    for text in (whole.replace('"abc"', '"abd"'), json.dumps(json.loads(whole)), whole.replace('256": "', '256": "0')):
        path.write_text(text)
        with pytest.raises(recorder.RecordError, match="not what was written"):
            recorder.facts_of(path)


def test_a_record_of_an_earlier_version_is_completed_once_and_says_so(tmp_path):
    folder = recorder.make_record(RUN, finished_run(tmp_path / "run"), "abc", tmp_path)
    facts = json.loads((folder / "record.json").read_text())
    bare = {key: value for key, value in facts.items() if key not in ("files", "sha256")}
    (folder / "record.json").write_text(json.dumps(bare))
    assert recorder.state_files(folder) and not recorder.state_files(folder)
    now = json.loads((folder / "record.json").read_text())
    assert now["files"] == facts["files"] and "afterwards" in now["files_stated"]
    (folder / "record.json").write_text(json.dumps({key: value for key, value in facts.items() if key != "sha256"}, indent=2) + "\n")
    assert recorder.state_files(folder) and json.loads((folder / "record.json").read_text()) == facts  # the seal alone


@pytest.mark.parametrize("record", sorted(recorder.RESULTS.glob("**/record.json")), ids=lambda path: str(path.parent.relative_to(recorder.RESULTS)))
def test_the_records_of_the_repository_are_whole(record):
    recorder.require_files(record.parent, recorder.facts_of(record))


@pytest.mark.parametrize("text", ["", "run = 3", "[[run]]\nscene = 's1'", "[[run]]\nseed = ", "\x00"])
def test_a_damaged_plan_is_one_line(tmp_path, text):
    (tmp_path / "plan.toml").write_text(text)
    with pytest.raises(recorder.RecordError) as refused:
        recorder.read_plan(tmp_path / "plan.toml")
    assert "\n" not in str(refused.value)
    with pytest.raises(recorder.RecordError):
        recorder.read_plan(tmp_path)


def test_the_plan_names_scenes_that_exist():
    for run in recorder.read_plan():
        assert (REFERENCE.parent / f"cases/{run.scene}.toml").exists(), run


def test_an_unknown_scene_is_refused_by_name():
    with pytest.raises(recorder.RecordError, match="no scene 'nowhere'"):
        recorder.select(recorder.read_plan(), ["nowhere"])


def test_missing_stale_and_current(tmp_path):
    assert recorder.state(RUN, "abc", tmp_path) == "missing"
    recorder.make_record(RUN, finished_run(tmp_path / "run"), "abc", tmp_path)
    assert recorder.state(RUN, "abc", tmp_path) == "current"
    assert recorder.state(RUN, "another", tmp_path) == "stale"


def test_a_record_keeps_four_instants_and_says_where_it_comes_from(tmp_path):
    folder = recorder.make_record(RUN, finished_run(tmp_path / "run"), "abc", tmp_path)
    assert folder == tmp_path / "s1/seed2"
    with h5py.File(folder / "fields.h5") as file:
        assert sorted(file) == ["t0000", "t0001", "t0002", "t0003"]  # numbered in a row, as every reader expects
        assert [file[name].attrs["time"] for name in sorted(file)] == [0.0, 3.0, 5.0, 8.0]
        assert np.all(file["t0002/f_s"][()] == 5.0)
        assert sorted(file["t0002"]) == sorted(recorder.FIELDS_KEPT)
        assert file.attrs["scene"] == "s1"
    assert (folder / "series.csv").read_text() == "time [s],slope [deg]\n0,\n1,0.333333333\n"
    record = json.loads((folder / "record.json").read_text())
    assert (record["case_hash"], record["seed"], record["gate_closed"]) == ("abc", 2, False)
    assert set(record["parts"]) == set(recorder.PACKAGES)


def test_a_record_of_an_earlier_version_is_slimmed_once_and_keeps_its_provenance(tmp_path):
    folder = recorder.make_record(RUN, finished_run(tmp_path / "run"), "abc", tmp_path)
    slim = {path.name: path.read_bytes() for path in folder.iterdir()}
    for name in ("series.csv", "fields.h5"):
        (folder / name).write_bytes((tmp_path / "run" / name).read_bytes())
    facts = json.loads(slim["record.json"]) | {"files": recorder.stated_files(folder)}
    recorder.write_sealed(folder / "record.json", facts)
    assert recorder.slim_record(folder)
    assert (folder / "series.csv").read_bytes() == slim["series.csv"]
    was, now = json.loads(slim["record.json"]), json.loads((folder / "record.json").read_text())
    recorder.require_files(folder, now)
    del was["sha256"], now["sha256"], was["files"]["fields.h5"]["sha256"], now["files"]["fields.h5"]["sha256"]  # HDF5 writes the second of its making
    assert now == was
    with h5py.File(folder / "fields.h5") as file:
        assert len(file) == recorder.INSTANTS_KEPT and sorted(file["t0003"]) == sorted(recorder.FIELDS_KEPT)
    once = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert sorted(once) == sorted(slim)
    assert not recorder.slim_record(folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == once


def test_a_run_that_blew_up_leaves_no_record(tmp_path):
    with pytest.raises(recorder.RecordError, match="at t = 3"):
        recorder.make_record(RUN, finished_run(tmp_path / "run", "failed"), "abc", tmp_path)
    assert recorder.state(RUN, "abc", tmp_path) == "missing"


def test_a_run_directory_says_which_run_it_holds(tmp_path):
    assert recorder.run_of(finished_run(tmp_path / "run")) == (recorder.Run("s1", 2, True), "solver's")
    with pytest.raises(recorder.RecordError, match="run.json cannot be read"):
        recorder.run_of(tmp_path)


@pytest.mark.parametrize("scene", ["../../s1", "..", ".", "/tmp/s1", "a/b", "", "-x", "s1\n", "s1\x00", 3, None])
def test_a_scene_of_a_foreign_run_leads_out_of_nowhere(tmp_path, scene):
    directory = finished_run(tmp_path / "run")
    facts = json.loads((directory / "run.json").read_text()) | {"scene": scene}
    (directory / "run.json").write_text(json.dumps(facts))
    with pytest.raises(recorder.RecordError) as refused:
        recorder.run_of(directory)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"program": 1}', '{"program": "demvof", "command": 3}',
                                     '{"program": "demvof", "command": "", "scene": "s1", "monitors": []}'])
def test_a_foreign_run_that_is_damaged_is_one_line(tmp_path, content):
    (tmp_path / "run.json").write_text(content)
    with pytest.raises(recorder.RecordError) as refused:
        recorder.run_of(tmp_path)
    assert "\n" not in str(refused.value)


def test_control_runs_are_kept_apart(tmp_path):
    control = recorder.Run("s1-loose", 1, gate_closed=True)
    assert control.folder(tmp_path) == tmp_path / "controls/s1-loose/seed1"


def test_a_variant_is_kept_apart_and_found_again_by_its_overrides(tmp_path):
    coarse = recorder.Run("s1", 2, variant="coarse", set=["reference.cell=0.005"])
    assert coarse.folder(tmp_path) == tmp_path / "variants/coarse/s1/seed2"
    directory = finished_run(tmp_path / "run", command=coarse.command)
    assert recorder.run_of(directory, [recorder.Run("s1", 1), coarse]) == (coarse, "solver's")
    with pytest.raises(recorder.RecordError, match="no variant of s1 with reference.cell"):
        recorder.run_of(directory, [recorder.Run("s1", 1)])
    with pytest.raises(recorder.RecordError, match="both or neither"):
        recorder.Run("s1", 1, variant="nameless")


def test_a_chute_has_no_fields_and_its_own_place(tmp_path):
    chute = recorder.Run("s1", 1, chute=True)
    directory = finished_run(tmp_path / "run", command=chute.command)
    (directory / "fields.h5").unlink()
    state_what_was_written(directory)
    folder = recorder.make_record(chute, directory, "abc", tmp_path)
    assert folder == tmp_path / "bulk-friction/s1/seed1"
    assert json.loads((folder / "record.json").read_text())["command"].startswith("demvof chute")


def test_a_run_that_states_no_instants_has_no_fields(tmp_path):
    """As demvof writes it of a chute."""
    chute = recorder.Run("s1", 1, chute=True)
    directory = finished_run(tmp_path / "run", command=chute.command)
    (directory / "fields.h5").unlink()
    path = directory / "run.json"
    facts = json.loads(path.read_text())
    for instants, accepted in ((0, True), (3, False)):
        facts["files"]["fields.h5"] = {"instants": instants, "sha256": None}
        path.write_text(json.dumps(facts))
        if accepted:
            assert "fields.h5" not in json.loads((recorder.make_record(chute, directory, "abc", tmp_path) / "record.json").read_text())["files"]
        else:
            with pytest.raises(recorder.RecordError, match="fields.h5 is stated or there, not both"):
                recorder.make_record(chute, directory, "abc", tmp_path)


def test_an_end_that_the_series_rounds_is_its_end_and_another_is_not(tmp_path):
    for number, (end, accepted) in enumerate(((1.0 + 1e-9, True), (1.001, False))):
        run = finished_run(tmp_path / f"run{number}")
        path = run / "run.json"
        facts = json.loads(path.read_text())
        facts["files"]["series.csv"]["end"] = end
        path.write_text(json.dumps(facts))
        if accepted:
            recorder.make_record(RUN, run, "abc", tmp_path)
        else:
            with pytest.raises(recorder.RecordError, match="series.csv is not the file"):
                recorder.make_record(RUN, run, "abc", tmp_path)


def test_element_tests_have_no_fields_and_their_own_place(tmp_path):
    tests = recorder.Run("s1", 2, element=True)
    assert tests.arguments == ["element", "cases/s1.toml", "--seed", "2"]
    directory = finished_run(tmp_path / "run", command=tests.command)
    assert recorder.run_of(directory) == (tests, "solver's")
    (directory / "fields.h5").unlink()
    state_what_was_written(directory)
    assert recorder.make_record(tests, directory, "abc", tmp_path) == tmp_path / "element/s1/seed2"
    with pytest.raises(recorder.RecordError, match="a chute or element tests"):
        recorder.Run("s1", 1, chute=True, element=True)


def test_a_missing_program_is_an_error_that_says_what_to_do(tmp_path):
    ended = subprocess.run([REFERENCE / "record", "--build-dir", tmp_path], capture_output=True, text=True)
    assert ended.returncode == 2
    assert "ci/setup-reference" in ended.stderr
