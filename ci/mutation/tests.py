"""The tests of the copy as CTest lists them, what each takes and which faults each reaches, and who notices a fault."""

import subprocess
import time
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from granvof_files import json_in, json_of, write_json
from mutation import process, workers

LADDERS = {"unit": "unit", "verification": "ladder"}  # label of a test -> whom it belongs to
PATIENCE, SLOWER = 20.0, 4.0  # a test may take so many seconds and so many times longer than without a fault
PYTHON_TESTS = "compare/tests"


@dataclass
class Test:
    name: str
    ladder: str
    program: str
    arguments: list  # of the program, for this test alone
    filter: str  # of GoogleTest; empty: the program is no GoogleTest program
    folder: str  # whose tests these are, as solver/closures
    environment: dict
    seconds: float = 0.0
    reached: list = field(default_factory=list)  # numbers of the faults whose place it passes


def listed(build):
    """Tests of CTest with a known label, in its order."""
    said = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, stdout=subprocess.PIPE, text=True).stdout
    found = []
    for entry in json_in(said)["tests"]:
        properties = {item["name"]: item["value"] for item in entry.get("properties", [])}
        ladder = next((LADDERS[label] for label in properties.get("LABELS", []) if label in LADDERS), None)
        if ladder is None or "command" not in entry:
            continue
        program, *arguments = entry["command"]
        chosen = next((part.split("=", 1)[1] for part in arguments if part.startswith("--gtest_filter=")), "")
        environment = dict(item.split("=", 1) for item in properties.get("ENVIRONMENT", []))
        found.append(Test(entry["name"], ladder, program, arguments, chosen, folder_of(program, build), environment))
    return found


def folder_of(program, build):
    """solver/tests/closures/... are the tests of solver/closures; compare/tests/... of compare."""
    parts = Path(program).resolve().relative_to(Path(build).resolve()).parts if Path(program).is_absolute() and \
        Path(program).resolve().is_relative_to(Path(build).resolve()) else ()
    return "/".join(part for part in parts[:-1] if part != "tests")


def without_fault(tests, build, scratch, kept, say, at_once=1):
    """Times each test and notes what it reaches; `kept` (a file) holds what an earlier call found for the same programs.
    Names of those that fail without any fault."""
    before = {(entry["name"], entry["stamp"]): entry for entry in json_of(kept)} if kept.exists() else {}
    stamps = {test.program: Path(test.program).stat().st_mtime_ns for test in tests}
    notes = {test.name: before.get((test.name, stamps[test.program])) for test in tests}
    due = [test for test in tests if notes[test.name] is None]

    def keep():
        of_others = [entry for entry in before.values() if entry not in notes.values()]
        write_json(kept, [entry for entry in notes.values() if entry] + of_others)

    look = partial(noted, build=build, stamps=stamps)
    for index, (test, entry) in enumerate(workers.each(due, look, at_once, scratch), 1):
        notes[test.name] = entry
        if index % 50 == 0:
            say(f"without a fault: {index} of {len(due)} tests")
            keep()
    if due:
        keep()
    for test in tests:
        test.seconds, test.reached = notes[test.name]["seconds"], notes[test.name]["reached"]
    return [test.name for test in tests if notes[test.name]["ended"] != 0]


def noted(test, scratch, build, stamps):
    """What a test without a fault takes, and the faults it reaches."""
    reached = scratch / "reached"
    reached.unlink(missing_ok=True)
    begun = time.monotonic()
    ended = process.run([test.program, *test.arguments], build, 900.0, scratch,
                        {**test.environment, "GRANVOF_MUTANTS_REACHED": str(reached)})
    return {"name": test.name, "stamp": stamps[test.program], "seconds": round(time.monotonic() - begun, 3),
            "ended": ended.code, "reached": sorted(set(reached.read_text().split())) if reached.exists() else []}


def groups(tests, mutant, known=""):
    """What to start for a fault, in order: the test that noticed it before, then those that reach its place, program by
    program, those of its own folder first, then the quick ones."""
    first, by_program = [], {}
    for test in tests:
        if mutant.number not in test.reached:
            continue
        if test.name == known:
            first.append([test])
        else:
            by_program.setdefault(test.program if test.filter else test.name, []).append(test)
    def cost(members):
        return members[0].folder != mutant.folder, sum(test.seconds for test in members)
    return first + sorted(by_program.values(), key=cost)


def command_of(members):
    if not members[0].filter:
        return [members[0].program, *members[0].arguments]
    return [members[0].program, "--gtest_filter=" + ":".join(test.filter for test in members), "--gtest_fail_fast=1"]


def noticed_by(members, ended):
    """The test that failed, for a person."""
    for line in ended.output.splitlines():
        if line.startswith("[  FAILED  ] ") and "." in line:
            return line.split("] ", 1)[1].split(",")[0].split(" (")[0].strip()
    return f"{Path(members[0].program).name}, {ended.how}" if members[0].filter else members[0].name


def judge(tests, mutant, build, scratch, known=""):
    """("noticed", by whom), ("survived", ""), or ("not reached", "") where no test passes its place. `known`: the test that
    noticed it before."""
    due = groups(tests, mutant, known)
    for members in due:
        limit = PATIENCE + SLOWER * sum(test.seconds for test in members)
        ended = process.run(command_of(members), build, limit, scratch, {**members[0].environment, "GRANVOF_MUTANT": mutant.number})
        if ended.code != 0:
            return "noticed", noticed_by(members, ended)
    return ("survived" if due else "not reached"), ""


def judge_python(mutant, tree, scratch, known=""):
    """The same for what is not compiled, by the Python tests of the comparison; the file is altered already. `known`: the file
    whose test noticed it before, and comes first."""
    ended = process.run(["/usr/bin/python3", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "--import-mode=importlib",
                         *python_tests(mutant, tree, known)], tree, 600.0, scratch, {"PYTHONDONTWRITEBYTECODE": "1"})
    if ended.code == 0:
        return "survived", ""
    failed = [line.split(" ")[1] for line in ended.output.splitlines() if line.startswith(("FAILED ", "ERROR "))]
    return "noticed", failed[0].split("/")[-1] if failed else f"pytest, {ended.how}"


def python_tests(mutant, tree, known=""):
    """The known one first, then those that name the module, then all."""
    module = Path(mutant.file).stem
    def place(path):
        return path.name != known.split("::")[0], module not in path.read_text(encoding="utf-8"), path
    return [path.relative_to(tree) for path in sorted((tree / PYTHON_TESTS).glob("test_*.py"), key=place)]
