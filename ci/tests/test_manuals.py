"""Man pages and completion are made of what the programs say of themselves."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent

STAND_IN = """#!/bin/sh
case "$1" in
  --version) echo 'prog 1.2' ;;
  go) printf 'Go somewhere\\nOptions:\\n  --far      .dot at the begin\\n  --near N   near-by\\n' ;;
  *) printf 'A program.\\nOptions:\\n  -h,--help  Help\\nSubcommands:\\n  go    Go somewhere\\n' ;;
esac
"""


@pytest.fixture
def made(tmp_path):
    program = tmp_path / "prog"
    program.write_text(STAND_IN)
    program.chmod(0o755)
    subprocess.run([ROOT / "ci/manuals", "--out", tmp_path / "made", program], check=True)
    return tmp_path / "made"


def test_the_page_has_every_option_of_every_subcommand(made):
    page = (made / "man1/prog.1").read_text()
    assert page.startswith('.TH PROG 1 "" "prog 1.2"\n.SH NAME\nprog \\- A program.\n')
    assert ".SH prog go" in page and "\\-\\-near N" in page


def test_the_completion_knows_subcommands_and_their_options(made):
    def words(*line):
        script = (f"source {made}/bash/prog; COMP_WORDS=({' '.join(repr(word) for word in line)}); COMP_CWORD={len(line) - 1}; _prog; "
                  'echo "${COMPREPLY[@]}"')
        return subprocess.run(["bash", "-c", script], check=True, capture_output=True, text=True).stdout.split()

    assert words("prog", "g") == ["go"]
    assert words("prog", "go", "--") == ["--far", "--near"]
    assert words("prog", "go", "--n") == ["--near"]
