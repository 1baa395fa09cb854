"""Libraries: scene and output are shared; no other part of the solver is in the programs that share them."""

import importlib.machinery
import importlib.util
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
BUILD = ROOT / "build/release"
SOLVER = ["solver/libgranvof.a", "solver/grid/libgranvof_grid.a", "solver/linear/libgranvof_linear.a"]


def functions(file):
    """Symbols of the functions that a file defines, those of templates and inline functions left out."""
    assert file.exists(), "`make build` builds the programs"
    said = subprocess.run(["nm", "--defined-only", file], capture_output=True, text=True, check=True).stdout
    return {line.split()[-1] for line in said.splitlines() if " T " in line and "granvof" in line}


def test_compare_links_no_solver():
    program = functions(BUILD / "compare/granvof-compare")
    shared = functions(BUILD / "solver/scene/libgranvof_scene.a") | functions(BUILD / "solver/output/libgranvof_output.a")
    assert len(program & shared) > 50  # the symbols are there to be found
    for library in SOLVER:
        theirs = functions(BUILD / library)
        assert theirs and not program & theirs, library


@pytest.fixture
def architecture():
    loader = importlib.machinery.SourceFileLoader("architecture", str(ROOT / "docs/architecture.py"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("architecture", loader))
    loader.exec_module(module)
    return module


@pytest.mark.parametrize("part, target, allowed", [
    ("compare/study", "solver/output/seal.hpp", True), ("compare/study", "compare/engine/engine.hpp", True),
    ("compare/study", "solver/run/run_case.hpp", False), ("compare/checks", "solver/grid/grid.hpp", False),
    ("solver/output", "solver/state/state.hpp", False), ("solver/scene", "solver/output/digest.hpp", False),
    ("solver/run", "solver/output/digest.hpp", True), ("solver/run", "compare/input/run.hpp", False),
    ("reference/demvof/fluid", "solver/closures/drag/drag.hpp", True), ("reference/demvof/fluid", "solver/closures/units.hpp", False),
])
def test_an_include_across_a_border_is_refused(architecture, tmp_path, part, target, allowed):
    file = tmp_path / part / "it.cpp"
    file.parent.mkdir(parents=True)
    file.write_text(f'#include "{target}"\n')
    assert allowed != bool(list(architecture.trespasses(tmp_path)))


def test_every_column_that_compare_reads_is_one_of_the_series():
    """Of those in the code by name: what is misspelt would be a metric that is undefined."""
    stated = (ROOT / "docs/output.md").read_text(encoding="utf-8")  # which a test holds to extract.cpp
    columns = set(re.findall(r"^\| (\w+) \| [^|]+ \| ", stated, re.MULTILINE))
    read = {column for file in (ROOT / "compare").rglob("*.cpp") if "tests" not in file.parts
            for column in re.findall(r'curve\("(\w+)"\)', file.read_text(encoding="utf-8"))}
    assert len(read) > 15 and not read - columns
