"""What is odd about the surroundings of a run: its environment, mask, folder, user, clock and limits."""

import errno
import os
import resource
import shutil
import signal

from faults_tried.bench import NotTried, listed, refused
from faults_tried.runs import SmallRun, crashed, not_refused, stopped_once, tree_of

NOBODY = 65534


def same(run, place, ended):
    if ended is None or ended.returncode != 0:
        return crashed(ended) or f"exit code {ended.returncode}: {ended.stderr.decode(errors='replace')[-150:]!r}"
    return run.same_bytes(place / "run")


def with_environment(**given):
    return lambda bench, run, place: same(run, place, run.go(place / "run", environment=given))


def no_environment(bench, run, place):
    return same(run, place, bench.call(["/usr/bin/env", "-i", *run.command(place / "run")], patience=600))


def with_mask(mask):
    """Where its own files must not be read by their owner it may fail, and says so; it then goes on with another mask."""
    def one(bench, run, place):
        ended = run.go(place / "run", preexec_fn=lambda: os.umask(mask))
        why = crashed(ended)
        if why or ended.returncode == 0:
            return why or run.same_bytes(place / "run")
        return ""
    return one


def its_folder_is_gone(bench, run, place):
    """Where it works from; all of its paths are absolute."""
    gone = place / "gone"
    gone.mkdir()
    command = [str(bench.root / word) if word == run.entry["case"] else word for word in run.command(place / "run")]
    shell = 'cd "$1" && rmdir "$1" && shift && exec "$@"'
    return same(run, place, bench.call(["/bin/sh", "-c", shell, "sh", str(gone), *command], patience=600))


def a_clock_that_goes_back(bench, run, place):
    return same(run, place, run.go(place / "run", environment=bench.shimmed(FAULT_CLOCK="1")))


def as_nobody(bench, run, out, *words, **options):
    if os.geteuid() != 0:
        raise NotTried("another user can be tried by root alone")
    closed = next((above for above in bench.granvof.resolve().parents if not above.stat().st_mode & 0o001), None)
    if closed is not None:
        raise NotTried(f"another user does not reach the program: {closed} is closed to others")
    bench.work.chmod(0o755)
    return run.go(out, *words, user=NOBODY, group=NOBODY, extra_groups=[], **options)


def a_folder_of_another_user(bench, run, place):
    return not_refused(as_nobody(bench, run, place / "run"), tree_of(place), place)


def a_run_of_another_user(bench, run, place):
    out = run.partial(place)
    before = tree_of(out)
    return not_refused(as_nobody(bench, run, out, "--resume"), before, out)


def a_file_of_another_user(bench, run, place):
    """Of a run of one's own one file must not be read."""
    out = run.partial(place)
    for path in (out, *out.rglob("*")):
        os.chown(path, NOBODY, NOBODY)
    os.chown(out / "checkpoint.h5", 0, 0)
    (out / "checkpoint.h5").chmod(0o600)
    return refused(as_nobody(bench, run, out, "--resume"))


def one_process_alone(bench, run, place):
    """No other can be made: the instants are not joined, or it is said."""
    place.chmod(0o777)
    ended = as_nobody(bench, run, place / "run", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NPROC, (1, 1)))
    return crashed(ended) or run.why_not_whole(place / "run")


def signals_that_are_blocked(bench, run, place):
    """As a careless parent leaves them: it runs, and it ends when it is asked to."""
    def block():
        signal.pthread_sigmask(signal.SIG_BLOCK, set(signal.Signals) - {signal.SIGKILL, signal.SIGSTOP})

    why = same(run, place, run.go(place / "run", preexec_fn=block))
    running = run.start(place / "other", preexec_fn=block)
    if why or not stopped_once(running, (place / "other/checkpoint.h5").exists):
        running.kill()
        return why or "it had ended before the signal"
    running.send_signal(signal.SIGTERM)
    running.send_signal(signal.SIGCONT)
    return "" if running.wait() == 1 else f"SIGTERM, and exit code {running.returncode}"


