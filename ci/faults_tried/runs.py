"""The run that faults are tried on: a case of the table, its command, what it writes, and whether two of them are equal."""

import os
import shutil
import signal
import stat
import subprocess
import time

import h5py

from faults_tried.bench import TableError, listed, refused, told_of_our_end

HUGE = 1 << 30  # bytes: a file that was grown to be, which none of a run's is


class SmallRun:
    """An entry's case with its overrides; `whole` is the directory of a run that was let alone."""

    def __init__(self, bench, entry):
        self.bench, self.entry = bench, entry
        self.whole = bench.place() / "run"
        ended = self.go(self.whole)
        if ended is None or ended.returncode != 0:
            said = ended.stderr.decode(errors="replace")[-200:] if ended else "no end"
            raise TableError(f"{entry['case']}: a run that is let alone does not end: {said.strip()}")

    def command(self, out, *words, sets=()):
        overrides = [word for given in (*self.entry.get("set", []), *sets) for word in ("--set", given)]
        return [str(word) for word in (self.bench.granvof, "run", self.entry["case"], *overrides, "--threads", "1",
                                       "--out", out, *words)]

    def go(self, out, *words, sets=(), **options):
        return self.bench.call(self.command(out, *words, sets=sets), **{"patience": 600.0, **options})

    def start(self, out, *words, command=None, environment=(), stderr=subprocess.DEVNULL, preexec_fn=None):
        return subprocess.Popen(command or self.command(out, *words), cwd=self.bench.root, stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=stderr, env={**os.environ, **dict(environment)},
                                preexec_fn=told_of_our_end(preexec_fn))

    def go_on(self, out):
        """Resumed where there is a run; begun anew where there is none."""
        return self.go(out, *(["--resume"] if (out / "run.json").exists() else []))

    def why_not_whole(self, out):
        """Goes on in `out`; why the files are not those of the whole run to the byte, empty where they are."""
        ended = self.go_on(out)
        if ended is None or ended.returncode != 0:
            return "it did not go on: " + (ended.stderr.decode(errors="replace").strip()[-200:] if ended else "no end")
        return self.same_bytes(out)

    def same_bytes(self, out):
        others = [name for name in ("series.csv", "fields.h5", "fields.xdmf")
                  if not (out / name).is_file() or (out / name).read_bytes() != (self.whole / name).read_bytes()]
        return "other bytes in " + ", ".join(others) if others else ""

    def partial(self, place):
        """A run that a signal stopped in the middle: with a checkpoint, and instants in files of their own."""
        source = self.bench.kept("partial " + str(self.entry), lambda target: self.stop_in_the_middle(target))
        return shutil.copytree(source, place / "run", symlinks=True)

    def stop_in_the_middle(self, target):
        calls = self.bench.calls_of(self)
        for number in (int(0.7 * calls), calls - 4):  # of some programs most calls come before their first file
            shutil.rmtree(target, ignore_errors=True)
            self.go(target, environment=self.bench.shimmed(FAULT_CALL=str(number)))
            if (target / "checkpoint.h5").exists() and (target / "fields").is_dir():
                return
        raise TableError(f"{self.entry['case']}: killed in its midst the run has left nothing to resume")


def stop(process):
    """Stops a process, and waits until it has: a signal takes its time, in which a file may come or go. False where the process
    had ended before."""
    process.send_signal(signal.SIGSTOP)
    return stops(process)


def stops(process):
    """Waits until a process has stopped, as it does itself or was told to; False where it ended instead."""
    return os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT).si_code == os.CLD_STOPPED


def stopped_once(process, begun):
    """Stops a process as soon as `begun()`; False where it ended before."""
    until = time.monotonic() + 60.0
    while not begun() and process.poll() is None and time.monotonic() < until:
        time.sleep(0.001)
    return process.poll() is None and stop(process)


def content_of(directory):
    """Rows to the byte; fields to the bit, joined in one file or not."""
    fields = {}
    with h5py.File(directory / "fields.h5") as file:
        for instant, group in file.items():
            fields[instant] = float(group.attrs["time"]), {name: group[name][()].tobytes() for name in group}
    return (directory / "series.csv").read_bytes(), fields


def same_content(one, other):
    try:
        return content_of(one) == content_of(other)
    except (OSError, KeyError):  # there is no series, or what is there is no HDF5
        return False


def tried_on_a_run(bench, entry, known):
    """Each of the tries that an entry lists, with the entry's run and a place of its own."""
    run = SmallRun(bench, entry)
    for name, attempt in bench.some(listed(entry, "tries", known), entry["sample"]):
        place = bench.place()
        yield name.replace("_", " "), attempt(bench, run, place)
        bench.drop(place / "any")


def tree_of(directory):
    """Every name below a directory, with the bytes of the files, of huge ones their number, and what else stands there."""
    def content(path):
        if not path.is_file():
            return stat.S_IFMT(path.lstat().st_mode)
        size = path.stat().st_size
        return path.read_bytes() if size < HUGE else size
    return {str(path.relative_to(directory)): content(path) for path in sorted(directory.rglob("*"))}


def not_refused(ended, before, directory):
    """Why this is no refusal that leaves a directory as it was."""
    if why := refused(ended):
        return why
    after = tree_of(directory)
    changed = sorted(name for name in before.keys() | after.keys() if before.get(name, 0) != after.get(name, 0))
    return "it changed " + ", ".join(changed) if changed else ""


def crashed(ended):
    """Why an end with an error is none that a user can do something with; empty where it is."""
    if ended is None:
        return "no end"
    said = ended.stderr.decode(errors="replace")
    if ended.returncode < 0:
        return f"ended by signal {-ended.returncode}: {said[-100:]!r}"
    if ended.returncode != 0 and not said.strip():
        return f"exit code {ended.returncode} without a word"
    return ""
