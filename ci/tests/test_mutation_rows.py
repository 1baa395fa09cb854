"""The rows of `make verify` against a fault: which runs are made again, in which order, and which rows count."""

import json

import pytest

from mutation import rows

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
    value = {run.name: int((run / "value").read_text()) for run in sorted(runs.iterdir())}
    rows = [{"id": f"{name}.row", "scene": name, "reference_kind": "theory",
             "verdict": "not run" if name not in value else "agrees" if value[name] <= limit else "differs"}
            for name in ("s1", "s2", "dear", "like")]
    rows.insert(0, {"id": "like.difference-s2", "scene": "like", "against": "s2", "reference_kind": "theory",
                    "verdict": "agrees" if value.get("like") == value.get("s2") else "differs"})
    rows.insert(0, {"id": "s2.core_seconds", "scene": "s2", "reference_kind": "aim",
                    "verdict": "agrees" if out.name == "verdicts" else "differs"})
    (out / "results.json").write_text(json.dumps({"results": rows}))
    sys.exit(1)
"""


@pytest.fixture
def stand_ins(tmp_path, shell):
    tree = tmp_path / "tree"
    for name in ("build/release/solver", "build/release/compare", "compare/kept/verify"):
        (tree / name).mkdir(parents=True)
    shell(tree / "build/release/solver/granvof", STANDS_FOR_SOLVER.replace("{reached}", "1"))
    compare = tree / "build/release/compare/granvof-compare"
    compare.write_text("#!/usr/bin/python3\n" + STANDS_FOR_COMPARE)
    compare.chmod(0o755)
    costs = {name: {"core_seconds": cost} for name, cost in (("s2", 1.0), ("dear", 1e3))}
    (tree / "compare/kept/verify/results.json").write_text(json.dumps({"costs": costs}))
    (tree / "compare/checks.toml").write_text("rows")
    (tmp_path / "verified/dear").mkdir(parents=True)
    (tmp_path / "verified/dear/value").write_text("1")
    made = rows.Rows(tree, tmp_path / "work", tmp_path, made=tmp_path / "verified")
    said = []
    assert made.without_fault(said.append) == ""
    return made, said


def test_what_noticed_most_for_its_cost_is_made_first(stand_ins):
    made, _ = stand_ins
    made.seconds |= {"s1": 1.0, "s2": 2.0, "check": 0.0}
    assert [run[0] for run in made.in_order(made.runs)] == ["s1", "s2"]
    for _ in range(2):
        assert judge(made, "00000001")[1] == "s2.row: agrees -> differs"
    assert [run[0] for run in made.in_order(made.runs)] == ["s2", "s1"]


class Numbered:
    def __init__(self, number):
        self.number = number


def judge(made, number, known=""):
    return made.judge(Numbered(number), made.scratch, known)


def test_rows_try_the_cheap_runs_in_order_of_their_cost(stand_ins):
    made, said = stand_ins  # nothing is kept of s1, which is new
    assert [run[0] for run in made.runs] == ["s1", "s2"]
    assert [line.split(": ")[1].split(",")[0] for line in said] == ["s1", "s2"]
    assert [made.base[f"{name}.row"] for name in ("s1", "s2", "dear")] == ["agrees"] * 3  # as make verify has made it


def test_what_was_found_without_a_fault_is_for_one_table_of_checks(stand_ins):
    made, said = stand_ins
    said.clear()
    assert made.without_fault(said.append) == "" and said == []
    (made.tree / "compare/checks.toml").write_text("other rows")
    assert made.without_fault(said.append) == "" and len(said) == 2


def test_the_row_that_changes_is_named(stand_ins):
    made, _ = stand_ins
    assert judge(made, "00000001") == ("noticed", "s2.row: agrees -> differs")
    assert (made.work / "runs/s2/value").read_text() == "1\n"  # what was made without a fault stays


def test_a_fault_of_the_comparison_makes_no_run_again(stand_ins):
    made, _ = stand_ins
    (made.tree / "build/release/solver/granvof").unlink()
    made.base["s1.row"] = made.base["s2.row"] = "differs"  # as if no cheap run told of it
    assert judge(made, "00000002") == ("noticed", "dear.row: agrees -> differs")


def test_a_run_that_fails_is_noticed_and_what_nothing_reaches_is_said(stand_ins):
    made, _ = stand_ins
    made.reached["s1"].add("00000003")
    assert judge(made, "00000003") == ("noticed", "run s1: exit code 3")
    assert judge(made, "00000004") == ("not reached", "")


def test_what_a_run_costs_is_not_asked(stand_ins):
    made, _ = stand_ins
    made.reached["s1"].add("00000005")
    assert judge(made, "00000005") == ("survived", "")  # the row of core_seconds is another at each call


def test_two_runs_are_held_against_each_other_once_both_have_the_fault(stand_ins):
    made, _ = stand_ins
    like = ("like", "s2", [])
    made.runs.append(like)
    made.make(like, made.work / "runs", 10.0, {}, made.scratch)
    made.seconds |= {"s1": 3.0, "s2": 2.0, "like": 0.01, "check": 0.0}
    made.reached |= {"like": {"00000001"}, "s1": set()}
    made.base |= {"like.difference-s2": "agrees", "like.row": "agrees"}
    # "like" is made and judged first: between it and the s2 without the fault the difference shows any fault
    assert judge(made, "00000001")[1] == "like.row: agrees -> differs"
    made.base |= {"like.row": "differs", "s2.row": "differs"}  # as if no value told of it
    assert judge(made, "00000001") == ("survived", "")


def test_a_run_with_the_fault_is_not_held_against_one_that_is_too_dear_to_have_it(stand_ins):
    made, _ = stand_ins
    made.others.append("like")
    (made.work / "runs/like").mkdir()
    (made.work / "runs/like/value").write_text("1")
    made.seconds |= {"check": 0.0}
    made.base |= {"like.difference-s2": "agrees", "like.row": "agrees", "s2.row": "differs"}  # as if its value told nothing
    assert judge(made, "00000001") == ("survived", "")
