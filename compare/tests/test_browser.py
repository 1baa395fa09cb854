"""report.html in a real browser: it loads, says nothing on the console, and works by mouse, keyboard and phone."""

import importlib.util
from pathlib import Path

import pytest

_spec = importlib.util.spec_from_file_location("browser", Path(__file__).with_name("browser.py"))
browser = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(browser)

ENTER, SPACE = "\ue007", " "
FIRST_TABLE = "document.querySelectorAll('table.sortable')[0]"


@pytest.fixture(scope="module")
def page(reported, tmp_path_factory):
    opened = browser.Browser(tmp_path_factory.mktemp("profile"))
    opened.open(reported / "report.html")
    yield opened
    opened.close()


def column(page, index):
    return page.run(f"return [...{FIRST_TABLE}.tBodies[0].rows].map(row => row.cells[{index}].dataset.value"
                    f" ?? row.cells[{index}].textContent.trim())")


def sort_state(page, index):
    return page.run(f"return {FIRST_TABLE}.tHead.rows[0].cells[{index}].getAttribute('aria-sort')")


def test_loads_without_a_word_on_the_console(page):
    assert page.run("return document.readyState") == "complete"
    assert page.run("return document.title").startswith("granvof")
    assert page.log() == []


def test_fetches_nothing(page):
    fetched = page.run("return performance.getEntriesByType('resource').map(entry => entry.name)")
    assert [name for name in fetched if not name.startswith("data:")] == []


def test_every_image_is_there(page, reported):
    sizes = page.run("return [...document.images].map(image => image.complete ? image.naturalWidth : 0)")
    assert len(sizes) == sum(path.suffix in (".png", ".apng") for path in (reported / "plots").iterdir())
    assert all(size > 100 for size in sizes)
    assert all(page.run("return [...document.images].map(image => image.alt)"))


def test_table_sorts_by_mouse_both_ways(page):
    page.click("table.sortable th:nth-child(1) button")
    assert sort_state(page, 0) == "ascending"
    names = column(page, 0)
    assert names == sorted(names)
    page.click("table.sortable th:nth-child(1) button")
    assert sort_state(page, 0) == "descending"
    assert column(page, 0) == sorted(names, reverse=True)


def test_table_sorts_by_keyboard_and_numbers_by_value(page):
    page.run(f"{FIRST_TABLE}.tHead.rows[0].cells[2].firstElementChild.focus()")
    page.press(ENTER)
    assert sort_state(page, 2) == "ascending" and sort_state(page, 0) is None
    values = [float(text) for text in column(page, 2) if text]
    assert values == sorted(values)
    page.press(SPACE)
    assert sort_state(page, 2) == "descending"


def test_empty_values_stay_last(page):
    for _ in range(2):
        page.click("table.sortable th:nth-child(4) button")
        values = column(page, 3)
        assert "" in values and values.index("") == len([value for value in values if value])


def test_light_and_dark(page):
    def colours(scheme):
        page.devtools("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        return page.run("const style = getComputedStyle(document.body); return [style.color, style.backgroundColor]")

    def brightness(colour):
        return sum(int(part) for part in colour[colour.index("(") + 1:-1].split(",")[:3])

    light, dark = colours("light"), colours("dark")
    assert brightness(light[0]) + 300 < brightness(light[1])
    assert brightness(dark[0]) > 300 + brightness(dark[1])


def test_fits_a_phone(page):
    page.devtools("Emulation.setDeviceMetricsOverride", width=360, height=740, deviceScaleFactor=2, mobile=True)
    wide = page.run("return document.documentElement.scrollWidth")
    assert wide <= 360  # tables scroll inside their own boxes
    page.devtools("Emulation.clearDeviceMetricsOverride")
