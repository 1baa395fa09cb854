"""The tutorial, as a newcomer runs it: every block of commands works, and says what the page says it says."""

import re
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/tutorial.md"
MOST_SECONDS = 900  # for all of it, as the page says: a quarter of an hour


def blocks():
    """(language, mark, text) of each fenced block, in order; of one in a list without its indent."""
    page = re.sub(r"^  (?=```|grep|# answer)", "", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return re.findall(r"^```(\w+)(?: (\w+))?\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


NUMBER = re.compile(r"(?<![\w.@-])\d+(?:\.\d+)?(?![\w-])")


def is_said(line, said):
    """Whether what was printed has the line: its words as they are, its numbers up to a half of them, for they move with the results,
    and with them the blanks between the columns of a table."""
    line, said = (re.sub(" +", " ", text) for text in (line, said))
    words = r"(?<![\w.@-])(\d+(?:\.\d+)?)(?![\w-])".join(re.escape(part) for part in NUMBER.split(line))
    numbers = [float(number) for number in NUMBER.findall(line)]
    return any(all(abs(float(one) - number) <= 0.5 * number for one, number in zip(found.groups(), numbers))
               for found in re.finditer(words, said))


def test_numbers_of_the_tutorial_may_move_and_its_words_may_not():
    said = "answer: run_out@3 0.72 [-], +- 0.1 by the grid\n"
    assert is_said("answer: run_out@3 0.698 [-], +- 0.09 by the grid", said)
    assert is_said("sourced   paper", "presets  sourced     paper\n") and not is_said("sourced   paper", "presets  paper  sourced\n")
    assert not is_said("answer: run_out@3 0.2 [-], +- 0.1 by the grid", said)
    assert not is_said("answer: run_out@4 0.72 [-], +- 0.1 by the grid", said)
    assert not is_said("answer: run_out@3 0.72 [-], +- 0.1 by the model", said)


def test_the_tutorial_works_in_its_quarter_of_an_hour(tmp_path, record_property):
    assert (ROOT / "build/release/compare/granvof-compare").exists(), "`make build` builds the programs"
    said, commands, begun = "", 0, time.monotonic()
    for language, mark, text in blocks():
        if language == "text":
            for line in text.splitlines():
                assert is_said(line, said), f"the tutorial says '{line}', the programs:\n{said}"
            continue
        here = text.replace("out/tutorial", str(tmp_path)).replace('base = "../..', f'base = "{ROOT}')
        ended = subprocess.run(["bash", "-ec", here], cwd=ROOT, capture_output=True, text=True,
                               timeout=MOST_SECONDS - (time.monotonic() - begun))
        assert (ended.returncode == 0) == (mark != "fails"), ended.stdout + ended.stderr
        said, commands = ended.stdout, commands + 1
    record_property("seconds", round(time.monotonic() - begun))
    assert commands == 7
    for made in ("start.svg", "mine/report/report.html", "mine/report/film.apng", "advise/mine-advised.toml", "sweep/mine/sweep.png"):
        assert (tmp_path / made).stat().st_size > 100, made
