"""Files of another run of the same scene and grid, put in the place of a run's own: no result is of two runs."""

import shutil

from faults_tried.bench import TableError
from faults_tried.runs import SmallRun, not_refused, same_content, tree_of

FILES = ("series.csv", "fields.h5", "fields/t0000.h5", "fields/t0001.h5", "checkpoint.h5", "run.json")


def exchanged(bench, entry):
    """A file of another run in one that was cut short, or in a finished one that is gone on with: refused, or it makes no difference."""
    run = SmallRun(bench, entry)
    other = SmallRun(bench, {**entry, "set": [*entry["set"], entry["other"]]})
    longer = bench.kept("longer " + str(entry), lambda target: gone_on(run, target, entry["longer"]))
    tries = [(name, state) for state in ("cut short", "finished") for name in FILES]
    for name, state in bench.some(tries, entry["sample"]):
        place, elsewhere = bench.place(), bench.place()
        if state == "cut short":
            out, source, words, whole = run.partial(place), other.partial(elsewhere), [], run.whole
        else:
            out, source, whole = shutil.copytree(run.whole, place / "run"), other.whole, longer
            words = [word for given in entry["longer"] for word in ("--set", given)]
        if not (source / name).exists():
            continue
        shutil.copy(source / name, out / name)
        before = tree_of(out)
        ended = run.go(out, *words, "--resume", patience=120.0)
        went_on = ended is not None and ended.returncode == 0
        why = ("" if same_content(out, whole) else "it is of two runs") if went_on else not_refused(ended, before, out)
        yield f"{name} of another run in one {state}", why
        bench.drop(out)


def gone_on(run, target, sets):
    """The run, gone on with to a later end."""
    shutil.copytree(run.whole, target)
    ended = run.go(target, *(word for given in sets for word in ("--set", given)), "--resume")
    if ended is None or ended.returncode != 0:
        raise TableError(f"a run that is let alone is not gone on with: {ended and ended.stderr[-200:]!r}")
