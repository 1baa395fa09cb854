"""Odd moments of a run: what happens beside its start, between its parts, and to the files that it reads just then."""

import os
import shutil
import signal
import subprocess
import threading
import time

from faults_tried.bench import PATIENCE, NotTried, refused, told_of_our_end
from faults_tried.runs import crashed, not_refused, same_content, tree_of, tried_on_a_run

AT_ONCE = 6  # runs that start in the same moment
ROUNDS = 5
PAUSE = 0.0003  # seconds between two swaps: what reads needs a processor too


def with_its_own_cases(bench, run, place):
    """The command of a run whose case is a copy, and the copy."""
    case = bench.root / run.entry["case"]
    cases = place / "cases"
    shutil.copytree(case.parent, cases)

    def command(out, *words):
        return [str(cases / case.name) if word == run.entry["case"] else word for word in run.command(out, *words)]
    return command, cases / case.name


def many_at_once(bench, run, place):
    """Started in the same moment into one directory that is not there: one runs, the others are refused."""
    for number in range(ROUNDS):
        out = place / str(number) / "run"
        command = run.command(out)
        all_of_them = [subprocess.Popen(command, cwd=bench.root, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                        preexec_fn=told_of_our_end()) for _ in range(AT_ONCE)]
        said = [one.communicate()[1].decode(errors="replace") for one in all_of_them]
        codes = sorted(one.returncode for one in all_of_them)
        # one that starts late finds the first one's finished run, and may run it again: the same files
        if codes[0] != 0 or any(code not in (0, 2) for code in codes):
            return f"exit codes {codes}: {max(said, key=len)[:150]!r}"
        if why := run.same_bytes(out):
            return why
    return ""


def its_case_removed(bench, run, place):
    """Before it is resumed: said, and the run stays."""
    command, case = with_its_own_cases(bench, run, place)
    out = run.partial(place)
    case.unlink()
    before = tree_of(out)
    return not_refused(bench.call(command(out, "--resume")), before, out)


def its_case_edited(bench, run, place):
    """Before it is resumed: another density is refused, a comment is none of its business."""
    command, case = with_its_own_cases(bench, run, place)
    out, text = run.partial(place), case.read_text()
    before = tree_of(out)
    other = place / "other.toml"
    other.write_text(f'base = "cases/{case.name}"\n[solid]\ndensity = 2600\n[scene]\nname = "other"\n')
    changed = [str(other) if word == str(case) else word for word in command(out, "--resume")]
    if why := not_refused(bench.call(changed), before, out):
        return why
    case.write_text("# a comment\n" + text)
    ended = bench.call(command(out, "--resume"), patience=600)
    return run.same_bytes(out) if ended and ended.returncode == 0 else f"exit code {ended and ended.returncode}"


def its_case_moved(bench, run, place):
    """The same case under another path: it goes on."""
    command, _ = with_its_own_cases(bench, run, place)
    out = run.partial(place)
    ended = bench.call(command(out, "--resume"), patience=600)
    return run.same_bytes(out) if ended and ended.returncode == 0 else f"exit code {ended and ended.returncode}"


def swapped(path, makers, until):
    draft = path.with_name("draft")
    while not until.is_set():
        for make in makers:
            make(draft)
            os.replace(draft, path)
            time.sleep(PAUSE)


def its_case_swapped_while_it_is_read(bench, run, place):
    """For a pipe, a socket, and back: nobody waits, and what is not refused is the whole case."""
    command, case = with_its_own_cases(bench, run, place)
    whole, until = case.read_text(), threading.Event()
    same = bench.call([bench.granvof, "check", case]).stdout
    other = threading.Thread(target=swapped, args=(case, [os.mkfifo, lambda draft: draft.write_text(whole)], until))
    other.start()
    try:
        for _ in range(60):
            ended = bench.call([bench.granvof, "check", case], patience=PATIENCE)
            if ended is None or ended.returncode != 0:
                if why := refused(ended):
                    return why
            elif ended.stdout != same:
                return "half a case was taken"
    finally:
        until.set()
        other.join()
    return ""


