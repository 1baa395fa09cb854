"""The shell scripts and make targets: honest messages and exit codes."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent


def call(*command, cwd=ROOT, **environment):
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
                          env={**os.environ, **environment})


@pytest.fixture
def bare(tmp_path):
    """A directory that holds ci/ and the Makefile alone, where setup does nothing."""
    shutil.copytree(ROOT / "ci", tmp_path / "ci", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "Makefile", tmp_path)
    (tmp_path / "ci/setup").write_text("#!/bin/sh\n")
    (tmp_path / "ci/nightly").unlink()
    return tmp_path


def programs(directory, *names, **scripts):
    """A PATH that holds these programs only, and scripts of the given text."""
    directory.mkdir()
    for name in names:
        (directory / name).symlink_to(shutil.which(name))
    for name, text in scripts.items():
        path = directory / name.replace("_", "-")
        path.write_text(text)
        path.chmod(0o755)
    return str(directory)


def test_setup_finds_that_nothing_is_missing():
    done = call("ci/setup", "--check")
    assert done.returncode == 0, done.stderr
    assert "nothing to install" in done.stdout


TOOLS = ("bash", "env", "dirname", "sort", "comm", "awk", "id")
KNOWS_NOTHING = "#!/bin/sh\nexit 1\n"


def test_setup_names_what_is_missing(tmp_path):
    path = programs(tmp_path / "bin", *TOOLS, dpkg_query=KNOWS_NOTHING, apt_get=KNOWS_NOTHING)
    done = call("ci/setup", "--check", PATH=path)
    assert done.returncode == 1
    assert "libeigen3-dev" in done.stderr and "libtomlplusplus-dev" in done.stderr


def test_setup_says_when_the_installation_fails(tmp_path):
    path = programs(tmp_path / "bin", *TOOLS, dpkg_query=KNOWS_NOTHING, apt_get=KNOWS_NOTHING,
                    sudo='#!/bin/sh\nexec "$@"\n')
    done = call("ci/setup", PATH=path)
    assert done.returncode == 1
    assert "'apt-get update' failed" in done.stderr


def test_setup_without_apt_says_what_to_do(tmp_path):
    done = call("ci/setup", PATH=programs(tmp_path / "bin", *TOOLS))
    assert done.returncode == 1
    assert "cmake --preset release" in done.stderr


@pytest.mark.parametrize("script, arguments", [("ci/setup", ["--all"]), ("ci/build", ["fast"]), ("ci/build", []),
                                               ("ci/build", ["--reference=maybe", "release"])])
def test_bad_arguments_are_refused(script, arguments):
    done = call(script, *arguments)
    assert done.returncode == 2
    assert done.stderr


@pytest.mark.parametrize("target", ["verify", "plots", "nightly", "reference"])
def test_target_without_its_part_fails_and_says_so(bare, target):
    done = call("make", target, cwd=bare)
    assert done.returncode != 0
    assert f"make {target}: not available yet" in done.stderr


def test_bench_without_programs_fails_and_says_so(tmp_path):
    done = call("ci/bench", str(tmp_path))
    assert done.returncode == 1
    assert "not available yet" in done.stderr


def test_required_reference_that_is_missing_fails_before_the_build(bare):
    done = call("ci/build", "--reference=required", "release", cwd=bare)
    assert done.returncode == 1
    assert "cannot be built: not available yet" in done.stderr


def test_help_lists_the_targets():
    done = call("make")
    assert done.returncode == 0
    for target in ("verify", "test", "reference", "plots", "nightly", "bench", "format", "help"):
        assert f"make {target} " in done.stdout


def test_a_build_folder_of_another_place_is_named(bare):
    (bare / "build/release").mkdir(parents=True)
    (bare / "build/release/CMakeCache.txt").write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/somewhere/else\n")
    done = call("ci/build", "release", cwd=bare)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1 and "/somewhere/else" in done.stderr and "rm -r build/release" in done.stderr
    assert "CMake" not in done.stderr


def test_a_place_with_blanks_is_one_argument(bare):
    programs_of_verify = bare / "compare"
    programs_of_verify.mkdir()
    (programs_of_verify / "verify").write_text('#!/bin/sh\nprintf "%s\\n" "$@"\n')
    (programs_of_verify / "verify").chmod(0o755)
    (bare / "ci/build").write_text("#!/bin/sh\n")
    for target in ("verify", "plots"):
        done = call("make", "-s", target, "OUT=a place/with blanks", cwd=bare)
        assert "a place/with blanks" in done.stdout.splitlines(), done


def test_what_is_left_out_with_the_reference_is_named_to_verify(bare):
    (bare / "compare").mkdir()
    (bare / "compare/verify").write_text('#!/bin/sh\nprintf "%s\\n" "$@"\n')
    (bare / "compare/verify").chmod(0o755)
    (bare / "ci/build").write_text("#!/bin/sh\n")
    assert "--without-canary" in call("make", "-s", "verify", "REFERENCE=off", cwd=bare).stdout
    assert "--without-canary" not in call("make", "-s", "verify", cwd=bare).stdout


def test_the_proof_of_slurm_removes_nobodys_files(tmp_path):
    (tmp_path / "notes.txt").write_text("mine\n")
    done = call(ROOT / "ci/slurm/prove", tmp_path / "build", tmp_path)
    assert done.returncode == 2 and "no earlier proof has made them" in done.stderr
    assert (tmp_path / "notes.txt").read_text() == "mine\n"
