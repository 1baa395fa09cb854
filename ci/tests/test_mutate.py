"""ci/mutate: the list of faults, which tests notice, the score, and a small project from end to end."""

import importlib.machinery
import importlib.util
import json
import subprocess
import threading
from pathlib import Path

import pytest

from mutation import cpp, listed, process, tests, told, tree, workers

ROOT = Path(__file__).resolve().parent.parent.parent

MUTATE = ROOT / "ci/mutate"


def load_program():
    spec = importlib.util.spec_from_loader("mutate", importlib.machinery.SourceFileLoader("mutate", str(MUTATE)))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_list_of_this_project_applies():
    mutants = listed.read(ROOT / "ci/mutants")
    places, gone = listed.places(mutants, ROOT)
    assert not gone
    assert len(places) >= 150
    for file in {mutant.file for mutant in mutants if mutant.compiled}:
        own = [(*place, mutant.number) for mutant, place in places.items() if mutant.file == file]
        cpp.switched((ROOT / file).read_text(encoding="utf-8"), own)  # each can be switched


@pytest.mark.parametrize("entry, said", [
    ("a = { was = 'x' }", "needs `was` and `now`"), ("a = { was = 'x', now = 'x' }", "another than `was`"),
    ("a = { was = 'x', now = 'y', often = 'z' }", "needs `was` and `now`"), ("a = 3", "needs `was` and `now`"), ("", "no faults")])
def test_a_bad_list_is_refused(tmp_path, entry, said):
    (tmp_path / "toy.toml").write_text(f'["toy/sums.hpp"]\n{entry}\n')
    with pytest.raises(listed.ListError, match=said):
        listed.read(tmp_path)


def a_test(name, program, reached, folder="solver/run", seconds=0.1, ladder="unit", by=""):
    return tests.Test(name, ladder, str(program), [], by, folder, {}, seconds, reached)


def test_own_folder_first_and_up_to_the_first_that_fails(tmp_path, shell):
    mutant = listed.Mutant("solver/run/a.cpp", "n", "a", "b")
    log = tmp_path / "log"
    def program(name, code):
        return shell(tmp_path / name, f"echo {name} $GRANVOF_MUTANT >> {log}; exit {code}\n")
    there = [a_test("quick", program("quick", 0), [mutant.number], "solver/grid", 0.01),
             a_test("own", program("own", 0), [mutant.number], "solver/run", 5.0),
             a_test("unreached", program("unreached", 1), []),
             a_test("fails", program("fails", 3), [mutant.number], "solver/grid", 0.2),
             a_test("late", program("late", 1), [mutant.number], "solver/grid", 9.0)]
    assert tests.judge(there, mutant, tmp_path, tmp_path) == ("noticed", "fails")
    assert log.read_text().split() == ["own", mutant.number, "quick", mutant.number, "fails", mutant.number]
    assert tests.judge(there[:2], mutant, tmp_path, tmp_path) == ("survived", "")
    assert tests.judge(there[2:3], mutant, tmp_path, tmp_path) == ("not reached", "")


def test_who_noticed_it_before_is_asked_first_and_alone(tmp_path, shell):
    mutant = listed.Mutant("solver/run/a.cpp", "n", "a", "b")
    log = tmp_path / "log"
    program = shell(tmp_path / "late", f"echo $1 >> {log}; exit 1\n")
    there = [a_test("quick", program, [mutant.number], "solver/run", 0.01, by="quick"),
             a_test("T.late", program, [mutant.number], "solver/grid", 9.0, by="T.late")]
    assert tests.judge(there, mutant, tmp_path, tmp_path, "T.late")[0] == "noticed"
    assert log.read_text().split() == ["--gtest_filter=T.late"]
    there[1].reached = []  # not where it does not reach the place any more
    tests.judge(there, mutant, tmp_path, tmp_path, "T.late")
    assert log.read_text().split()[1:] == ["--gtest_filter=quick"]


def test_python_tests_that_noticed_before_come_first(tmp_path):
    (tmp_path / "compare/tests").mkdir(parents=True)
    for name, text in (("a", ""), ("b", "import sums"), ("c", "")):
        (tmp_path / f"compare/tests/test_{name}.py").write_text(text)
    mutant = listed.Mutant("compare/sums.py", "n", "a", "b")
    assert [path.stem for path in tests.python_tests(mutant, tmp_path, "test_c.py::test_x")] == ["test_c", "test_b", "test_a"]


