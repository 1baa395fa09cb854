"""Runs that are kept for later calls, and were damaged meanwhile: they are made again, and the answer is what it was."""

import shutil

from faults_tried import damage
from faults_tried.again import LONG, is_same, result_of
from faults_tried.bench import TableError, refused


def of_another(path, chance):
    """The same file of another run."""
    others = [other for other in sorted(path.parent.parent.glob("*/" + path.name)) if other != path]
    shutil.copy(chance.choice(others), path)


def of_two_exchanged(path, chance):
    """The directories of two runs."""
    one, other = path.parent, next(other for other in sorted(path.parent.parent.iterdir()) if other.is_dir() and other != path.parent)
    aside = one.with_name("aside")
    one.rename(aside)
    other.rename(one)
    aside.rename(other)


WAYS = {**damage.BY_NAME, "of_another": of_another, "of_two_exchanged": of_two_exchanged}


def damaged_caches(bench, entry):
    """A run that a study has kept, damaged: the same answer, or a refusal."""
    whole, members = bench.place(), entry.get("members")
    command = bench.filled(entry["command"], work=whole)
    ended = bench.call(command, patience=LONG)
    answer = result_of(whole, entry["result"], members)
    if ended is None or ended.returncode != 0 or answer is None:
        raise TableError(f"{' '.join(entry['command'][:2])}: exit code {ended and ended.returncode}: {ended and ended.stderr[-200:]!r}")
    tries = [(name, how) for name in entry["files"] for how in entry["damages"]]
    for name, how in bench.some(tries, entry["sample"]):
        place = bench.place()
        shutil.copytree(whole, place, dirs_exist_ok=True)
        (place / entry["result"]).unlink()
        run = sorted(path.parent for path in (place / entry["runs"]).glob("*/run.json"))[0]
        WAYS[how](run / name, bench.chance)
        ended = bench.call(bench.filled(entry["command"], work=place), patience=LONG)
        if ended is not None and ended.returncode == 0:
            why = "" if is_same(result_of(place, entry["result"], members), answer) else "another answer"
        else:
            why = refused(ended)
        yield f"{' '.join(entry['command'][:2])}, {name} of a run it has kept, {how}", why
        bench.drop(place / "any")
