"""`make install`: what is installed works without the sources."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    build = ROOT / "build/release"
    assert (build / "compare/granvof-compare").exists(), "`make build` builds the programs"
    into = tmp_path_factory.mktemp("installed")
    subprocess.run(["cmake", "--install", build, "--prefix", "/usr"], check=True, env=os.environ | {"DESTDIR": str(into)}, stdout=subprocess.DEVNULL)
    return into / "usr"


def test_the_programs_run_from_where_they_are(installed, tmp_path):
    case = installed / "share/granvof/cases/s1.toml"
    checked = subprocess.run([installed / "bin/granvof", "check", case], cwd=tmp_path, capture_output=True, text=True)
    assert checked.returncode == 0 and checked.stdout.startswith("# s1:"), checked.stderr
    plan = subprocess.run([installed / "bin/granvof-compare", "plan"], cwd=installed / "share/granvof", capture_output=True, text=True)
    assert plan.returncode == 0 and "s1\ts1" in plan.stdout, plan.stderr


def test_each_program_has_its_page_and_its_completion(installed):
    for program, word in (("granvof", "--picture"), ("granvof-compare", "--budget")):
        assert word in (installed / f"share/man/man1/{program}.1").read_text().replace("\\-", "-")
        assert word in (installed / f"share/bash-completion/completions/{program}").read_text()


def test_the_reference_has_them_too_where_it_is_built(installed):
    if not (ROOT / "build/release/reference/demvof/demvof").exists():
        pytest.skip("built without the reference")
    said = subprocess.run([installed / "bin/demvof", "--version"], capture_output=True, text=True)
    assert said.returncode == 0 and said.stdout.startswith("demvof 0."), said.stderr
    page = (installed / "share/man/man1/demvof.1").read_text().replace("\\-", "-")
    assert page.startswith('.TH DEMVOF 1 "" "demvof 0.') and ".SH demvof element" in page and "--gate-closed" in page
    assert "--gate-closed" in (installed / "share/bash-completion/completions/demvof").read_text()


def test_the_module_is_found(installed):
    subprocess.run(["/usr/bin/python3", "-c", "import granvof; granvof.load"], check=True,
                   env=os.environ | {"PYTHONPATH": str(installed / "lib/python3/dist-packages"), "PYTHONDONTWRITEBYTECODE": "1"})


def test_a_sweep_is_made_without_the_sources(installed, tmp_path):
    made = subprocess.run([installed / "bin/granvof", "sweep", installed / "share/granvof/cases/canary-dry.toml", "--set", "time.end=0.1,0.2",
                           "--set", "output.series_interval=0.05", "--set", "output.field_times=[0]"], cwd=tmp_path, capture_output=True,
                          text=True, env=os.environ | {"MPLCONFIGDIR": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"})
    assert made.returncode == 0, made.stderr
    assert "time.end" in made.stdout.splitlines()[0] and "cost [core-s]" in made.stdout.splitlines()[0]
    assert (tmp_path / "out/sweep/canary-dry/sweep.png").exists()
    bad = subprocess.run([installed / "bin/granvof", "sweep", "none.toml", "--set", "a"], cwd=tmp_path, capture_output=True, text=True)
    assert bad.returncode == 2 and bad.stderr.count("\n") == 1, bad.stderr


def test_a_report_is_made_without_the_sources(installed, tmp_path):
    case = installed / "share/granvof/cases/canary-dry.toml"
    run = [installed / "bin/granvof", "run", case, "--out", "run", "--set", "time.end=0.2", "--set", "output.series_interval=0.05",
           "--set", "output.field_times=[0]"]
    subprocess.run(run, cwd=tmp_path, check=True, capture_output=True)
    made = subprocess.run([installed / "bin/granvof", "report", "run"], cwd=tmp_path, capture_output=True, text=True,
                          env=os.environ | {"MPLCONFIGDIR": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"})
    assert made.returncode == 0, made.stderr
    assert (tmp_path / "run/report/report.html").exists()
