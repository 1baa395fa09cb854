"""Orders to the run engine whose directory is somebody else's: whatever a program makes of them, the try is a folder deep inside its
own place, so that nothing beyond it can be lost."""

import json

from faults_tried.bench import listed
from faults_tried.runs import tree_of

# Where a run is asked for, from {place}/a/b, which the engine works in; {place} and all folders in it hold a user's files.
DIRECTORIES = {"here": ".", "above": "..", "far above": "../..", "beside": "../mine", "a file": "../mine/notes.txt", "through itself": "../b/..",
               "a link to another": "link", "below a file": "../mine/notes.txt/run", "of a user with a run.json": "../json",
               "of a user with a made.json": "../note", "of a user with a series": "../series", "with a user's instants": "../instants"}


def with_files(place):
    """A user's folders; the innermost."""
    inner = place / "a/b"
    for folder, name in (("a/b", "notes.txt"), ("a/mine", "notes.txt"), (".", "notes.txt"), ("a/json", "run.json"), ("a/note", "made.json"),
                         ("a/series", "series.csv"), ("a/instants", "fields/mine.h5")):
        (place / folder / name).parent.mkdir(parents=True, exist_ok=True)
        (place / folder / name).write_text('{"mine": 1}\n')
    (inner / "link").symlink_to("../mine")
    return inner


def lost(before, after):
    gone = sorted(name for name, content in before.items() if after.get(name) != content)
    return "a user's files are lost: " + ", ".join(gone) if gone else ""


def orders(bench, entry):
    """A run that is ordered into somebody else's folder: said, and all that is there stays."""
    tries = [(name, way, more) for name, way in listed(entry, "directories", DIRECTORIES) for more in entry["more"]]
    for name, way, more in bench.some(tries, entry["sample"]):
        place = bench.place()
        inner = with_files(place)
        before = tree_of(place)
        order = {"id": "x", "case": str(bench.root / entry["case"]), "set": entry["set"], "directory": way, **more}
        (place / "plan").write_text(json.dumps(order) + "\n")
        ended = bench.call([bench.compare, "run", place / "plan", "--solver", bench.granvof], cwd=inner)
        why = lost(before, tree_of(place))
        if not why and (ended is None or ended.returncode not in (1, 2)):
            why = "no end" if ended is None else f"exit code {ended.returncode}: {ended.stdout[-150:]!r}"
        if not why and not any(word in ended.stdout + ended.stderr for word in (b"cannot", b"holds", b"is no directory")):
            why = f"it does not say why: {(ended.stdout + ended.stderr)[-150:]!r}"
        yield f"{name} ({way}), {json.dumps(more)}", why
        bench.drop(place / "any")