def its_record_swapped_while_it_is_read(bench, run, place):
    """run.json and series.csv of a finished run, for pipes and back, while it is read for a page."""
    out, until = shutil.copytree(run.whole, place / "run"), threading.Event()
    others = []
    for name in ("run.json", "series.csv"):
        (place / name).mkdir()
        whole = (out / name).read_bytes()

        def swap(path=out / name, draft=place / name / "draft", whole=whole):
            while not until.is_set():
                for make in (os.mkfifo, lambda draft, whole=whole: draft.write_bytes(whole)):
                    make(draft)
                    os.replace(draft, path)
                    time.sleep(PAUSE)
        others.append(threading.Thread(target=swap))
    for other in others:
        other.start()
    try:
        for _ in range(8):
            ended = bench.call(["/usr/bin/python3", "ci/faults_tried/load.py", out], patience=5 * PATIENCE)
            if ended is None or ended.returncode not in (0, 2) or (ended.returncode == 2 and refused(ended)):
                return "it waits for a pipe" if ended is None else f"exit code {ended.returncode}: {ended.stderr[-150:]!r}"
    finally:
        until.set()
        for other in others:
            other.join()
    return ""


def elsewhere(bench):
    """A folder on another file system than the bench's. NotTried where there is none."""
    for folder in ("/dev/shm", "/tmp", "/var/tmp"):
        if os.path.isdir(folder) and os.access(folder, os.W_OK) and os.stat(folder).st_dev != os.stat(bench.work).st_dev:
            return folder
    raise NotTried("there is one file system only")


def its_instants_on_another_file_system(bench, run, place):
    """`fields` is a link to another disk, where names cannot be moved from one to the other."""
    import tempfile
    with tempfile.TemporaryDirectory(dir=elsewhere(bench)) as other:
        out = run.partial(place)
        shutil.move(out / "fields", other + "/fields")
        (out / "fields").symlink_to(other + "/fields")
        before = tree_of(out)
        ended = run.go(out, "--resume")
        if ended is not None and ended.returncode == 0:
            return "" if same_content(out, run.whole) else run.same_bytes(out)
        return not_refused(ended, before, out)


def its_directory_a_link_to_another_file_system(bench, run, place):
    import tempfile
    with tempfile.TemporaryDirectory(dir=elsewhere(bench)) as other:
        (place / "run").symlink_to(other)
        ended = run.go(place / "run")
        return run.same_bytes(place / "run") if ended and ended.returncode == 0 else crashed(ended) or f"exit code {ended.returncode}"


def its_instants_a_loop(bench, run, place):
    """`fields` leads back to the run itself."""
    out = run.partial(place)
    shutil.rmtree(out / "fields")
    (out / "fields").symlink_to(".")
    before = tree_of_names(out)
    ended = run.go(out, "--resume")
    if ended is not None and ended.returncode == 0:
        return "it goes on without its instants"
    return refused(ended) or ("" if tree_of_names(out) == before else "it changed something")


def tree_of_names(directory):
    return {path.name: path.lstat().st_mtime_ns for path in directory.iterdir()}


def stopped_for_a_long_time(bench, run, place):
    """The clock goes on while the run does not: its limit of wall time is what a scheduler counts."""
    running = run.start(place / "run", "--stop-after", "3s")
    running.send_signal(signal.SIGSTOP)
    threading.Event().wait(4.0)
    running.send_signal(signal.SIGCONT)
    code = running.wait()
    if code not in (0, 3):
        return f"exit code {code}"
    return run.why_not_whole(place / "run")


TRIES = {way.__name__: way for way in (
    many_at_once, its_case_removed, its_case_edited, its_case_moved, its_case_swapped_while_it_is_read, its_record_swapped_while_it_is_read,
    its_instants_on_another_file_system, its_directory_a_link_to_another_file_system, its_instants_a_loop, stopped_for_a_long_time)}


def moments(bench, entry):
    """What happens beside the start of a run, between its parts, and to the files that it reads: it is as any other, or it is refused."""
    yield from tried_on_a_run(bench, entry, TRIES)
