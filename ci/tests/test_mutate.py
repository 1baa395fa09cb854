"""ci/mutate: the list of faults, the switches, who notices, and a small project from end to end."""

import importlib.machinery
import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "ci"))

from mutation import cpp, listed, process, rows, tests, told  # noqa: E402

MUTATE = ROOT / "ci/mutate"


def load_program():
    spec = importlib.util.spec_from_loader("mutate", importlib.machinery.SourceFileLoader("mutate", str(MUTATE)))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


SOURCE = """// Two sums. With a + b in a comment.
#pragma once

#include <algorithm>

inline constexpr double offset = 0.5;  // metres
inline double twice(double a, double b) {
  const double most = std::max(a, b);
  return 2.0 * a + b * most;
}
inline double halved(double a) {
  double sum = offset;
  if (a > 0.0) sum += a;
  for (int i = 0; i < 3; ++i) {
    sum *= 0.5;
  }
  return a < 0.0 ? -sum : sum;
}
inline double across(const double* from, int at) {
  for (int i = 0; i < 0; ++i) {
    at += i;
  }
  return from[1 + at] - from[0];
}
inline double within(double a, bool lower) {
  double least = 0.0, most = 9.0;
  (lower ? least : most) += 1.0;
  return std::clamp(a, least, most);
}
"""


def fault(was, now, **more):
    return listed.Mutant("toy/sums.hpp", was, was, now, **more)


def switched(*faults):
    return cpp.switched(SOURCE, [(*listed.place(mutant, SOURCE), mutant.number) for mutant in faults])


def test_the_list_of_this_project_applies():
    mutants = listed.read(ROOT / "ci/mutants")
    places, gone = listed.places(mutants, ROOT)
    assert not gone
    assert len(places) >= 150
    for file in {mutant.file for mutant in mutants if mutant.compiled}:
        own = [(*place, mutant.number) for mutant, place in places.items() if mutant.file == file]
        cpp.switched((ROOT / file).read_text(encoding="utf-8"), own)  # each can be switched


def test_a_place_is_found_in_any_spacing_and_not_in_comments():
    assert SOURCE[slice(*listed.place(fault("a+b*most", "a-b*most"), SOURCE)[:2])] == "+"
    with pytest.raises(listed.ListError, match="no longer applies: 'a \\+ b in' is not there"):
        listed.place(fault("a + b in", "a - b in"), SOURCE)


def test_what_no_longer_applies_is_named():
    with pytest.raises(listed.ListError, match="sums.hpp: sum \\* 3 no longer applies: 'sum \\* 3' is not there"):
        listed.place(fault("sum * 3", "sum"), SOURCE)
    with pytest.raises(listed.ListError, match="stands there 2 times"):
        listed.place(fault("0.5", "0.6"), SOURCE)
    assert listed.place(fault("0.5", "0.6", after="for ("), SOURCE)[0] > SOURCE.index("for (")
    with pytest.raises(listed.ListError, match="'while' is not there"):
        listed.place(fault("0.5", "0.6", after="while"), SOURCE)


def test_a_number_is_no_part_of_another():
    assert listed.place(fault("offset = 0.5", "offset = 0.6"), SOURCE.replace("0.5;  //", "0.5;  // 0.55"))
    with pytest.raises(listed.ListError):
        listed.place(fault("offset = 0", "offset = 1"), SOURCE)


@pytest.mark.parametrize("entry, said", [
    ("a = { was = 'x' }", "needs `was` and `now`"), ("a = { was = 'x', now = 'x' }", "another than `was`"),
    ("a = { was = 'x', now = 'y', often = 'z' }", "needs `was` and `now`"), ("a = 3", "needs `was` and `now`"), ("", "no faults")])
def test_a_bad_list_is_refused(tmp_path, entry, said):
    (tmp_path / "toy.toml").write_text(f'["toy/sums.hpp"]\n{entry}\n')
    with pytest.raises(listed.ListError, match=said):
        listed.read(tmp_path)


