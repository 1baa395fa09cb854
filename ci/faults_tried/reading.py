"""Disks that fail while something is read, or are full while results are written: no result that looks whole and is not."""

import json
import shutil

from faults_tried.bench import TableError
from faults_tried.evidence import KEPT, table_of
from faults_tried.runs import SmallRun, crashed, tree_of


class Prepared:
    """A finished run, what was judged of it, one cut short, the cases and a table of checks: copied anew for every try."""

    def __init__(self, bench, entry):
        self.bench, self.entry, self.run = bench, entry, SmallRun(bench, entry)
        self.checks = table_of(entry, bench.place(), KEPT)
        self.verified = bench.place() / "verify"
        judged = bench.call([bench.compare, "check", "--runs", self.run.whole.parent, "--checks", self.checks, "--out", self.verified])
        if judged is None or judged.returncode != 0:
            raise TableError(f"the whole run is not judged sound: {judged and (judged.stdout + judged.stderr)[-200:]!r}")

    def command(self, words, place):
        shutil.copytree(self.run.whole, place / "runs/run", symlinks=True)
        self.run.partial(place)
        shutil.copytree(self.bench.root / "cases", place / "cases")
        shutil.copytree(self.verified, place / "verify")
        shutil.copy(self.checks, place)
        sets = [word for given in self.entry["set"] for word in ("--set", given)]
        filled = self.bench.filled(words, work=place)
        return [word for part in filled for word in (sets if part == "SETS" else [part])]


def seen(ended, place):
    """What a command leaves: its code, what it said, and its files but for dates."""
    return ended.returncode, ended.stdout.replace(str(place).encode(), b"")


def failing_reads(bench, entry):
    """The n-th read fails: an error that is said, or the result of a whole read."""
    made = Prepared(bench, entry)
    for words in entry["commands"]:
        place = bench.place()
        count = bench.place() / "count"
        command = made.command(words, place)
        whole = bench.call(command, environment=bench.shimmed(FAULT_READ="0", FAULT_BELOW=str(place), FAULT_COUNT=str(count)),
                           patience=600)
        if whole is None or whole.returncode != 0:
            raise TableError(f"{' '.join(command)}: exit code {whole and whole.returncode}: {whole and whole.stderr[-200:]!r}")
        reads = int(count.read_text())
        if reads == 0:
            raise TableError(f"{' '.join(command)}: it reads nothing")
        for number in bench.some(range(1, reads + 1, max(1, reads // entry["most"])), entry["sample"]):
            place = bench.place()
            ended = bench.call(made.command(words, place), patience=600,
                               environment=bench.shimmed(FAULT_READ=str(number), FAULT_BELOW=str(place)))
            why = unsaid(ended) or traceback(ended)
            if not why and ended.returncode == 0 and seen(ended, place)[1] != seen(whole, place)[1] and entry.get("says", True):
                why = "exit code 0, and it says something else"
            if not why and "--resume" in words:
                why = made.run.why_not_whole(place / "run")
            yield f"{' '.join(words[:2])}, read {number} of {reads}", why
            shutil.rmtree(place, ignore_errors=True)


def unsaid(ended):
    """As crashed(); a program that judges names what it cannot read in its verdicts, which are its output."""
    verdicts = ended is not None and ended.returncode == 1 and b"cannot read" in ended.stdout
    return "" if verdicts else crashed(ended)


def traceback(ended):
    return "a traceback" if b"Traceback" in ended.stderr else ""


def full_outputs(bench, entry):
    """A disk that fills up while results are written: an error that is said, what is there is whole, and what was there stays."""
    made = Prepared(bench, entry)
    for words in entry["commands"]:
        first = bench.place()
        command = made.command(words, first)
        given = set(tree_of(first))
        whole = bench.call(command, patience=600)
        if whole is None or whole.returncode != 0:
            raise TableError(f"{' '.join(command)}: exit code {whole and whole.returncode}: {whole and whole.stderr[-200:]!r}")
        written = {name: content for name, content in tree_of(first).items() if name not in given}
        size = sum(len(content) for content in written.values() if isinstance(content, bytes))
        for share in bench.some(entry["shares"], entry["sample"]):
            place = bench.place()
            ended = bench.call(made.command(words, place), patience=600, environment=bench.shimmed(FAULT_BYTES=str(int(share * size))))
            why = crashed(ended) or traceback(ended)
            if not why and ended.returncode == 0 and set(tree_of(place)) - given != set(written):
                why = "exit code 0, and a file is missing"
            yield f"{' '.join(words[:2])}, room for {share:g} of {size} bytes", why or torn(place)
            shutil.rmtree(place, ignore_errors=True)


def torn(place):
    """Which result is there and not whole."""
    for path in place.rglob("*.json"):
        try:
            json.loads(path.read_text())
        except ValueError:
            return f"{path.relative_to(place)} is cut"
    for path in place.rglob("*.html"):
        if not path.read_text().rstrip().endswith("</html>"):
            return f"{path.relative_to(place)} is cut"
    return ""
