"""What an older minor version gave is not compared with what this one gives, and the page and the docs say so."""

import json
import re
from pathlib import Path

import pytest
from report import charts, figures, report, sections, stability, style, versions

ROOT = Path(__file__).resolve().parent.parent.parent
SAID = "of an older minor version: not comparable"
NOW = versions.minor(re.search(r"project\(granvof VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1])


@pytest.mark.parametrize("made, now, older", [
    ("0.1.0 (abc)", (0, 2), True), ("granvof 0.9.3", (0, 10), True), ("0.2.0", (0, 2), False), ("0.2.7", (0, 2), False),
    ("1.0.0", (0, 2), False), ("", (0, 2), False), ("9642aa4fa687", (0, 2), False), ("0.1.0", None, False)])
def test_only_an_older_minor_version_is_not_comparable(made, now, older):
    assert bool(versions.remark(made, now)) == older


def empty(directory, name):
    directory.mkdir(parents=True, exist_ok=True)
    (directory / f"{name}.png").touch()
    return name


def write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(content))


def test_every_kept_study_on_the_page_says_that_it_is_older(verify_directory, monkeypatch):
    """The page's own runs are of 0.2.0, the kept studies those of the repository. What is drawn is not looked at."""
    monkeypatch.setattr(figures, "draw_all", lambda *_: [])
    monkeypatch.setattr(charts, "draw", lambda chart, _, directory: empty(directory, f"error-cost-{chart['case']}"))
    path = verify_directory / "results.json"
    path.write_text(path.read_text().replace('"version": "0.1.0"', '"version": "0.2.0"'))
    assert report.main(["--verify", str(verify_directory)]) == 0
    text = (verify_directory / "report.html").read_text()
    kept = ROOT / "compare/kept"
    studies = [("advice for s1", kept / "advise/s1.json"), ("s1: each part of the model", kept / "ablate/s1/ablate.json")]
    for caption, path in studies:
        made = json.loads(path.read_text())["version"]
        (line,) = [line for line in text.splitlines() if caption in line][:1]
        assert (SAID in line) == bool(versions.remark(made, (0, 2))), line
    points = json.loads((kept / "charts/points.json").read_text())
    made = [versions.minor(point["version"]) for chart in points["charts"] for point in chart["points"] if point["version"]]
    if max(made) < (0, 2):
        assert re.search(r"results kept in the repository, [^<]*" + SAID, text)
        assert re.search(r"s1: error against cost[^<]*" + SAID, text)


def test_a_section_says_it_beside_its_version(tmp_path):
    write(tmp_path / "stability/stability.json", {"title": "Map", "commit": "granvof 0.1.0 (abc)", "date": "2026-01-02"})
    (shown,) = sections.read_all(tmp_path, now=(0, 2))
    assert shown.made == f"granvof 0.1.0 (abc), {SAID}, 2026-01-02"
    assert SAID not in sections.read_all(tmp_path, now=(0, 1))[0].made


def test_the_map_says_it_in_its_small_print(tmp_path, monkeypatch):
    said = []
    monkeypatch.setattr(style, "save", lambda figure, *_: said.extend(text.get_text() for text in figure.texts))
    entry = {"axis": "packing", "method": "first order", "unit": "-", "scale": "linear", "nominal": 0.57,
             "borders": [{"end": 0.6, "holds": 0.6, "fails": None, "kind": None}]}
    stability.map_plot({"axes": [entry], "commit": "granvof 0.1.0 (abc)", "date": "2026-01-02"}, tmp_path, (0, 2))
    assert said == [f"granvof 0.1.0 (abc), {SAID}, 2026-01-02"]


def test_a_chart_of_this_version_beside_an_older_one_is_not_marked():
    point = {"version": "0.2.0 (abc)"}
    content = {"date": "2026-01-02", "charts": [{"case": "s1", "points": [point]},
                                                {"case": "s2", "points": [{"version": "0.1.0 (abc)"}]}]}
    assert charts.made(content, (0, 2)) == f"s1: 0.2.0 (abc), 2026-01-02; s2: 0.1.0 (abc), {SAID}, 2026-01-02"


def test_the_docs_say_which_studies_are_of_an_older_version():
    shown = {"docs/study.md": ["compare/kept/charts/points.json", "compare/kept/advise/s1.json"],
             "docs/theory/numerics.md": ["compare/kept/stability/stability.json"]}
    for page, files in shown.items():
        text = " ".join((ROOT / page).read_text().split())
        for file in files:
            for made in sorted(set(re.findall(r"\b\d+\.\d+\.\d+(?= \()", (ROOT / file).read_text()))):
                if versions.remark(made, NOW):
                    assert f"version {made}, {SAID}" in text, (page, file)
                else:
                    assert f"version {made}, {SAID}" not in text, (page, file)
    for page in sorted((ROOT / "docs").rglob("*.md")):
        for made in re.findall(r"(?:Measured at|At) version ([^,:.;]*\d\.\d+\.\d+[^,:.;]*[,:.;](?: of an older [^,:.;]*: not comparable)?)",
                               " ".join(page.read_text().split())):
            assert bool(versions.remark(made, NOW)) == (SAID in made), (page, made)
