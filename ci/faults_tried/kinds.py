"""The kinds of faults. Each takes the bench and an entry of the table, and yields (name of the try, why it is not held); the
second is empty where it is."""

import json
import shutil

from faults_tried import damage, directories, interrupted, scarce
from faults_tried.bench import SAMPLE, TableError, refused


def bad_values(bench, entry):
    """A key that takes no such value: refused, and nothing written."""
    tries = [(key, value) for key in entry["keys"] for value in entry["values"]]
    for key, value in bench.some(tries):
        out = bench.place() / "run"
        ended = bench.call([bench.granvof, "run", entry["case"], "--set", f"{key}={value}", "--out", out], patience=10)
        yield f"{entry['case']}: {key}={value!r}", refused(ended) or ("something was written" if out.exists() else "")


def damages_of(entry):
    for name in entry["damages"]:
        if name not in damage.BY_NAME:
            raise TableError(f"damages: '{name}' given; known: {', '.join(damage.BY_NAME)}")
        yield name, damage.BY_NAME[name]


def bad_files(bench, entry):
    """A file that a command reads, damaged: refused. Of a program that was not built there is nothing to try."""
    if "{demvof}" in entry["command"] and not bench.demvof.exists():
        return
    for name, way in bench.some(damages_of(entry), entry.get("sample", SAMPLE)):
        place = bench.place()
        file = place / (bench.root / entry["of"]).name
        shutil.copy(bench.root / entry["of"], file)
        way(file, bench.chance)
        ended = bench.call(bench.filled(entry["command"], file=file, work=place))
        yield f"{' '.join(entry['command'][:2])} of {entry['of']}, {name}", refused(ended)


def run_once(bench, entry, out, **options):
    sets = [word for override in entry.get("set", []) for word in ("--set", override)]
    return bench.call([bench.granvof, "run", entry["case"], *sets, "--threads", "1", "--out", out], patience=600, **options)


def table_of(entry, place):
    """A table of checks with one row that every sound run of the case passes."""
    case = entry["case"].removeprefix("cases/").removesuffix(".toml")
    sets = json.dumps(entry.get("set", []))
    path = place / "checks.toml"
    path.write_text(f"[[run]]\nid = \"run\"\ncase = \"{case}\"\nset = {sets}\n[[check]]\nrun = \"run\"\n"
                    "metric = \"solid_volume_error\"\nreference = { kind = \"theory\", value = 0, source = \"conserved\" }\n"
                    "tolerance = { absolute = 1, unit = \"-\" }\nfrequency = \"short\"\n")
    return path


def judged(bench, runs, table, place):
    return bench.call([bench.compare, "check", "--runs", runs, "--checks", table, "--out", place / "verify"])


def damaged_runs(bench, entry):
    """A run whose files were changed: an exit code, and the run is named."""
    whole = bench.place()
    ended = run_once(bench, entry, whole / "run")
    table = table_of(entry, whole)
    sound = judged(bench, whole, table, whole)
    if ended is None or ended.returncode != 0 or sound is None or sound.returncode != 0:
        yield "the whole run", "it is not judged sound: " + (sound.stdout.decode()[-200:] if sound else "no end")
        return
    tries = [(name, *way) for name in entry["files"] for way in damages_of(entry)]
    for name, how, way in bench.some(tries):
        place = bench.place()
        runs = place / "runs"
        runs.mkdir()
        damage.copy_of(whole / "run", runs / "run")
        before = (runs / "run" / name).read_bytes()
        way(runs / "run" / name, bench.chance)
        file = runs / "run" / name
        if file.is_file() and file.read_bytes() == before:
            continue
        ended = judged(bench, runs, table, place)
        why = ""
        if ended is None or ended.returncode not in (1, 2):
            why = "no end" if ended is None else f"exit code {ended.returncode}"
        elif b"run" not in ended.stdout + ended.stderr:
            why = "the run is not named"
        yield f"{name}, {how}", why


def outputs(bench, entry):
    """Output that cannot be written: no success."""
    with open(entry["stdout"], "wb") as target:
        ended = bench.call(bench.filled(entry["command"]), stdout=target)
    yield (f"{' '.join(entry['command'][:2])} > {entry['stdout']}",
           "" if ended is not None and ended.returncode > 0 else f"exit code {ended and ended.returncode}")


def locales(bench, entry):
    """The same output in every locale."""
    plain = bench.call(bench.filled(entry["command"]), environment={"LC_ALL": "C"})
    for locale in entry["locales"]:
        ended = bench.call(bench.filled(entry["command"]), environment={"LC_ALL": locale, "LANG": locale})
        same = ended is not None and (ended.returncode, ended.stdout) == (plain.returncode, plain.stdout)
        yield f"{' '.join(entry['command'][:2])} in {locale}", "" if same and plain.returncode == 0 else "another output"


KINDS = {kind.__name__: kind for kind in (
    bad_values, bad_files, damaged_runs, interrupted.kills, interrupted.kills_at_calls, interrupted.failing_calls,
    scarce.full_disks, scarce.limits, scarce.closed_streams, directories.two_in_one, directories.foreign,
    directories.damaged_resumes, directories.changed_keys, outputs, locales, scarce.long_runs)}