def test_several_at_a_time_each_in_a_place_of_its_own(tmp_path):
    both = threading.Barrier(2, timeout=10)

    def work(item, place):
        if item < 2:
            both.wait()  # needs two at a time
        if item == 3:
            raise ValueError("three")
        return place

    found = dict(workers.each([0, 1], work, 2, tmp_path))
    assert len(set(found.values())) == 2 and all(place.is_dir() for place in found.values())
    with pytest.raises(ValueError, match="three"):
        list(workers.each([3], work, 2, tmp_path))


def test_a_program_that_does_not_end_is_noticed(tmp_path, shell, monkeypatch):
    monkeypatch.setattr(tests, "PATIENCE", 0.3)
    mutant = listed.Mutant("solver/run/a.cpp", "n", "a", "b")
    there = [a_test("loops", shell(tmp_path / "loops", "sleep 60 & sleep 60\n"), [mutant.number], seconds=0.0)]
    assert tests.judge(there, mutant, tmp_path, tmp_path) == ("noticed", "loops")


def test_the_failed_test_of_a_program_is_named():
    said = "[ RUN      ] Drag.Ergun\n[  FAILED  ] Drag.Ergun (0 ms)\n[  FAILED  ] 1 test, listed below:\n"
    assert tests.noticed_by([a_test("Drag.Ergun", "test_closures", [], by="Drag.Ergun")], process.Ended(1, said)) == "Drag.Ergun"
    assert tests.noticed_by([a_test("Drag.Ergun", "test_closures", [], by="Drag.Ergun")],
                            process.Ended(-11, "")) == "test_closures, ended by SIGSEGV"


def entry(name, **found):
    mutant = listed.Mutant("solver/run/a.cpp", name, name, "b")
    return mutant, {"number": mutant.number, "file": mutant.file, "name": name, "was": name, "now": "b", "commit": "c",
                    **{by: {"verdict": verdict, "by": "T.t" if verdict == "noticed" else "", "seconds": 1.0}
                       for by, verdict in found.items()}}


def test_the_score_counts_what_was_tried():
    known = [entry("seen", unit="noticed", rows="survived"), entry("late", unit="survived", ladder="noticed"),
             entry("missed", unit="survived", ladder="not reached"), entry("open", unit="survived"), entry("untried")]
    mutants = [mutant for mutant, _ in known]
    results = {found["number"]: found for _, found in known[:4]}
    shown = told.section(mutants, results, "c")
    assert "5 small faults" in shown["text"][0]
    assert ("4 of them have been tried, 1 have no result: 2 were noticed (50.0 %), 1 by nobody, and 1 are unanswered "
            "(1 survived the unit tests and the ladder was not asked), 0 cannot be noticed.") in shown["text"][0]
    assert shown["tables"][0]["rows"][0] == ["solver/run", 4, "1 of 4", "1 of 2", "0 of 1", 2, 1, 0]
    assert [row[1] for row in shown["tables"][1]["rows"]] == ["missed", "open"]
    assert [row[3:] for row in shown["tables"][2]["rows"]] == [["T.t", "–", "survived"], ["survived", "T.t", "–"]]
    assert "Not all on this commit" not in shown["text"][1]
    assert "Not all on this commit: 7 of the trials on c." in told.section(mutants, results, "later")["text"][1]


def test_rows_say_where_they_do_not_pass():
    known = [entry("seen", unit="noticed", rows="noticed"), entry("missed", unit="noticed", rows="not reached")]
    mutant, found = entry("laid", unit="noticed", rows="not reached")
    found["file"] = "compare/lay/lay.py"
    results = {one["number"]: one for _, one in known} | {mutant.number: found}
    said = told.section([one for one, _ in known] + [mutant], results, "c")["text"][1]
    assert "1 of 1 noticed (100 %); 2 more stand where no row of these runs passes (none passes compare/lay)." in said
    assert told.section([known[1][0]], results, "c")["tables"][0]["rows"][0][4] == "0 of 0"  # in the table as in the sentence


