"""Faults as switches in C++ text: where each is put, and what a program does with each."""

import os
import re
import subprocess
from pathlib import Path

import pytest

from mutation import cpp, listed

ROOT = Path(__file__).resolve().parent.parent.parent
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


def test_a_constant_of_a_list_is_set_when_the_program_starts(tmp_path):
    text = "struct Unit {\n  int name, seconds;\n};\nconstexpr Unit units[] = {Unit{1, 60}, Unit{2, 36}};\nint f(int i) { return units[i].seconds; }\n"
    faults = [(text.index(was), text.index(was) + 2, now, number) for was, now, number in (("60", "61", "2"), ("36", "30", "1"))]
    (tmp_path / "f.cpp").write_text(cpp.switched(text, faults) + "int main(int n, char**) { return f(n); }\n")
    assert subprocess.run(["g++", "-std=c++20", f"-I{ROOT}", "-o", tmp_path / "f", tmp_path / "f.cpp"]).returncode == 0
    assert [subprocess.run([tmp_path / "f"], env={"GRANVOF_MUTANT": number}).returncode for number in ("", "1")] == [36, 30]


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
