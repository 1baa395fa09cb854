"""The kinds of faults. Each takes the bench and an entry of the table, and yields (name of the try, why it is not held); the
second is empty where it is."""

import contextlib
import os
import resource
import shutil

from faults_tried import again, caches, checkpoints, damage, directories, evidence, exchanged, fields_of_others, hostile, interrupted, moments, mounts, orders, orphans, ranks, reading, reference_runs, scarce, scripts, surroundings, threads
from faults_tried.bench import PATIENCE, SAMPLE, NotTried, TableError, listed, refused
from faults_tried.runs import crashed


PROGRAMS = ("solver/granvof", "compare/granvof-compare", "reference/demvof/demvof")


def bad_values(bench, entry):
    """A key that takes no such value: refused, and nothing written."""
    tries = [(key, value) for key in entry["keys"] for value in entry["values"]]
    for key, value in bench.some(tries):
        out = bench.place() / "run"
        ended = bench.call([bench.granvof, "run", entry["case"], "--set", f"{key}={value}", "--out", out], patience=10)
        yield f"{entry['case']}: {key}={value!r}", refused(ended) or ("something was written" if out.exists() else "")


def contradictions(bench, entry):
    """What nobody means by a case: refused, or a warning names the key."""
    for given in bench.some(entry["given"]):
        sets = [word for one in given for word in ("--set", one)]
        ended = bench.call([bench.granvof, "check", entry["case"], *sets])
        said = ended.stderr.decode(errors="replace") if ended else ""
        tables = [one.split("=")[0].split(".")[0] for one in given]
        warnings = [line.partition("warning: ")[2] for line in said.splitlines()]
        warned = ended is not None and ended.returncode == 0 and any(line.startswith(tuple(tables)) for line in warnings if line)
        yield f"{entry['case']}: {', '.join(given)}"[:120], "" if warned else refused(ended)


def bad_files(bench, entry):
    """A file that a command reads, damaged: refused. Of a program that was not built there is nothing to try."""
    if "{demvof}" in entry["command"] and not bench.demvof.exists():
        return
    for name, way in bench.some(damage.of_entry(entry), entry.get("sample", SAMPLE)):
        place = bench.place()
        file = place / (bench.root / entry["of"]).name
        shutil.copy(bench.root / entry["of"], file)
        way(file, bench.chance)
        ended = bench.call(bench.filled(entry["command"], file=file, work=place))
        yield f"{' '.join(entry['command'][:2])} of {entry['of']}, {name}", refused(ended)


def no_programs(bench, entry):
    """A build folder in which a program that is needed is none: an error that is said."""
    tries = [(command, name, *way) for command in entry["commands"] for name in entry["programs"] for way in damage.of_entry(entry)]
    for command, name, how, way in bench.some(tries, entry["sample"]):
        place = bench.place()
        for program in PROGRAMS:
            (place / "build" / program).parent.mkdir(parents=True, exist_ok=True)
            if program != name:
                (place / "build" / program).symlink_to(bench.build / program)
        shutil.copy(bench.granvof, place / "build" / name)
        way(place / "build" / name, bench.chance)
        (place / "out").mkdir()
        ended = bench.call(bench.filled(command, programs=place / "build", work=place / "out"), patience=entry.get("patience", PATIENCE))
        yield f"{' '.join(command[:2])}, {name} {how}", not_said(ended)
        bench.drop(place / "any")


def not_said(ended):
    """As refused(); where a program has failed and no input is bad, exit code 1 will do."""
    if ended is None or ended.returncode != 1:
        return refused(ended)
    return "" if ended.stderr.strip() and b"Traceback" not in ended.stderr + ended.stdout else f"it says {ended.stderr[-150:]!r}"


@contextlib.contextmanager
def full_device(place):
    with open("/dev/full", "wb") as target:
        yield {"stdout": target}


@contextlib.contextmanager
def may_not_grow(place):
    with open(place / "said", "wb") as target:
        yield {"stdout": target, "preexec_fn": scarce.limit(resource.RLIMIT_FSIZE, 0)}


@contextlib.contextmanager
def nobody_reads(place):
    reads, writes = os.pipe()
    os.close(reads)
    with open(writes, "wb") as target:
        yield {"stdout": target}


@contextlib.contextmanager
def closed(place):
    yield {"preexec_fn": lambda: os.close(1)}


OUTPUTS = {"closed": closed, "/dev/full": full_device, "a file that may not grow": may_not_grow, "a pipe that nobody reads": nobody_reads}


def outputs(bench, entry):
    """Output that cannot be written: no success, which it is otherwise, and a line that says so; of a pipe none is needed."""
    for command in entry["commands"]:
        if "{demvof}" in command and not bench.demvof.exists():
            continue
        whole = bench.call(bench.filled(command))
        if whole is None or whole.returncode != 0:
            raise TableError(f"{' '.join(command)}: exit code {whole and whole.returncode} with an output that can be written")
        for name, opened in listed(entry, "stdouts", OUTPUTS):
            with opened(bench.place()) as options:
                ended = bench.call(bench.filled(command), **options)
            why = "" if ended is not None and ended.returncode != 0 else f"exit code {ended and ended.returncode}"
            if not why and name != "a pipe that nobody reads":
                why = crashed(ended)
            if not why and b"Traceback" in ended.stderr:
                why = "a traceback"
            yield f"{' '.join(command[:2])} > {name}", why


def made_locales(bench, names):
    """A folder with these locales: a name that is not installed would stand for C and try nothing."""
    folder = bench.place()
    for name in names:
        language, charset = name.split(".")
        made = shutil.which("localedef") and bench.call(["localedef", "-i", language, "-f", charset, folder / name])
        if not made or not (folder / name).is_dir():
            raise NotTried(f"the locale {name} cannot be made (package locales)")
    return folder


def locales(bench, entry):
    """The same output in every locale."""
    plain = bench.call(bench.filled(entry["command"]), environment={"LC_ALL": "C"})
    folder = made_locales(bench, [name for name in entry["locales"] if "." in name])
    for locale in entry["locales"]:
        environment = {"LC_ALL": locale, "LANG": locale, "LOCPATH": str(folder)}
        ended = bench.call(bench.filled(entry["command"]), environment=environment)
        same = ended is not None and (ended.returncode, ended.stdout) == (plain.returncode, plain.stdout)
        yield f"{' '.join(entry['command'][:2])} in {locale}", "" if same and plain.returncode == 0 else "another output"


KINDS = {kind.__name__: kind for kind in (
    bad_values, contradictions, bad_files, no_programs, evidence.damaged_runs, evidence.damaged_records, evidence.damaged_reads, interrupted.kills, interrupted.kills_at_calls,
    interrupted.failing_calls, interrupted.signals_at_calls, interrupted.swaps_at_calls, ranks.signals_to_ranks, reading.failing_reads, reading.full_outputs, scarce.full_disks, mounts.full_tmpfs, mounts.read_only, scarce.limits, scarce.closed_streams,
    directories.two_in_one, directories.foreign, directories.damaged_resumes, directories.changed_keys, checkpoints.odd_checkpoints, moments.moments, hostile.hostile,
    hostile.odd_cases, hostile.own_files, orders.orders, orphans.orphans, orphans.ended_children, again.begun_again, caches.damaged_caches, exchanged.exchanged, fields_of_others.fields_of_others, reference_runs.reference_runs, scripts.scripts, surroundings.surroundings, surroundings.refusals, outputs, locales, scarce.long_runs, threads.thread_sanitizer)}