FAULTS = (
    fault("2.0 * a + b", "2.0 * a - b"),        # a term's sign
    fault("std::max(a", "std::min(a"),          # min for max
    fault("offset = 0.5", "offset = 0.6"),      # a constant, set when the program starts
    fault("if (a > 0.0) sum += a;", ""),        # a statement dropped
    fault("sum *= 0.5", "sum *= 0.25"),         # within a loop
    fault("a < 0.0 ? -sum", "a < 0.0 ? sum"),   # a branch
    fault("b * most", "b"),                     # within the place of the first
    fault("from[1 + at] - from[0]", "from[1] - from[0 + at]"),  # indices, whose differing piece has half a bracket at each end
    fault("lower ? least : most", "lower ? most : least"),      # a condition, on the left of an assignment
    fault("std::clamp(a, least, most)", "std::clamp(2.0 * a, least + 1.0, most)"),  # several arguments
)


@pytest.fixture(scope="module")
def sums(tmp_path_factory):
    """A program that prints what its functions give, with all faults in it."""
    place = tmp_path_factory.mktemp("sums")
    (place / "sums.hpp").write_text(switched(*FAULTS))
    (place / "main.cpp").write_text('#include "sums.hpp"\n#include <cstdio>\n'
                                    'int main() {\n  const double from[] = {1.0, 2.0, 4.0};\n'
                                    '  std::printf("%g %g %g %g", twice(1.0, 3.0), halved(2.0), halved(-1.0), across(from, 1));\n'
                                    '  std::printf(" %g %g", within(0.0, true), within(20.0, false));\n}\n')
    subprocess.run(["g++", "-std=c++20", "-O1", "-I", ROOT, "-I", place, place / "main.cpp", "-o", place / "sums"], check=True)
    return place / "sums"


def printed(sums, **environment):
    return subprocess.run([sums], env={**os.environ, **environment}, check=True, capture_output=True, text=True).stdout


def test_without_a_fault_the_program_is_what_it_was(sums):
    assert printed(sums) == "11 0.3125 -0.0625 3 1 10"


@pytest.mark.parametrize("mutant, expected", zip(FAULTS, (
    "-7 0.3125 -0.0625 3 1 10", "5 0.3125 -0.0625 3 1 10", "11 0.325 -0.075 3 1 10", "11 0.0625 -0.0625 3 1 10", "11 0.0390625 -0.0078125 3 1 10",
    "11 0.3125 0.0625 3 1 10", "5 0.3125 -0.0625 3 1 10", "11 0.3125 -0.0625 0 1 10",
    "11 0.3125 -0.0625 3 0 9", "11 0.3125 -0.0625 3 2 10")), ids=lambda value: getattr(value, "name", None))
def test_each_fault_alone(sums, mutant, expected):
    assert printed(sums, GRANVOF_MUTANT=mutant.number) == expected


def test_what_is_reached_is_noted(sums, tmp_path):
    printed(sums, GRANVOF_MUTANTS_REACHED=str(tmp_path / "reached"))
    assert set((tmp_path / "reached").read_text().split()) == {mutant.number for mutant in FAULTS}


def test_what_the_compiler_decides_is_refused():
    text = "void f() {\n  if constexpr (x > 1) g();\n}\n"
    mutant = listed.Mutant("toy/f.cpp", "n", "x > 1", "x > 2")
    with pytest.raises(cpp.NoPlace, match="decided by the compiler"):
        cpp.switched(text, [(*listed.place(mutant, text), mutant.number)])


def test_all_that_a_loop_does_may_be_dropped(tmp_path):
    text = "int f(int n) {\n  int sum = 0;\n  for (int i = 0; i < n; ++i)\n    if (i != 1) sum += i;\n  return sum;\n}\n"
    dropped = text.index("if (i"), text.index("  return")
    switched = cpp.switched(text, [(dropped[0], text.index("\n", dropped[0]), "", "1")])
    (tmp_path / "f.cpp").write_text(switched + "int main() { return f(4); }\n")
    assert subprocess.run(["g++", "-std=c++20", f"-I{ROOT}", "-o", tmp_path / "f", tmp_path / "f.cpp"]).returncode == 0
    assert [subprocess.run([tmp_path / "f"], env={"GRANVOF_MUTANT": number}).returncode for number in ("", "1")] == [5, 0]


