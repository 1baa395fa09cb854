"""The tutorial, as a newcomer runs it: every block of commands works, and says what the page says it says."""

import re
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/tutorial.md"
MOST_SECONDS = 900  # for all of it, as the page says: a quarter of an hour


def blocks():
    """(language, mark, text) of each fenced block, in order."""
    return re.findall(r"^```(\w+)(?: (\w+))?\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def test_the_tutorial_works_in_its_quarter_of_an_hour(tmp_path, record_property):
    assert (ROOT / "build/release/compare/granvof-compare").exists(), "`make build` builds the programs"
    said, commands, begun = "", 0, time.monotonic()
    for language, mark, text in blocks():
        if language == "text":
            for line in text.splitlines():
                assert line in said, f"the tutorial says '{line}', the programs:\n{said}"
            continue
        here = text.replace("out/tutorial", str(tmp_path)).replace('base = "../..', f'base = "{ROOT}')
        ended = subprocess.run(["bash", "-ec", here], cwd=ROOT, capture_output=True, text=True,
                               timeout=MOST_SECONDS - (time.monotonic() - begun))
        assert (ended.returncode == 0) == (mark != "fails"), ended.stdout + ended.stderr
        said, commands = ended.stdout, commands + 1
    record_property("seconds", round(time.monotonic() - begun))
    assert commands == 6
    for made in ("start.svg", "mine/report/report.html", "mine/report/film.apng", "advise/mine-advised.toml", "sweep/mine/sweep.png"):
        assert (tmp_path / made).stat().st_size > 100, made
