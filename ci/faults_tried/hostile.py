"""What is odd about the place, the case or the moment of a run, though nobody has damaged anything."""

import json
import os
import shutil
import signal
import subprocess
import time

from faults_tried.bench import PATIENCE, TableError, refused
from faults_tried.runs import SmallRun, crashed, not_refused, stopped_once, tree_of, tried_on_a_run

LONG_NAME = 3000  # letters


def ended_well(run, out, ended):
    return run.same_bytes(out) if ended is not None and ended.returncode == 0 else f"exit code {ended and ended.returncode}"


def a_link_to_a_directory(bench, run, place):
    (place / "real").mkdir()
    (place / "run").symlink_to(place / "real")
    return ended_well(run, place / "real", run.go(place / "run"))


def a_link_to_nothing(bench, run, place):
    (place / "run").symlink_to(place / "nothing")
    return refused(run.go(place / "run")) or ("it made something" if (place / "nothing").exists() else "")


def a_long_name(bench, run, place):
    return refused(run.go(place / ("a" * LONG_NAME)))


def a_long_path(bench, run, place):
    return refused(run.go(place.joinpath(*["a"] * LONG_NAME)))


def a_name_with_a_line_break(bench, run, place):
    """A directory may be called so; a message about it is one line."""
    out = place / "one\ntwo\x1b[31m"
    why = ended_well(run, out, run.go(out))
    (out / "run.json").write_text("{}")
    return why or refused(run.go(out))


def a_name_that_is_not_utf_8(bench, run, place):
    out = place / "a\udcffb"
    return ended_well(run, out, run.go(out))


def links_for_drafts(bench, run, place):
    """A link that has the name of a draft: what it points to is somebody's."""
    mine = place / "mine.txt"
    mine.write_text("mine\n")
    out = run.partial(place)
    for name in ("run.json", "series.csv", "fields.h5", "fields.xdmf", "checkpoint.h5", "fields/t0003.h5"):
        draft = out / (name + ".tmp")
        draft.unlink(missing_ok=True)
        draft.symlink_to(mine)
    return run.why_not_whole(out) or ("" if mine.read_text() == "mine\n" else "it wrote into another's file")


def a_link_for_the_series(bench, run, place):
    out = run.partial(place)
    shutil.move(out / "series.csv", place / "elsewhere.csv")
    (out / "series.csv").symlink_to(place / "elsewhere.csv")
    return run.why_not_whole(out)


def begun(run, out, *words):
    """A run under way that is stopped for the moment."""
    running = run.start(out, *words)
    if not stopped_once(running, (out / "checkpoint.h5").exists):
        raise TableError("the run had ended before anything could be tried on it")
    return running


def stopped_and_continued(bench, run, place):
    running = begun(run, place / "run")
    for _ in range(20):
        running.send_signal(signal.SIGCONT)
        time.sleep(0.002)
        running.send_signal(signal.SIGSTOP)
    running.send_signal(signal.SIGCONT)
    return f"exit code {running.returncode}" if running.wait() else run.same_bytes(place / "run")


def removed_while_it_runs(bench, run, place):
    """An error that is said; what can be removed cannot be written to."""
    with open(place / "said", "wb") as said:
        running = begun(SaidOf(run, said), place / "run")
        shutil.rmtree(place / "run")
        running.send_signal(signal.SIGCONT)
        code = running.wait()
    text = (place / "said").read_bytes()
    return "" if code == 1 and b"run" in text else f"exit code {code}, said {text[-100:]!r}"


class SaidOf:
    """A run whose messages go into an open file."""

    def __init__(self, run, said):
        self.run, self.said = run, said

    def start(self, out, *words):
        return self.run.start(out, *words, stderr=self.said)


def moved_while_it_runs(bench, run, place):
    """An error that is said, and what was moved goes on from where it was."""
    with open(place / "said", "wb") as said:
        running = begun(SaidOf(run, said), place / "run")
        (place / "run").rename(place / "elsewhere")
        running.send_signal(signal.SIGCONT)
        code = running.wait()
    if code != 1 or b"run" not in (place / "said").read_bytes():
        return f"exit code {code}, said {(place / 'said').read_bytes()[-100:]!r}"
    return run.why_not_whole(place / "elsewhere") or ("it made another" if (place / "run").exists() else "")