def test_what_a_condition_returns_is_switched_behind_it():
    text = "double f(double a) {\n  if (a > g(0.0)) return 2.0 * a;\n  else if constexpr (b) return 5.0;\n  throw a;\n}\n"
    for was, now in [("2.0 * a", "3.0 * a"), ("5.0", "6.0")]:
        mutant = fault(was, now)
        changed = cpp.switched(text, [(*listed.place(mutant, text), mutant.number)])
        assert re.search(r"\) return \(::granvof::mutation::on<\w+>\(\) \? \(" + re.escape(now), changed)


def test_a_text_is_switched_as_a_whole():
    text = 'const char* f() {\n  return g("old name", 1);\n}\n'
    mutant = listed.Mutant("toy/f.cpp", "n", 'g("old name"', 'g("new name"')
    assert f'g((::granvof::mutation::on<0x{mutant.number}u>() ? ("new name") : ("old name")), 1)' in \
        cpp.switched(text, [(*listed.place(mutant, text), mutant.number)])


def test_the_number_of_a_fault_survives_edits_elsewhere():
    assert fault("a", "b").number == fault("a", "b", why="none").number
    assert fault("a", "b").number != fault("a", "c").number


def a_test(name, program, reached, folder="solver/run", seconds=0.1, ladder="unit", by=""):
    return tests.Test(name, ladder, str(program), [], by, folder, {}, seconds, reached)


def shell(path, text):
    path.write_text("#!/bin/sh\n" + text)
    path.chmod(0o755)
    return path


def test_own_folder_first_and_up_to_the_first_that_fails(tmp_path):
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


def test_a_program_that_does_not_end_is_noticed(tmp_path, monkeypatch):
    monkeypatch.setattr(tests, "PATIENCE", 0.3)
    mutant = listed.Mutant("solver/run/a.cpp", "n", "a", "b")
    there = [a_test("loops", shell(tmp_path / "loops", "sleep 60 & sleep 60\n"), [mutant.number], seconds=0.0)]
    assert tests.judge(there, mutant, tmp_path, tmp_path) == ("noticed", "loops")


def test_the_failed_test_of_a_program_is_named():
    said = "[ RUN      ] Drag.Ergun\n[  FAILED  ] Drag.Ergun (0 ms)\n[  FAILED  ] 1 test, listed below:\n"
    assert tests.noticed_by([a_test("Drag.Ergun", "test_closures", [], by="Drag.Ergun")], process.Ended(1, said)) == "Drag.Ergun"
    assert tests.noticed_by([a_test("Drag.Ergun", "test_closures", [], by="Drag.Ergun")],
                            process.Ended(-11, "")) == "test_closures, ended by SIGSEGV"


# Rows: granvof writes its case's number, 2 with the fault of this number where the case is s2.
STANDS_FOR_SOLVER = """[ "$GRANVOF_MUTANTS_REACHED" ] && echo 0000000{reached} >> "$GRANVOF_MUTANTS_REACHED"
mkdir -p "$4/"; value=1; [ "$2 $GRANVOF_MUTANT" = "cases/s2.toml 00000001" ] && value=2
[ "$GRANVOF_MUTANT" = 00000003 ] && exit 3
echo $value > "$4/value"
"""
STANDS_FOR_COMPARE = """import json, os, pathlib, sys
if sys.argv[1] == "plan":
    print("s1\\ts1\\ns2\\ts2\\tgrid.dx=1\\ndear\\ts1")
else:
    runs, out = (pathlib.Path(sys.argv[sys.argv.index(key) + 1]) for key in ("--runs", "--out"))
    if note := os.environ.get("GRANVOF_MUTANTS_REACHED"):
        open(note, "a").write("00000002\\n")
    limit = 0 if os.environ.get("GRANVOF_MUTANT") == "00000002" else 1
    out.mkdir(parents=True)
    rows = [{"id": f"{run.name}.row", "scene": run.name, "verdict": "agrees" if int((run / "value").read_text()) <= limit else "differs"}
            for run in sorted(runs.iterdir())]
    (out / "results.json").write_text(json.dumps({"results": rows}))
    sys.exit(1)
"""


