"""Directories that are taken: by another run, by another program's files, by a run of another case, by damaged files."""

import json
import shutil
import signal

from faults_tried import damage
from faults_tried.bench import TableError
from faults_tried.runs import SmallRun, not_refused, same_content, stopped_once, tree_of


def two_in_one(bench, entry):
    """A second run into a directory where one is under way is refused, and the first goes on unharmed."""
    run = SmallRun(bench, entry)
    for words in bench.some(entry["second"], entry["sample"]):
        out = bench.place() / "run"
        first = run.start(out)
        if not stopped_once(first, (out / "series.csv").exists):
            yield f"a second run {' '.join(words)}", "the first had ended before"
            continue
        before = tree_of(out)
        why = not_refused(run.go(out, *words, patience=60.0), before, out)
        first.send_signal(signal.SIGCONT)
        if first.wait() != 0:
            why = why or f"the first ended with exit code {first.returncode}"
        yield f"a second run {' '.join(words)}", why or run.why_not_whole(out)


def of_another_case(bench, run, out):
    run.go(out, sets=["solid.density=2600"])


def of_another_scene(bench, run, out):
    command = run.command(out)
    command[2] = run.entry["other"]
    ended = bench.call(command, patience=600)
    if ended is None or ended.returncode != 0:
        raise TableError(f"{run.entry['other']}: it does not end")


def of_another_program(bench, run, out):
    shutil.copytree(run.whole, out)
    record = json.loads((out / "run.json").read_text())
    (out / "run.json").write_text(json.dumps({**record, "program": "demvof"}))


def of_a_longer_run(bench, run, out):
    """The same case, that has come further."""
    run.go(out, sets=["time.end=0.3"])


def of_a_user(bench, run, out):
    (out / "fields").mkdir(parents=True)
    (out / "fields/t0000.h5").write_text("mine\n")
    (out / "notes.txt").write_text("mine\n")


def a_file(bench, run, out):
    out.mkdir()
    (out / "in").write_text("a file\n")


PLACES = {place.__name__: place for place in (of_another_case, of_another_scene, of_another_program, of_a_longer_run, of_a_user, a_file)}


def foreign(bench, entry):
    """A run into a directory that is another's: refused, and nothing in it changed."""
    run = SmallRun(bench, entry)
    tries = [(name, words) for name in entry["places"] for words in ([], ["--resume"])]
    for name, words in bench.some(tries, entry["sample"]):
        out = bench.place() / "run"
        PLACES[name](bench, run, out)
        before = tree_of(out)
        target = out / "in" if name == "a_file" else out
        yield f"a directory {name} {' '.join(words)}".strip(), not_refused(run.go(target, *words), before, out)


def damaged_resumes(bench, entry):
    """A file of a run that was cut short is damaged: `--resume` refuses it, or the files are those of the whole run."""
    run = SmallRun(bench, entry)
    tries = [(name, how) for name in entry["files"] for how in entry["damages"] for _ in range(entry.get("times", 1))]
    for name, how in bench.some(tries, entry["sample"]):
        out = run.partial(bench.place())
        file = out / name
        content = file.read_bytes()
        damage.BY_NAME[how](file, bench.chance)
        if how not in damage.NO_FILES and damage.is_still(file, content):
            continue
        before = tree_of(out)
        ended = run.go(out, "--resume", patience=60.0)
        if ended is not None and ended.returncode == 0:
            why = "" if same_content(out, run.whole) else run.same_bytes(out)
        else:
            why = not_refused(ended, before, out)
        yield f"{name}, {how}", why
        bench.drop(out)


def resolved(text):
    """Keys of a case in full, with their values as text."""
    table, keys = "", {}
    for line in text.splitlines():
        if line.startswith("["):
            table = line.strip("[]")
        elif " = " in line and not line.startswith("#"):
            key, value = line.split(" = ", 1)
            keys[f"{table}.{key}"] = value
    return keys


def another(value):
    """Another value of the same kind; None for words and lists, which have no neighbours."""
    if value in ("true", "false"):
        return "false" if value == "true" else "true"
    try:
        number = float(value)
    except ValueError:
        return None
    return str(int(number) + 1) if value.isdigit() else repr(number * 1.01)


def changed_keys(bench, entry):
    """`--resume` with another value of any key that the case has: refused; but for those that may change, which are kept in
    run.json."""
    run = SmallRun(bench, entry)
    plain = resolved(check(bench, run, []).stdout.decode())
    tries = [(key, another(value)) for key, value in plain.items() if not key.startswith("scene.")]
    tries += [(key, value) for key, value in entry["words"].items()]
    for key, value in bench.some([one for one in tries if one[1] is not None], entry["sample"]):
        given = f"{key}={value}"
        checked = check(bench, run, [given])
        if checked.returncode != 0 or resolved(checked.stdout.decode()) == plain:
            continue  # no case at all, or the same
        out = run.partial(bench.place())
        before = tree_of(out)
        ended = run.go(out, "--resume", sets=[given])
        may = any(key == allowed or key.startswith(allowed + ".") for allowed in entry["may_change"])
        if ended is not None and ended.returncode == 0:
            why = kept(out, key) if may else "it goes on with another case"
        else:
            why = "it may change, and was refused: " + ended.stderr.decode()[-150:] if may else not_refused(ended, before, out)
        yield given, why
        bench.drop(out)


def check(bench, run, sets):
    command = run.command(bench.work, sets=sets)
    command[1] = "check"
    return bench.call(command[:command.index("--threads")])


def kept(out, key):
    changes = [change["key"] for resumption in json.loads((out / "run.json").read_text()).get("resumptions", [])
               for change in resumption["changes"]]
    return "" if key in changes else f"run.json does not name it: {changes}"
