"""Loops over values of a grid: one place starts threads, one reduces over all processes, and bodies own what they hold."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SOLVER = ROOT / "solver"
LOOPS = SOLVER / "grid/for_each.hpp"
REDUCTIONS = SOLVER / "grid/reduce.hpp"
SUM_OF_PARTS = SOLVER / "grid/sum_of_parts.hpp"
SOURCES = {path: path.read_text(encoding="utf-8") for kind in ("*.hpp", "*.cpp") for path in sorted(SOLVER.rglob(kind))
           if not {"tests", "bench"} & set(path.parts)}
CALL = re.compile(r"\b(for_each|sum_over|max_over|moment_over)\(")
BODY = re.compile(r"\[([^\[\]]*)\]\((?:std::ptrdiff_t|const Obstacles::Edge)")


def bodies(text):
    """Capture lists of the bodies that the text's loops are given."""
    for call in CALL.finditer(text):
        rest = text[call.end():]
        body = BODY.search(rest)
        nearest = CALL.search(rest)
        if body and not (nearest and nearest.start() < body.start()) and rest.find(";") > body.start():
            yield body.group(1)


def test_one_place_starts_threads():
    starting = {path for path, text in SOURCES.items() if re.search(r"#pragma omp (parallel|for|task|sections)", text)}
    assert starting == {LOOPS, REDUCTIONS}


def test_sums_and_largest_values_of_a_process_alone_are_for_the_layer():
    assert {path for path, text in SOURCES.items() if "of_process" in text} == {REDUCTIONS, SUM_OF_PARTS}


def test_what_adds_up_by_rows_hands_it_to_the_layer():
    """In operators and the time loop a simd reduction is the body of sum_rows: what it returns is summed over all."""
    found = 0
    for path, text in SOURCES.items():
        if path.parent.name not in ("operators", "run"):
            continue
        for pragma in re.finditer(r"#pragma omp simd reduction\(\+ : ([\w, ]+)\)", text):
            found += 1
            before = text[:pragma.start()]
            assert "sum_rows(" in before[before.rfind(";\n  const"):], path
            names = pragma.group(1).replace(" ", "").split(",")
            after = text[pragma.end():]
            returned = re.search(r"return Sums<\d+>\{\{([\w, ]+)\}\}", after)
            assert returned and returned.group(1).replace(" ", "").split(",") == names, path
    assert found >= 2


def test_bodies_capture_by_value():
    found = 0
    for path, text in SOURCES.items():
        for captured in bodies(text):
            found += 1
            assert captured.startswith("=") and "&" not in captured and "this" not in captured, (path, captured)
    assert found > 100


def test_these_checks_see():
    assert list(bodies("for_each(l, r, [=, &law](std::ptrdiff_t c) { p[c] = law(c); });")) == ["=, &law"]
    assert list(bodies("x = sum_over(l, r, term);\nconst auto f = [&](std::ptrdiff_t c) { return 0; };")) == []