@pytest.fixture
def stand_ins(tmp_path):
    tree = tmp_path / "tree"
    for name in ("build/release/solver", "build/release/compare", "compare/kept/verify"):
        (tree / name).mkdir(parents=True)
    shell(tree / "build/release/solver/granvof", STANDS_FOR_SOLVER.replace("{reached}", "1"))
    compare = tree / "build/release/compare/granvof-compare"
    compare.write_text("#!/usr/bin/python3\n" + STANDS_FOR_COMPARE)
    compare.chmod(0o755)
    costs = {name: {"core_seconds": cost} for name, cost in (("s2", 1.0), ("s1", 0.5), ("dear", 1e3))}
    (tree / "compare/kept/verify/results.json").write_text(json.dumps({"costs": costs}))
    made = rows.Rows(tree, tmp_path / "work", tmp_path)
    said = []
    assert made.without_fault(said.append) == ""
    return made, said


def test_what_noticed_most_for_its_cost_is_made_first(stand_ins):
    made, _ = stand_ins
    made.seconds |= {"s1": 1.0, "s2": 2.0, "check": 0.0}
    assert [run[0] for run in made.in_order(made.runs)] == ["s1", "s2"]
    for _ in range(2):
        assert made.judge(Numbered("00000001"))[1] == "s2.row: agrees -> differs"
    assert [run[0] for run in made.in_order(made.runs)] == ["s2", "s1"]


class Numbered:
    def __init__(self, number):
        self.number = number


def test_rows_try_the_cheap_runs_in_order_of_their_cost(stand_ins):
    made, said = stand_ins
    assert [run[0] for run in made.runs] == ["s1", "s2"]
    assert [line.split(": ")[1].split(",")[0] for line in said] == ["s1", "s2"]
    assert made.base == {"s1.row": "agrees", "s2.row": "agrees"}


def test_the_row_that_changes_is_named(stand_ins):
    made, _ = stand_ins
    assert made.judge(Numbered("00000001")) == ("noticed", "s2.row: agrees -> differs")
    assert (made.work / "runs/s2/value").read_text() == "1\n"  # what was made without a fault stays


def test_a_fault_of_the_comparison_makes_no_run_again(stand_ins):
    made, _ = stand_ins
    (made.tree / "build/release/solver/granvof").unlink()
    assert made.judge(Numbered("00000002")) == ("noticed", "s1.row: agrees -> differs")


def test_a_run_that_fails_is_noticed_and_what_nothing_reaches_is_said(stand_ins):
    made, _ = stand_ins
    made.reached["s1"].add("00000003")
    assert made.judge(Numbered("00000003")) == ("noticed", "run s1: exit code 3")
    assert made.judge(Numbered("00000004")) == ("not reached", "")


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
    assert "4 of them have been tried: 2 were noticed (50.0 %), 1 by nobody, 1 are not yet tried against all" in shown["text"][0]
    assert shown["tables"][0]["rows"][0] == ["solver/run", 4, "1 of 4", "1 of 2", "0 of 1", 2, 1, 0]
    assert [row[1] for row in shown["tables"][1]["rows"]] == ["missed", "open"]
    assert [row[3:] for row in shown["tables"][2]["rows"]] == [["T.t", "–", "survived"], ["survived", "T.t", "–"]]


def test_a_reason_takes_a_fault_out_of_the_score():
    mutant, found = entry("equal", unit="survived", ladder="survived")
    excused = listed.Mutant(mutant.file, mutant.name, mutant.was, mutant.now, why="the same in other words")
    shown = told.section([excused], {excused.number: found}, "c")
    assert "1 of them have been tried: 0 were noticed, 0 by nobody, 0 are not yet tried against all, 1 cannot" in shown["text"][0]
    assert shown["tables"][1]["rows"][0][3] == "the same in other words"


# A project of one header, one program and its tests: 1 notices what 2 does not, and nothing looks at `unread`.
TOY = {
    "solver/toy/toy.hpp": "#pragma once\n\n#include <cstdlib>\n\ninline int one() {\n  return 1 + 0;\n}\n"
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


def test_a_python_file_is_altered_and_put_back(toy, tmp_path):
    module = load_program()
    (toy / "compare").mkdir()
    (toy / "compare/sums.py").write_text("def twice(x):\n    return 2 * x\n")
    mutant = listed.Mutant("compare/sums.py", "three", "2 * x", "3 * x")
    place = listed.place(mutant, (toy / "compare/sums.py").read_text())
    with module.tree.Altered(toy, mutant, place):
        assert "return 3 * x" in (toy / "compare/sums.py").read_text()
    assert "return 2 * x" in (toy / "compare/sums.py").read_text()
