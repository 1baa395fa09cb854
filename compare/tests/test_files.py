"""What is no file is not opened: by no reader of ours, and not through a link inside an HDF5 file either."""

import os
import signal
import stat
import subprocess
import sys
import threading
from pathlib import Path

import h5py
import numpy as np
import pytest

import granvof
import granvof_files
from border import table
from lay import from_openfoam, from_vtk, their_series
from report import results, sections


def directory(path):
    path.mkdir()


def pipe(path):
    os.mkfifo(path)


def endless(path):
    path.symlink_to("/dev/zero")


def bound(path):
    os.mknod(path, stat.S_IFSOCK | 0o600)


def to_nothing(path):
    path.symlink_to(path.with_name("nothing"))


def to_itself(path):
    path.symlink_to(path.name)


NOT_FILES = [directory, pipe, endless, bound, to_nothing, to_itself]


@pytest.fixture(autouse=True)
def patience():
    """A reader that waits for a pipe waits for ever."""
    def waited(*_):
        pytest.fail("it waited")

    signal.signal(signal.SIGALRM, waited)
    signal.alarm(20)
    yield
    signal.alarm(0)


@pytest.mark.parametrize("kind", NOT_FILES)
@pytest.mark.parametrize("name", ["series.csv", "run.json", "fields.h5"])
def test_a_run_of_which_a_file_is_none(small_run, name, kind):
    (small_run / name).unlink()
    kind(small_run / name)
    with pytest.raises(granvof.NotARun, match=name):
        granvof.load(small_run)


@pytest.mark.parametrize("kind", NOT_FILES)
def test_other_readers(tmp_path, kind):
    path = tmp_path / "given"
    kind(path)
    with pytest.raises(results.Damaged):
        results.read_json(path)
    with pytest.raises(their_series.SeriesError):
        their_series.read(path, {})
    with pytest.raises(table.TableError):
        table.read(path)
    with pytest.raises(OSError):
        from_openfoam.read_field(path, np.array([1, 1, 1]), 1)
    path.rename(tmp_path / "given.pvd")
    with pytest.raises(from_vtk.CaseError):
        from_vtk.convert(tmp_path / "given.pvd", tmp_path / "theirs.h5")
    (tmp_path / "given.pvd").rename(path)
    (tmp_path / "charts").mkdir()
    kind(tmp_path / "charts/charts.json")
    with pytest.raises(results.Damaged):
        sections.read(tmp_path / "charts")


def instants_of(run):
    return list(results.instants({"directory": str(run)}))


def test_the_fields_of_a_run_that_goes_on(linked_run):
    assert list(np.asarray(granvof.load(linked_run).fields["time"])) == [0.0] and len(instants_of(linked_run)) == 1


@pytest.mark.parametrize("kind", NOT_FILES)
def test_a_link_to_what_is_no_file(linked_run, kind):
    (linked_run / "fields/t0000.h5").unlink()
    kind(linked_run / "fields/t0000.h5")
    with pytest.raises(granvof.NotARun):
        granvof.load(linked_run)
    with pytest.raises(results.Damaged):
        instants_of(linked_run)


def a_link(group, name, path):
    group[name] = h5py.ExternalLink(path, "/x")


def a_link_through_another_group(group, name, path):
    group["between"] = h5py.ExternalLink(path, "/x")
    group[name] = h5py.SoftLink("between/x")


def values_beside(group, name, path):
    group.create_dataset(name, (2, 3, 4), "f8", external=[(path, 0, h5py.h5f.UNLIMITED)])


def virtual(group, name, path):
    layout = h5py.VirtualLayout((2, 3, 4), "f8")
    layout[:] = h5py.VirtualSource(path, "x", (2, 3, 4))
    group.create_virtual_dataset(name, layout)


@pytest.mark.parametrize("make", [a_link, a_link_through_another_group, values_beside, virtual])
def test_values_that_lie_elsewhere(small_run, tmp_path, make):
    os.mkfifo(tmp_path / "pipe")
    with h5py.File(small_run / "fields.h5", "a") as file:
        del file["t0000/f_s"]
        make(file["t0000"], "f_s", str(tmp_path / "pipe"))
    with pytest.raises(granvof.NotARun):
        granvof.load(small_run)
    with pytest.raises(results.Damaged):
        instants_of(small_run)


def test_a_link_out_of_the_folder(small_run, relink):
    relink(small_run, "../run/fields.h5")
    with pytest.raises(granvof.NotARun, match="links to"):
        granvof.load(small_run)


def test_a_file_is_one_through_a_link_too(tmp_path):
    (tmp_path / "a").write_text("x")
    (tmp_path / "b").symlink_to("a")
    assert granvof_files.required(tmp_path / "b").read_text() == "x"


def test_what_is_written_is_whole_or_as_before(tmp_path):
    path = tmp_path / "made" / "report.html"
    granvof_files.write_whole(path, "before")
    assert path.read_text() == "before"
    ended = subprocess.run([sys.executable, "-c", f"""
import resource, signal, sys
sys.path.insert(0, {str(Path(granvof_files.__file__).parent)!r})
import granvof_files
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
try:
    granvof_files.write_whole({str(path)!r}, "x" * 2000)
except OSError:
    sys.exit(7)
"""], check=False)
    assert ended.returncode == 7
    assert path.read_text() == "before"
    assert list(path.parent.iterdir()) == [path]


@pytest.mark.parametrize("make", [directory, pipe, endless])
def test_nothing_else_than_a_file_is_replaced(tmp_path, make):
    path = tmp_path / "results.json"
    make(path)
    with pytest.raises(OSError):
        granvof_files.write_json(path, {})
    assert list(tmp_path.iterdir()) == [path]


def test_a_pipe_that_takes_a_files_name_meanwhile(tmp_path):
    """Whatever the moment: what was opened is asked what it is, and nobody is waited for."""
    path, stop = tmp_path / "given", threading.Event()

    def swap():
        while not stop.is_set():
            for put in (lambda draft: draft.write_text("{}"), os.mkfifo):
                put(tmp_path / "draft")
                os.replace(tmp_path / "draft", path)

    path.write_text("{}")
    swapping = threading.Thread(target=swap)
    swapping.start()
    ends = set()
    try:
        for _ in range(3000):
            try:
                ends.add(granvof_files.text_of(path))
            except granvof_files.NotAFile:
                ends.add("refused")
    finally:
        stop.set()
        swapping.join()
    assert ends == {"{}", "refused"}


def test_a_file_with_holes_that_no_memory_holds(tmp_path):
    path = tmp_path / "given"
    path.write_text("{}")
    os.truncate(path, 1 << 40)
    for reader in (granvof_files.text_of, granvof_files.bytes_of, granvof_files.json_of, granvof_files.opened):
        with pytest.raises(granvof_files.NotAFile, match="1099511627776 bytes"):
            reader(path)
