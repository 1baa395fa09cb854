"""The workflows of the hosted machines, read as text: what they keep, how long they may take, and what they call."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
NIGHTLY, CHANGES = ((ROOT / ".github/workflows" / name).read_text(encoding="utf-8") for name in ("nightly.yml", "ci.yml"))
SETTING_UP = 15  # minutes of a job before and after the night: packages, checkout, caches, artefacts


def steps(text):
    """The steps of all jobs, each with its options."""
    return re.split(r"^      - ", text, flags=re.MULTILINE)[1:]


def step(text, uses):
    (found,) = [one for one in steps(text) if one.startswith(f"uses: {uses}@")]
    return found


def option(text, name):
    return re.search(rf"^\s*{name}: (.+)$", text, re.MULTILINE)[1]


def test_the_history_is_kept_on_red_nights_too():
    restored, saved = step(NIGHTLY, "actions/cache/restore"), step(NIGHTLY, "actions/cache/save")
    assert "if: always()" in saved
    assert option(restored, "path") == option(saved, "path") == "out/nightly/history.sqlite"
    assert option(restored, "key") == option(saved, "key")
    prefix = option(restored, "restore-keys")
    assert option(saved, "key").startswith(prefix) and "run_id" in option(saved, "key")  # a key is written once
    order = [one.split("@")[0] for one in steps(NIGHTLY)]
    assert order.index("uses: actions/cache/restore") < [one.startswith("run: ci/nightly") for one in order].index(True) \
        < order.index("uses: actions/cache/save")


def test_a_night_fits_its_job():
    limit = int(re.search(r"ci/nightly .*--limit (\d+)", NIGHTLY)[1])
    assert limit + SETTING_UP <= int(option(NIGHTLY, "timeout-minutes")) <= 360  # what a hosted machine allows


def test_the_workflow_says_which_night_it_is():
    crons = re.findall(r'- cron: "(.+)"', NIGHTLY)
    assert len(crons) == 2
    (weekly,) = re.findall(r"github.event.schedule == '(.+)' && 'weekly'", NIGHTLY)
    assert weekly in crons
    assert re.search(r"ci/nightly --frequency \S", NIGHTLY)
    days = [set(days_of(cron.split()[4])) for cron in crons]
    assert days[0] | days[1] == set(range(7)) and not days[0] & days[1]


def days_of(field):
    first, _, last = field.partition("-")
    return range(int(first), int(last or first) + 1)


def test_changes_are_compiled_through_the_cache():
    jobs = CHANGES.split("  runs-on:")[1:] if "  runs-on:" in CHANGES else []
    assert len(jobs) == 2
    keys = []
    for job in jobs:
        cache = step(job, "actions/cache")
        assert option(cache, "path") == "~/.cache/ccache"
        keys.append(option(cache, "key"))
        assert keys[-1].startswith(option(cache, "restore-keys")) and "github.sha" in keys[-1]
        order = [one.startswith("uses: actions/cache@") for one in steps(job)].index(True)
        assert order < min(number for number, one in enumerate(steps(job)) if re.match(r"run: (bash \.ci/run|make)", one))
    assert len(set(option(step(job, "actions/cache"), "restore-keys") for job in jobs)) == 2  # each its own


@pytest.mark.parametrize("text", [NIGHTLY, CHANGES])
def test_workflows_call_the_projects_own_scripts(text):
    assert {uses.split("/")[0] for uses in re.findall(r"uses: (\S+)", text)} == {"actions"}
    for command in re.findall(r"run: (.+)", text):
        program = command.split()[0]
        assert program in ("apt-get", "git", "make", "bash") or (ROOT / program).exists(), command
    for target in re.findall(r"run: make (\w+)", text):
        assert re.search(rf"^{target}:", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
