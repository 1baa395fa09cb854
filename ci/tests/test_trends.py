"""The page of trends in a real browser: each night has its date, commit and value, and leads to its summary."""

import importlib.util
from pathlib import Path

import pytest

from night import trends
from night.history import Cost, History, Metric, Run

ROOT = Path(__file__).resolve().parent.parent.parent
_spec = importlib.util.spec_from_file_location("browser", ROOT / "compare/tests/browser.py")
browser = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(browser)

VALUES = [2.1, 2.2, None, 2.4]
COMMIT = "0123456789abcdef"


def written(directory, values=VALUES, kept=3):
    """A page of nights of these values, the last `kept` of which have their summary here."""
    history = History(directory / "history.sqlite")
    for day, value in enumerate(values, 1):
        name = f"202601{day:02}-run"
        metric = Metric("s1.run_out@10.DEM", "s1", "run_out@10", "-", value, 2.1, "differs" if day == 4 else "agrees", False)
        history.record(Run(name, f"2026-01-{day:02}T01:17:00.000000Z", COMMIT, "a host", "nightly", (), (metric,), (Cost("s1 <cost>", "s", 3.0),)))
        (directory / "runs" / name).mkdir(parents=True)
        if day > len(values) - kept:
            (directory / "runs" / name / "summary.txt").write_text("clean")
    path = directory / "runs" / name / "trends.html"
    trends.write_page(history, "a host", "no change & <nothing>", path)
    return path


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    opened = browser.Browser(tmp_path_factory.mktemp("profile"))
    opened.open(written(tmp_path_factory.mktemp("nightly")))
    yield opened
    opened.close()


def test_each_night_says_its_date_commit_and_value(page):
    said = page.run("return [...document.querySelectorAll('#s1 .night title')].map(title => title.textContent)")
    assert said == ["2026-01-01, 0123456789ab: 2.1", "2026-01-02, 0123456789ab: 2.2", "2026-01-04, 0123456789ab: 2.4, differs"]
    assert page.run("return document.querySelectorAll('#s1 .differs').length") == 1
    assert "[s]" in page.run("return document.querySelector('#cost').textContent")
    assert page.log() == []


def test_a_night_leads_to_its_summary_where_it_is_kept(page):
    links = page.run("return [...document.querySelectorAll('#s1 svg a')].map(link => link.getAttribute('href'))")
    assert links == ["../20260102-run/summary.txt", "../20260104-run/summary.txt"]
    assert page.run("return document.querySelectorAll('#s1 .night').length") == 3  # the first one without a link


def test_nights_stand_at_their_dates(page):
    x = page.run("return [...document.querySelectorAll('#s1 .night circle')].map(mark => Number(mark.getAttribute('cx')))")
    assert x[1] > x[0] + 10
    assert x[2] - x[1] == pytest.approx(2 * (x[1] - x[0]), abs=0.2)


def test_colours_follow_light_and_dark(page):
    def colours(scheme):
        page.devtools("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        return page.run("""return [getComputedStyle(document.body).backgroundColor, getComputedStyle(document.querySelector('svg text')).fill,
                           getComputedStyle(document.querySelector('.night circle')).fill]""")

    light, dark = colours("light"), colours("dark")
    assert all(one != other for one, other in zip(light, dark))
    assert light[0] == "rgb(255, 255, 255)" and dark[1] != dark[0]


def test_it_fits_a_phone_and_fetches_nothing(page):
    page.devtools("Emulation.setDeviceMetricsOverride", width=360, height=740, deviceScaleFactor=2, mobile=True)
    assert page.run("return document.documentElement.scrollWidth") <= 360
    page.devtools("Emulation.clearDeviceMetricsOverride")
    assert page.run("return performance.getEntriesByType('resource').length") == 0


def test_numbers_that_do_not_move_are_a_line_in_the_middle(tmp_path):
    text = written(tmp_path, [2.0, 2.0 + 1e-12, 2.0]).read_text()
    assert "s1 &lt;cost&gt;" in text and "no change &amp; &lt;nothing&gt;" in text and "nan" not in text
    assert text.count('cy="60.0"') >= 3


def test_a_metric_that_never_had_a_value_has_an_empty_panel(tmp_path):
    assert "no value" in written(tmp_path, [None, None]).read_text()
