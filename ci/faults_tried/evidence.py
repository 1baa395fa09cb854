"""Runs and records that were damaged after they were made: no verdict may rest on them."""

import json
import shutil

from faults_tried import damage
from faults_tried.bench import TableError, refused
from faults_tried.runs import SmallRun

# A check that every sound run passes.
KEPT = """metric = "solid_volume_error"
reference = { kind = "theory", value = 0, source = "conserved" }
tolerance = { absolute = 1, unit = "-" }
"""


def row_of(entry):
    """A check against the record, so wide that it is passed where the record can be read."""
    return (f"metric = \"{entry['metric']}\"\nat = {entry['at']}\nreference = {{ kind = \"DEM\" }}\n"
            "tolerance = { absolute = 1e3, unit = \"-\" }\n")


def table_of(entry, place, check):
    """A table of checks with one run and one row."""
    case = entry["case"].removeprefix("cases/").removesuffix(".toml")
    path = place / "checks.toml"
    sets = f"set = {json.dumps(entry['set'])}\n" if "set" in entry else ""
    path.write_text(f"[[run]]\nid = \"run\"\ncase = \"{case}\"\n{sets}"
                    f"[[check]]\nrun = \"run\"\n{check}frequency = \"short\"\n")
    return path


def run_once(bench, entry, out):
    sets = [word for override in entry.get("set", []) for word in ("--set", override)]
    return bench.call([bench.granvof, "run", entry["case"], *sets, "--threads", "1", "--out", out], patience=600)


def judged(bench, runs, table, place, *words):
    return bench.call([bench.compare, "check", "--runs", runs, "--checks", table, "--out", place / "verify", *words])


def damaged_runs(bench, entry):
    """A run whose files were changed: an exit code, and the run is named."""
    whole = bench.place()
    ended = run_once(bench, entry, whole / "run")
    table = table_of(entry, whole, KEPT)
    sound = judged(bench, whole, table, whole)
    if ended is None or ended.returncode != 0 or sound is None or sound.returncode != 0:
        yield "the whole run", "it is not judged sound: " + (sound.stdout.decode()[-200:] if sound else "no end")
        return
    tries = [(name, *way) for name in entry["files"] for way in damage.of_entry(entry)
             for _ in range(entry.get("times", 1) if way[0] in damage.BY_CHANCE else 1)]
    for name, how, way in bench.some(tries):
        place = bench.place()
        runs = place / "runs"
        runs.mkdir()
        damage.copy_of(whole / "run", runs / "run")
        before = (runs / "run" / name).read_bytes()
        way(runs / "run" / name, bench.chance)
        if how not in damage.NO_FILES and damage.is_still(runs / "run" / name, before):
            continue
        ended = judged(bench, runs, table, place)
        why = ""
        if ended is None or ended.returncode not in (1, 2):
            why = "no end" if ended is None else f"exit code {ended.returncode}"
        elif b"run" not in ended.stdout + ended.stderr:
            why = f"the run is not named: {(ended.stdout + ended.stderr)[-200:]!r}"
        yield f"{name}, {how}", why


def damaged_records(bench, entry):
    """A record of the reference whose files were changed: no verdict rests on it, and it is named."""
    whole = bench.place()
    run_once(bench, entry, whole / "run")
    table = table_of(entry, whole, row_of(entry))
    records = whole / "records"
    folder = entry["record"]
    shutil.copytree(bench.root / "reference/results" / folder, records / folder)
    shutil.copy(bench.root / "reference/results/bands.json", records)
    sound = judged(bench, whole, table, whole, "--records", records)
    if sound is None or sound.returncode != 0:
        raise TableError(f"{entry['record']}: the whole record is not judged sound: {sound and (sound.stdout + sound.stderr).decode()[-300:]}")
    tries = [(name, how) for name in entry["files"] for how, _ in damage.of_entry(entry)
             for _ in range(entry.get("times", 1))]
    for name, how in bench.some(tries, entry["sample"]):
        place = bench.place()
        damaged = damage.copy_of(records, place / "records")
        file = damaged / name if name == "bands.json" else damaged / folder / name
        before = file.read_bytes()
        damage.BY_NAME[how](file, bench.chance)
        if how not in damage.NO_FILES and damage.is_still(file, before):
            continue
        ended = judged(bench, whole, table, place, "--records", damaged)
        yield f"{name}, {how}", believed(ended, name)
        bench.drop(damaged)


def damaged_reads(bench, entry):
    """A run, whole or cut short, of which a file is none: whatever reads it refuses it."""
    run = SmallRun(bench, entry)
    tries = [(command, name, *way) for command in entry["commands"] for name in entry["files"] for way in damage.of_entry(entry)]
    for command, name, how, way in bench.some(tries, entry["sample"]):
        place = bench.place()
        out = run.partial(place) if entry["cut_short"] else damage.copy_of(run.whole, place / "run")
        way(out / name, bench.chance)
        why = refused(bench.call(bench.filled(command, run=out, work=place)))
        yield f"{' '.join(command[:2])} of {name}, {how}", why
        bench.drop(out)


def believed(ended, name):
    if ended is None or ended.returncode not in (1, 2):
        return "no end" if ended is None else f"exit code {ended.returncode}: it was believed"
    said = (ended.stdout + ended.stderr).decode(errors="replace")
    if "Traceback" in said:
        return "a traceback"
    return "" if any(word in said for word in ("error", "record", name)) else f"it is not named: {said[-200:]!r}"