def children_that_are_not_waited_for(bench, run, place):
    """SIGCHLD ignored by the parent, and inherited: the end of a process of one's own is then not told."""
    return same(run, place, run.go(place / "run", preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN)))


def no_locks(bench, run, place):
    """A file system that has none: two runs could write at once, so it is refused; what only reads needs none."""
    without = bench.shimmed(FAULT_LOCK=str(errno.ENOLCK))
    if why := refused(run.go(place / "run", environment=without)):
        return why
    sets = [word for given in run.entry["set"] for word in ("--set", given)]
    ended = bench.call([bench.compare, "extract", "--scene", "canary", *sets, "--fields", run.whole / "fields.h5", "--out", place / "series.csv"],
                       environment=without)
    if ended is None or ended.returncode != 0:
        return f"extract: exit code {ended and ended.returncode}: {ended and ended.stderr[-150:]!r}"
    ended = bench.call(["/usr/bin/python3", "ci/faults_tried/load.py", run.whole], environment=without)
    return "" if ended is not None and ended.returncode == 0 else f"load: exit code {ended and ended.returncode}: {ended and ended.stderr[-150:]!r}"


TRIES = {
    "no environment": no_environment,
    "no home": with_environment(HOME="/nothing/there"),
    "no place for temporary files": with_environment(TMPDIR="/nothing/there"),
    "a terminal that is none": with_environment(TERM="nonsense", COLUMNS="-1", NO_COLOR="1"),
    "a number of threads that is none": with_environment(OMP_NUM_THREADS="many"),
    "more threads than asked for": with_environment(OMP_NUM_THREADS="7", OMP_DYNAMIC="true", OMP_NESTED="true"),
    "a stack for threads that is none": with_environment(OMP_STACKSIZE="1B"),
    "links looked for elsewhere": with_environment(HDF5_EXT_PREFIX="/nothing/there", HDF5_PLUGIN_PATH="/nothing/there"),
    "no locks of HDF5": with_environment(HDF5_USE_FILE_LOCKING="FALSE"),
    "locks of HDF5 that are none": with_environment(HDF5_USE_FILE_LOCKING="nonsense"),
    "locks of HDF5 where they can be": with_environment(HDF5_USE_FILE_LOCKING="BEST_EFFORT"),
    "a file system without locks": no_locks,
    "a home that is a device": with_environment(HOME="/dev/null", XDG_CACHE_HOME="/proc"),
    "a path with nothing on it": with_environment(PATH="/nothing"),
    "a device for temporary files": with_environment(TMPDIR="/dev/null"),
    "a mask of 077": with_mask(0o077),
    "a mask of 777": with_mask(0o777),
    "its folder is gone": its_folder_is_gone,
    "a clock that goes back": a_clock_that_goes_back,
    "a folder of another user": a_folder_of_another_user,
    "a run of another user": a_run_of_another_user,
    "a file of another user": a_file_of_another_user,
    "one process alone": one_process_alone,
    "signals that are blocked": signals_that_are_blocked,
    "children that are not waited for": children_that_are_not_waited_for,
}


def surroundings(bench, entry):
    """Odd surroundings: the same files, or an error that is said."""
    run = SmallRun(bench, entry)
    for name, attempt in bench.some(listed(entry, "tries", TRIES), entry["sample"]):
        place = bench.place()
        yield name, attempt(bench, run, place)
        shutil.rmtree(place, ignore_errors=True)


def refusals(bench, entry):
    """What no program takes: refused with a short message in which nothing steers a terminal, and nothing written."""
    commands = [command for command in entry["commands"] if bench.demvof.exists() or "{demvof}" not in command]
    tries = [(command, one) for command in commands for one in entry["given"]]
    for command, one in bench.some(tries, entry["sample"]):
        place = bench.place()
        given = [part.replace("GIVEN", one) for part in bench.filled(command, work=place)]
        yield (f"{' '.join(command[:2])}: {one or ' '.join(command[2:])!r}"[:120],
               refused(bench.call(given)) or ("something was written" if any(place.iterdir()) else ""))
        shutil.rmtree(place, ignore_errors=True)
