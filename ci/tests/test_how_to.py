"""docs/how-to: the blocks of its pages are run as they stand."""

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
PAGES = ROOT / "docs/how-to"
RELEASE = ROOT / "build/release"


def blocks(page, language):
    """The blocks of a page in that language, without the indentation of their list."""
    found = re.findall(rf"^( *)```{language}\n(.*?)^ *```$", (PAGES / page).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    assert found, f"{page} has no block of {language}"
    return ["".join(line.removeprefix(indent) for line in text.splitlines(keepends=True)) for indent, text in found]


def call(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)


def program(path):
    file = RELEASE / path
    assert file.exists(), f"{file} is missing; `make build` builds it"
    return file


def compile_only(text, path, tmp_path):
    """Compiles a source of the repository with another text: syntax and types, no code."""
    source = tmp_path / path.name
    source.write_text(text, encoding="utf-8")
    return call("g++", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{ROOT}", source)


@pytest.fixture
def scene(tmp_path):
    """The scene of the page, beside the cases it is a change of."""
    cases = tmp_path / "cases"
    shutil.copytree(ROOT / "cases", cases)
    (cases / "small.toml").write_text(blocks("scene.md", "toml")[0], encoding="utf-8")
    return cases / "small.toml"


def test_the_scene_is_accepted(scene):
    assert blocks("scene.md", "sh") == ["granvof check cases/small.toml\n"]
    done = call(program("solver/granvof"), "check", scene)
    assert done.returncode == 0, done.stderr
    assert "height = 0.025" in done.stdout and "friction = 0.4" in done.stdout


def test_the_record_goes_with_the_scene(scene):
    settings, plan = blocks("record.md", "toml")
    scene.write_text(scene.read_text(encoding="utf-8") + settings, encoding="utf-8")
    done = call(program("solver/granvof"), "check", scene)
    assert done.returncode == 0, done.stderr
    assert "slice_depth = 0.004" in done.stdout
    sys.path.insert(0, str(ROOT / "reference"))
    from recorder import Run
    run = Run(**tomllib.loads(plan)["run"][0])
    assert run.arguments == ["run", "cases/small.toml", "--seed", "1"]


def test_the_check_is_planned(tmp_path):
    table = tmp_path / "checks.toml"
    table.write_text((ROOT / "compare/checks.toml").read_text(encoding="utf-8") + blocks("check.md", "toml")[0], encoding="utf-8")
    done = call(program("compare/granvof-compare"), "plan", "--checks", table, "--frequency", "nightly")
    assert done.returncode == 0, done.stderr
    assert "s1-long\ts1\ttime.end=12" in done.stdout.splitlines()


def test_the_metric_compiles_in_its_place(tmp_path):
    registry = ROOT / "compare/checks/registry.cpp"
    function, entry = blocks("metric.md", "cpp")
    text = registry.read_text(encoding="utf-8")
    for marker, block in (("constexpr Needs none{};", function), ("\n};\n\n}  // namespace", entry)):
        assert text.count(marker) == 1, f"registry.cpp: where does it begin, '{marker.strip()}'?"
        text = text.replace(marker, f"\n{block}{marker}" if block == entry else f"{block}\n{marker}")
    done = compile_only(text, registry, tmp_path)
    assert done.returncode == 0, done.stderr


def test_the_closure_passes_its_test(tmp_path):
    header, line, test = blocks("closure.md", "cpp")
    listed = (ROOT / "solver/closures/drag/laws.hpp").read_text(encoding="utf-8")
    mine = '#include "solver/closures/drag/stokes.hpp"\n'
    changed = re.sub(r"struct DragLaws : [^;]*;\n", line, listed).replace("#pragma once\n", f"#pragma once\n{mine}")
    for name, text in ((header.split()[1], header), ("solver/closures/drag/laws.hpp", changed), (test.split()[1], test)):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    built = call("g++", "-std=c++20", "-Wall", "-Wextra", "-Werror", f"-I{tmp_path}", f"-I{ROOT}", tmp_path / test.split()[1], "-lgtest",
                 "-lgtest_main", "-o", tmp_path / "test")
    assert built.returncode == 0, built.stderr
    done = call(tmp_path / "test")
    assert done.returncode == 0 and "1 test" in done.stdout


def test_a_further_choice_of_each_list_is_a_header_and_a_line(tmp_path):
    lists = sorted((ROOT / "solver/closures").glob("*/laws.hpp"))
    page = (PAGES / "closure.md").read_text(encoding="utf-8")
    assert all(f"closures/{laws.parent.name}/laws.hpp)" in page for laws in lists), "the page does not have every list"
    for laws in lists:
        text = laws.read_text(encoding="utf-8")
        line, choices, first = re.search(r"struct \w+ :\s+(Choices<((\w+)[^>]*)>) {};", text).group(0, 2, 3)
        folder = tmp_path / laws.parent.relative_to(ROOT)
        folder.mkdir(parents=True)
        (folder / "another.hpp").write_text(
            f'#pragma once\n#include "solver/model/choices.hpp"\nnamespace granvof::closures {{\nstruct {first}Too : {first} {{\n'
            '  static constexpr ClosureFacts facts{"another", "a test"};\n};\n}\n', encoding="utf-8")
        mine = f'#include "{(laws.parent / "another.hpp").relative_to(ROOT).as_posix()}"\n\nnamespace granvof::closures {{'
        text = text.replace(line, line.replace(choices, f"{choices}, {first}Too")).replace("\nnamespace granvof::closures {", mine, 1)
        (folder / "laws.hpp").write_text(text, encoding="utf-8")
    # Whoever reads a list: the keys, and the operators.
    for reader in ("scene/keys_of_model.cpp", "scene/keys.cpp", "operators/momentum_predictor.cpp", "operators/coupled_pressure.cpp",
                   "plausibility/plausibility_idle.cpp", "run/initial_state.cpp", "operators/packing.cpp",
                   "operators/friction_law.cpp", "operators/granular_temperature.cpp", "operators/interphase_drag.cpp"):
        built = call("g++", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fopenmp", "-fsyntax-only", f"-I{tmp_path}", f"-I{ROOT}",
                     ROOT / "solver" / reader)
        assert built.returncode == 0, built.stderr


def test_the_side_passes_its_test(tmp_path):
    for block in blocks("side.md", "cpp"):
        file = tmp_path / re.match(r"// (\S+)\n", block)[1]
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block, encoding="utf-8")
    built = call("g++", "-std=c++20", "-Wall", "-Wextra", "-Werror", f"-I{ROOT}", *sorted(tmp_path.rglob("*.cpp")), "-lgtest",
                 "-lgtest_main", "-o", tmp_path / "test")
    assert built.returncode == 0, built.stderr
    done = call(tmp_path / "test")
    assert done.returncode == 0 and "1 test" in done.stdout


def test_a_kind_of_side_is_met_in_the_places_listed():
    listed = set(re.findall(r"\]\(\.\./\.\./([^)]*\.[ch]pp)\)", (PAGES / "side.md").read_text(encoding="utf-8")))
    asks = {path.relative_to(ROOT).as_posix() for folder in ("solver", "reference", "compare") for kind in ("*.hpp", "*.cpp")
            for path in (ROOT / folder).rglob(kind)
            if "tests" not in path.parts and re.search(r"SideKind", path.read_text(encoding="utf-8"))}
    assert asks <= listed, "files that ask for the kind of a side, and are not on the page"