def another_put_in_its_place_while_it_runs(bench, run, place):
    """An error that is said; the other stays as it is, and what was moved goes on from where it was."""
    with open(place / "said", "wb") as said:
        running = begun(SaidOf(run, said), place / "run")
        (place / "run").rename(place / "elsewhere")
        shutil.copytree(run.whole, place / "run")
        before = tree_of(place / "run")
        running.send_signal(signal.SIGCONT)
        code = running.wait()
    if code != 1 or b"cannot write" not in (place / "said").read_bytes():
        return f"exit code {code}, said {(place / 'said').read_bytes()[-100:]!r}"
    return run.why_not_whole(place / "elsewhere") or ("" if tree_of(place / "run") == before else "it wrote into the other")


def a_pipe_for_its_record(bench, run, place):
    """While it runs: an end that is said, or, put there between the question and the renaming, it is replaced; nobody is waited for."""
    with open(place / "said", "wb") as said:
        running = begun(SaidOf(run, said), place / "run")
        (place / "run/run.json").unlink()
        os.mkfifo(place / "run/run.json")
        running.send_signal(signal.SIGCONT)
        try:
            code = running.wait(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            running.kill()
            running.wait()
            return "it waits for the pipe"
    if code == 0:
        return run.same_bytes(place / "run")
    return "" if code == 1 and b"a pipe" in (place / "said").read_bytes() else f"exit code {code}, said {(place / 'said').read_bytes()[-100:]!r}"


def its_checkpoint_and_record_removed_while_it_runs(bench, run, place):
    """They are written anew, from what it knows."""
    running = begun(run, place / "run")
    for name in ("checkpoint.h5", "run.json"):
        (place / "run" / name).unlink()
    running.send_signal(signal.SIGCONT)
    return f"exit code {running.returncode}" if running.wait() else run.same_bytes(place / "run")


def signals_in_quick_succession(bench, run, place):
    running = begun(run, place / "run")
    for number in (signal.SIGTERM, signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGTERM, signal.SIGCONT, signal.SIGTERM):
        running.send_signal(number)
    code = running.wait()
    state = json.loads((place / "run/run.json").read_text())["exit"]["state"]
    if (code, state) != (1, "stopped"):
        return f"exit code {code}, run.json says {state}"
    return run.why_not_whole(place / "run")


def its_case_replaced_while_it_runs(bench, run, place):
    """The case was read at the start."""
    case = bench.root / run.entry["case"]
    copies = [shutil.copy(path, place) for path in case.parent.glob("*.toml")]
    command = [str(place / case.name) if word == run.entry["case"] else word for word in run.command(place / "run")]
    running = begun(Command(run, command), place / "run")
    for copy in copies:
        open(copy, "w").write("nothing = [")
    running.send_signal(signal.SIGCONT)
    return f"exit code {running.returncode}" if running.wait() else run.same_bytes(place / "run")


class Command:
    """A run by another command line."""

    def __init__(self, run, command):
        self.run, self.command = run, command

    def start(self, out, *words):
        return self.run.start(out, command=[*self.command, *words])


def the_checkpoint_of_another_case(bench, run, place):
    out = run.partial(place)
    other = place / "other"
    run.go(other, sets=["solid.density=2600"])
    shutil.copy(other / "checkpoint.h5", out / "checkpoint.h5")
    before = tree_of(out)
    return not_refused(run.go(out, "--resume"), before, out)


def two_that_resume(bench, run, place):
    out = run.partial(place)
    before = inode(out / "checkpoint.h5")
    running = run.start(out, "--resume")  # a checkpoint of its own shows that it is under way
    if not stopped_once(running, lambda: inode(out / "checkpoint.h5") not in (before, None)):
        return "the first had ended before"
    kept = tree_of(out)
    why = not_refused(run.go(out, "--resume"), kept, out)
    running.send_signal(signal.SIGCONT)
    return why or (f"the first: exit code {running.returncode}" if running.wait() else run.same_bytes(out))


def inode(path):
    try:
        return path.stat().st_ino
    except OSError:
        return None


def no_standard_output_and_a_full_error_stream(bench, run, place):
    with open("/dev/full", "wb") as full:
        ended = bench.call(run.command(place / "run"), stdout=full, patience=600)
    return crashed(ended) or run.why_not_whole(place / "run")


TRIES = {way.__name__: way for way in (
    a_link_to_a_directory, a_link_to_nothing, a_long_name, a_long_path, a_name_with_a_line_break, a_name_that_is_not_utf_8,
    links_for_drafts, a_link_for_the_series, stopped_and_continued, removed_while_it_runs, moved_while_it_runs,
    another_put_in_its_place_while_it_runs, a_pipe_for_its_record,
    its_checkpoint_and_record_removed_while_it_runs, signals_in_quick_succession, its_case_replaced_while_it_runs,
    the_checkpoint_of_another_case, two_that_resume, no_standard_output_and_a_full_error_stream)}


def hostile(bench, entry):
    """Odd places, names and moments: the run is as any other, or it is refused and says why."""
    yield from tried_on_a_run(bench, entry, TRIES)


def own_files(bench, entry):
    """A file that a user names for the output, and that is something else: refused, and it stays as it is."""
    run = SmallRun(bench, entry)
    sets = [word for given in entry["set"] for word in ("--set", given)]
    for command in bench.some(entry["commands"], entry["sample"]):
        place = bench.place()
        shutil.copytree(run.whole, place / "run")
        shutil.copytree(bench.root / "cases", place / "cases")
        (place / "notes.txt").write_text("mine\n")
        (place / "plan").write_text(json.dumps({"id": "x", "case": str(place / "cases/canary.toml"), "set": ["time.end=0.1", "output.field_times=[0]"],
                                                "directory": str(place / "new")}) + "\n")
        before = tree_of(place)
        filled = [word for part in bench.filled(command, work=place) for word in (sets if part == "SETS" else [part])]
        yield " ".join(command).replace(" SETS", ""), not_refused(bench.call(filled, cwd=place), before, place)
        bench.drop(place / "any")


def odd_cases(bench, entry):
    """A case file in another form: one that says the same gives the same; one that cannot be meant is refused with its line."""
    plain = (bench.root / entry["case"]).read_bytes()
    stem = bench.root / entry["case"]
    same = bench.call([bench.granvof, "check", stem])
    forms = {"with a byte order mark": b"\xef\xbb\xbf" + plain, "with CR LF": plain.replace(b"\n", b"\r\n"),
             "without a last line end": plain.rstrip(b"\n")}
    for name, content in bench.some(forms.items(), 1):
        ended = bench.call([bench.granvof, "check", put(bench, stem.name, content)])
        yield name, "" if ended and ended.stdout == same.stdout and ended.returncode == 0 else "another case than without"
    for name in bench.some(entry["cases"], entry["sample"]):
        place = bench.place()
        (place / "case.toml").write_bytes(CASES[name](place))
        yield f"a case {name.replace('_', ' ')}", refused(bench.call([bench.granvof, "check", place / "case.toml"]))
        bench.drop(place / "any")
    for text in bench.some(entry["refused"], entry["sample"]):
        ended = bench.call([bench.granvof, "check", put(bench, stem.name, plain + text.encode("utf-8", "surrogateescape"))])
        why = refused(ended)
        line = plain.count(b"\n") + 1 + text.rstrip("\n").count("\n")
        said = ended.stderr.decode(errors="replace") if ended else ""
        placed = any(f":{line - back}:" in said for back in range(text.count("\n") + 1))
        yield repr(text)[:60], why or ("" if placed else f"it does not say where: {said[:100]!r}")


def large(place):
    return b"# " + bytes(100 << 20).replace(b"\0", b"x") + b"\n"


def nested(place):
    return b"[a]\nb = " + b"[" * 100000 + b"]" * 100000


def nested_tables(place):
    return b"a = " + b"{a = " * 100000 + b"1" + b"}" * 100000


def a_deep_key(place):
    return b"a" + b".a" * 100000 + b" = 1\n"


def a_deep_header(place):
    return b"[a" + b".a" * 100000 + b"]\n"


def a_long_key(place):
    return b"k" * (1 << 20) + b" = 1\n"


def many_faults(place):
    return b"[nothing]\n" + b"".join(b"k%d = 1\n" % n for n in range(20000))


def on_itself(place):
    return b'base = "case.toml"\n'


def on_each_other(place):
    (place / "other.toml").write_bytes(b'base = "case.toml"\n')
    return b'base = "other.toml"\n'


def on_a_long_chain(place):
    for n in range(3000):
        (place / f"{n}.toml").write_bytes(b'base = "%d.toml"\n' % (n + 1))
    return b'base = "0.toml"\n'


def on_nothing(place):
    return b'base = "nothing.toml"\n'


def on_a_pipe(place):
    os.mkfifo(place / "pipe")
    return b'base = "pipe"\n'


def on_a_link_to_itself(place):
    (place / "loop").symlink_to("loop")
    return b'base = "loop"\n'


CASES = {way.__name__: way for way in (large, nested, nested_tables, a_long_key, a_deep_key, a_deep_header, many_faults, on_itself, on_each_other, on_a_long_chain, on_nothing,
                                       on_a_pipe, on_a_link_to_itself)}


def put(bench, name, content):
    path = bench.place() / name
    path.write_bytes(content)
    return path
