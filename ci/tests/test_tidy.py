"""ci/tidy on a small tree: what is checked, what is left alone, what a finding does."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
CONFIGURE = "#!/bin/sh\necho configured with $*\n"


@pytest.fixture
def tree(tmp_path):
    root = tmp_path / "tree"
    (root / "ci").mkdir(parents=True)
    shutil.copy(ROOT / "ci/tidy", root / "ci")
    (root / "solver/python").mkdir(parents=True)
    shutil.copy(ROOT / "solver/python/complaint.py", root / "solver/python")
    (root / "ci/build").write_text(CONFIGURE)
    (root / "ci/build").chmod(0o755)
    (root / ".clang-tidy").write_text("Checks: '-*,modernize-use-nullptr'\nWarningsAsErrors: '*'\nHeaderFilterRegex: '.*'\n")
    sources = {"solver/a.cpp": '#include "solver/a.hpp"\nint a() { return made(); }\n', "compare/b.cpp": "#ifdef AGAIN\nint* b = 0;\n#endif\n",
               "build/tidy/solver/generated.cpp": "int* c = 0;\n"}
    commands = []
    for name, text in sources.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        for flags in ("-std=c++20", "-std=c++20 -DAGAIN"):  # of two targets; the first one counts
            commands.append({"directory": str(root / "build/tidy"), "file": str(path),
                             "command": f"/usr/bin/c++ -I{root} {flags} -o {name}.o -c {path}"})
    (root / "solver/a.hpp").write_text("inline int made() { return 1; }\n")
    (root / "build/tidy/compile_commands.json").write_text(json.dumps(commands))
    return root


def tidy(root, *arguments):
    return subprocess.run([root / "ci/tidy", *arguments], capture_output=True, text=True, check=False,
                          env={**os.environ, "JOBS": "1"})


def checked(done):
    return [name for name in ("solver/a.cpp", "compare/b.cpp", "generated.cpp") if name in done.stdout]


def test_checks_each_source_once_and_no_generated_one(tree):
    first = tidy(tree)
    assert first.returncode == 0, first.stdout + first.stderr
    assert checked(first) == ["solver/a.cpp", "compare/b.cpp"]
    assert "2 sources are clean" in first.stdout
    again = tidy(tree)
    assert again.returncode == 0 and checked(again) == []


def test_checks_again_what_a_change_reaches(tree):
    assert tidy(tree).returncode == 0
    (tree / "solver/a.hpp").write_text("inline int made() { return 2; }\n")
    assert checked(tidy(tree)) == ["solver/a.cpp"]
    (tree / ".clang-tidy").write_text((tree / ".clang-tidy").read_text() + "# stricter\n")
    assert checked(tidy(tree)) == ["solver/a.cpp", "compare/b.cpp"]


def test_a_finding_in_a_header_fails_until_it_is_mended_and_the_rest_is_checked(tree):
    (tree / "solver/a.hpp").write_text("inline int* made() { return 0; }\n")
    (tree / "solver/a.cpp").write_text('#include "solver/a.hpp"\nint* a() { return made(); }\n')
    for attempt in ("first", "second"):
        done = tidy(tree)
        assert done.returncode != 0, attempt
        assert "a.hpp:1:" in done.stdout and "modernize-use-nullptr" in done.stdout
        assert "some have findings" in done.stdout
    assert (tree / "build/tidy/clean/compare.b.cpp").exists()
    (tree / "solver/a.hpp").write_text("inline int* made() { return nullptr; }\n")
    assert tidy(tree).returncode == 0


def test_takes_the_sources_that_match_and_refuses_when_none_does(tree):
    assert checked(tidy(tree, "^compare/")) == ["compare/b.cpp"]
    nothing = tidy(tree, "^nothing/")
    assert nothing.returncode == 2 and "no source matches ^nothing/" in nothing.stderr


def test_hands_on_what_to_do_about_the_reference_and_fails_with_the_configuration(tree):
    assert "configured with --reference=on tidy" in tidy(tree).stdout
    (tree / "ci/build").write_text("#!/bin/sh\necho broken >&2\nexit 1\n")
    done = tidy(tree, "--reference=required")
    assert done.returncode == 1 and "broken" in done.stderr