def test_rows_never_reach_a_fault_of_python(tmp_path):
    mutant, found = entry("drawn", rows="survived")
    told.write(tmp_path / "results.json", [{**found, "file": "compare/report/results.py"}, entry("kept", rows="survived")[1]])
    verdicts = {one["name"]: one["rows"]["verdict"] for one in told.read(tmp_path / "results.json").values()}
    assert verdicts == {"drawn": "not reached", "kept": "survived"}


def test_what_was_not_asked_is_no_answer():
    known = [entry("a", unit="survived"), entry("b", rows="survived"), entry("c", rows="not reached")]
    said = told.section([mutant for mutant, _ in known], {found["number"]: found for _, found in known}, "c")["text"][0]
    assert ("0 by nobody, and 3 are unanswered (1 survived the unit tests and the ladder was not asked, "
            "2 were noticed by no row and no unit test was asked)") in said


def test_results_of_faults_that_changed_are_counted():
    known = [entry("now", unit="noticed"), entry("before", unit="noticed")]
    results = {found["number"]: found for _, found in known}
    said = told.section([known[0][0], listed.Mutant("solver/run/a.cpp", "before", "before", "c")], results, "c")["text"][0]
    assert "1 of them have been tried, 1 have no result (1 results are of faults whose text has changed since)" in said


def test_a_reason_takes_a_fault_out_of_the_score():
    mutant, found = entry("equal", unit="survived", ladder="survived")
    excused = listed.Mutant(mutant.file, mutant.name, mutant.was, mutant.now, why="the same in other words")
    shown = told.section([excused], {excused.number: found}, "c")
    assert "1 of them have been tried, 0 have no result: 0 were noticed, 0 by nobody, and 0 are unanswered, 1 cannot" in shown["text"][0]
    assert shown["tables"][1]["rows"][0][3] == "the same in other words"


# A project of one header, one program and its tests: 1 notices what 2 does not, and nothing looks at `unread`.
TOY = {
    "solver/toy/toy.hpp": "// A toy.\n#pragma once\n\n#include <cstdlib>\n\ninline int one() {\n  return 1 + 0;\n}\n"
                          "inline int two() {\n  return 2 + 0;\n}\ninline int unread() {\n  return 3 + 0;\n}\n",
    "solver/toy/main.cpp": '#include "solver/toy/toy.hpp"\nint main(int n, char** a) {\n'
                           "  const int sum = one() + two() + (unread() > 0 ? 0 : 9);\n"
                           "  return n > 1 && a[1][0] == '1' ? one() != 1 : sum != 3;\n}\n",
    "ci/mutants/toy.toml": '["solver/toy/toy.hpp"]\none = { was = "1 + 0", now = "1 + 1" }\ntwo = { was = "2 + 0", now = "2 + 1" }\n'
                           'unread = { was = "3 + 0", now = "3 + 1" }\n',
    "ci/build": "#!/bin/sh\nset -e\nmkdir -p build/release\necho built >> build/count\n"
                "g++ -std=c++20 -I. solver/toy/main.cpp -o build/release/toy\n"
                "cat > build/release/CTestTestfile.cmake <<E\n"
                'add_test(first "$PWD/build/release/toy" "1")\nset_tests_properties(first PROPERTIES LABELS unit)\n'
                'add_test(second "$PWD/build/release/toy" "2")\nset_tests_properties(second PROPERTIES LABELS verification)\nE\n',
}


@pytest.fixture
def toy(tmp_path):
    root = tmp_path / "toy"
    for name, text in TOY.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    (root / "ci/build").chmod(0o755)
    (root / ".gitignore").write_text("out/\n")
    subprocess.run(["git", "init", "-q", "."], cwd=root, check=True)
    return root


def mutate(root, *arguments):
    if "--against" not in arguments:
        arguments += ("--against", "unit", "ladder")
    return subprocess.run([MUTATE, "--root", root, *arguments], capture_output=True, text=True)


def verdicts(root):
    found = json.loads((root / "out/mutate/results.json").read_text())["mutants"]
    return {entry["name"]: {by: entry[by]["verdict"] for by in told.COLUMNS if by in entry} for entry in found}


