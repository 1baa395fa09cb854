"""Damaged files of the nightly run: one line, and never a clean night."""

import subprocess
from pathlib import Path

import pytest

from night import blessings, results
from night.history import History
from night.stages import StageRun

ROOT = Path(__file__).resolve().parent.parent.parent
HEADER = "date,commit,check,old,new,by,reason\n"


def refusal(read, path):
    with pytest.raises(ValueError) as refused:
        read(path)
    assert "\n" not in str(refused.value) and str(path) in str(refused.value)


def put(path, content):
    if content is None:
        path.mkdir()
    else:
        path.write_bytes(content)
    return path


@pytest.mark.parametrize("content", [None, b"", b"date\n", HEADER.encode() + b"1,2,3\n", b"\xff\xfe\x00"])
def test_damaged_blessings(tmp_path, content):
    refusal(blessings.read, put(tmp_path / "blessings.csv", content))


def test_no_blessings_are_none(tmp_path):
    assert blessings.read(tmp_path / "none.csv") == []
    assert blessings.read(put(tmp_path / "blessings.csv", HEADER.encode())) == []


@pytest.mark.parametrize("content", [None, b"", b"{", b"[]", b"{}", b'{"results": [], "runs": []}', b'{"results": [{}], "runs": []}'])
def test_damaged_results(tmp_path, content):
    refusal(results.read_verification, put(tmp_path / "results.json", content))


@pytest.mark.parametrize("content", [None, b"", b"[]", b'{"s1": 3}', b'{"s1": {"unit": "s", "value": "x"}}'])
def test_damaged_times(tmp_path, content):
    refusal(results.read_times, put(tmp_path / "times.json", content))


@pytest.mark.parametrize("content", [None, b"no database, but some text that is long enough to be one" * 20])
def test_damaged_history(tmp_path, content):
    refusal(History, put(tmp_path / "history.sqlite", content))


@pytest.mark.parametrize("content", [None, b"", b"[]", b'{"outcomes": [], "facts": {}, "finished": true}'])
def test_damaged_state(tmp_path, content):
    put(tmp_path / "state.json", content)
    with pytest.raises(ValueError, match="state.json cannot be read"):
        StageRun.load(tmp_path)


def test_bless_refuses_damaged_blessings_and_history(tmp_path):
    put(tmp_path / "history.sqlite", b"x" * 4096)
    done = subprocess.run([ROOT / "ci/bless", "a", "--reason", "it is right so now", "--history", tmp_path / "history.sqlite"],
                          capture_output=True, text=True)
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
