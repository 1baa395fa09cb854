"""File systems of their own: one that is full, one that takes no writing. They need the right to mount."""

import contextlib
import subprocess

from faults_tried.bench import NotTried, refused
from faults_tried.runs import SmallRun, tree_of
from faults_tried.scarce import judged

ROOMY = 256 * 1024  # kB


def mount(*words):
    return subprocess.run(["mount", *map(str, words)], capture_output=True, text=True)


@contextlib.contextmanager
def tmpfs(directory, kilobytes):
    """A file system in memory at `directory` while it lasts."""
    directory.mkdir(exist_ok=True)
    made = mount("-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", directory)
    if made.returncode != 0:
        raise NotTried(f"a tmpfs cannot be mounted here: {made.stderr.strip()[:100]}")
    try:
        yield directory
    finally:
        subprocess.run(["umount", "--lazy", str(directory)], check=True, capture_output=True)


def full_tmpfs(bench, entry):
    """A small file system in memory that fills up: it is said, and with more room the run goes on."""
    with tmpfs(bench.place() / "may", ROOMY):  # before anything is counted as tried
        pass
    run = SmallRun(bench, entry)
    pages = sum(-(-path.stat().st_size // 4096) for path in run.whole.rglob("*") if path.is_file())
    for share in bench.some(entry["shares"], entry["sample"]):
        with tmpfs(bench.place() / "disk", max(4, int(4 * share * pages))) as disk:
            ended = run.go(disk / "run")
            mount("-o", f"remount,size={ROOMY}k", disk)
            yield f"a tmpfs with room for {share:g} of the run", judged(run, disk / "run", ended)


def read_only(bench, entry):
    """A file system that takes no writing: refused, whatever is in the directory, and nothing is changed."""
    with tmpfs(bench.place() / "may", ROOMY):
        pass
    run = SmallRun(bench, entry)
    for name, words, has_run in bench.some((("a new run", [], False), ("a run again", [], True), ("--force", ["--force"], True),
                                            ("--resume", ["--resume"], True)), entry["sample"]):
        with tmpfs(bench.place() / "disk", ROOMY) as disk:
            if has_run:
                run.partial(disk)
            before = tree_of(disk)
            mount("-o", "remount,ro", disk)
            why = refused(run.go(disk / "run", *words))
            yield name, why or ("" if tree_of(disk) == before else "it changed something")
    with tmpfs(bench.place() / "disk", ROOMY) as disk:
        mount("-o", "remount,ro", disk)
        for command in bench.some(entry["commands"], len(entry["commands"])):
            ended = bench.call(bench.filled(command, work=disk))
            yield f"{' '.join(command[:2])} into it", refused(ended)