def test_a_small_project_from_end_to_end(toy):
    ended = mutate(toy)
    assert ended.returncode == 1, ended.stderr  # one survives
    assert verdicts(toy) == {"one": {"unit": "noticed"}, "two": {"unit": "survived", "ladder": "noticed"},
                             "unread": {"unit": "survived", "ladder": "survived"}}
    assert json.loads((toy / "out/mutate/mutate.json").read_text())["title"] == "Faults that would be noticed"
    assert "2 were noticed (66.7 %)" in ended.stdout


def test_what_was_found_is_kept_and_not_tried_again(toy):
    mutate(toy, "--only", "one")
    assert list(verdicts(toy)) == ["one"]
    said = mutate(toy).stdout  # the two that were left
    assert "/2] solver/toy/toy.hpp: two" in said and "/2] solver/toy/toy.hpp: unread" in said and "toy.hpp: one" not in said
    before = (toy / "out/mutate/tree/build/count").read_text()
    ended = mutate(toy)
    assert "[1/" not in ended.stdout and (toy / "out/mutate/tree/build/count").read_text() == before  # nothing is built for it


def test_what_is_tried_once_more_keeps_what_others_found(toy):
    mutate(toy)
    mutate(toy, "--only", "two", "--against", "unit")
    assert verdicts(toy)["two"] == {"unit": "survived", "ladder": "noticed"}


def test_a_sample_is_of_that_size(toy):
    mutate(toy, "--sample", "2", "--against", "unit")
    assert len(verdicts(toy)) == 2


def test_the_project_itself_stays_as_it_is(toy):
    mutate(toy)
    assert {name: (toy / name).read_text() for name in TOY} == TOY


def test_a_fault_that_no_longer_applies_ends_with_its_name(toy):
    (toy / "solver/toy/toy.hpp").write_text(TOY["solver/toy/toy.hpp"].replace("2 + 0", "2"))
    ended = mutate(toy)
    assert ended.returncode == 2
    assert "solver/toy/toy.hpp: two no longer applies: '2 + 0' is not there" in ended.stderr
    assert set(verdicts(toy)) == {"one", "unread"}  # the others are tried all the same
    assert mutate(toy, "--check").returncode == 2


def test_unknown_names_are_refused(toy):
    ended = mutate(toy, "--only", "nothing")
    assert ended.returncode == 2 and "no fault has nothing in its file or name" in ended.stderr


def preprocessed(directory, name):
    return subprocess.run(["g++", "-std=c++20", "-I.", "-E", name], cwd=directory, check=True, capture_output=True, text=True).stdout


def test_who_calls_no_law_is_compiled_as_without_faults(toy, tmp_path):
    for name, text in (("scene/scene.hpp", '#include "solver/toy/toy.hpp"\n'), ("output/name.cpp", '#include "solver/scene/scene.hpp"\n'),
                       ("run/call.cpp", '#include "solver/scene/scene.hpp"\nint called() { return one(); }\n'),
                       ("run/call.hpp", '#include "solver/toy/toy.hpp"\nint called();\n'),
                       ("tests/run/test_call.cpp", '#include "solver/run/call.hpp"\n')):
        (toy / "solver" / name).parent.mkdir(parents=True, exist_ok=True)
        (toy / "solver" / name).write_text(text)
    places, _ = listed.places(listed.read(toy / "ci/mutants"), toy)
    tree.write(toy, tmp_path / "tree", places)
    for name in ("solver/output/name.cpp", "solver/tests/run/test_call.cpp"):
        assert preprocessed(tmp_path / "tree", name) == preprocessed(toy, name)  # the cache has it
    for name in ("solver/run/call.cpp", "solver/toy/main.cpp"):
        assert "1 + 1" in preprocessed(tmp_path / "tree", name)


def test_a_python_file_is_altered_and_put_back(toy, tmp_path):
    module = load_program()
    (toy / "compare").mkdir()
    (toy / "compare/sums.py").write_text("def twice(x):\n    return 2 * x\n")
    mutant = listed.Mutant("compare/sums.py", "three", "2 * x", "3 * x")
    place = listed.place(mutant, (toy / "compare/sums.py").read_text())
    with module.tree.Altered(toy, mutant, place):
        assert "return 3 * x" in (toy / "compare/sums.py").read_text()
    assert "return 2 * x" in (toy / "compare/sums.py").read_text()
