"""report.html in a real browser: it loads, says nothing on the console, and works by mouse, keyboard and phone."""

import importlib.util
from pathlib import Path

import pytest

_spec = importlib.util.spec_from_file_location("browser", Path(__file__).with_name("browser.py"))
browser = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(browser)

ENTER, SPACE = "\ue007", " "
FIRST_TABLE = "document.querySelector('#scene-s1 table')"  # where something differs, so that it is open


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
    page.click("#scene-s1 th:nth-child(1) button")
    assert sort_state(page, 0) == "ascending"
    names = column(page, 0)
    assert names == sorted(names)
    page.click("#scene-s1 th:nth-child(1) button")
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
        page.click("#scene-s1 th:nth-child(4) button")
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


SCROLLS = """return [...document.querySelectorAll('.scroll')].filter(box => box.querySelector('.stack') && box.offsetParent
             && box.scrollWidth > box.clientWidth).length"""


@pytest.fixture
def phone(page):
    page.devtools("Emulation.setDeviceMetricsOverride", width=360, height=740, deviceScaleFactor=2, mobile=True)
    yield page
    page.devtools("Emulation.clearDeviceMetricsOverride")


def test_fits_a_phone(phone):
    assert phone.run("return document.documentElement.scrollWidth") <= 360  # what is wider scrolls inside its own box
    assert phone.run(SCROLLS) == 0  # the tables of checks are cards there
    assert phone.run(f"return getComputedStyle({FIRST_TABLE}.tBodies[0].rows[0].cells[1], '::before').content") == '"metric"'


def test_every_table_is_cards_on_a_phone(phone):
    cells = phone.run("""return [...document.querySelectorAll('td')].filter(cell => cell.offsetParent)
        .map(cell => [cell.closest('section').getAttribute('aria-labelledby'), getComputedStyle(cell).display, cell.dataset.title])""")
    assert {section for section, _, _ in cells} == {"glance", "checks", "runs", "faults"}
    assert [cell for cell in cells if cell[1] != "grid" or not cell[2]] == []


def test_tables_of_checks_fit_the_window(page):
    assert page.run("return document.documentElement.scrollWidth <= innerWidth")
    assert page.run(SCROLLS) == 0


def test_what_agrees_is_closed_until_a_link_points_into_it(page):
    state = "return document.getElementById('scene-float-full-r02').open"
    assert not page.run(state) and page.run("return document.getElementById('scene-s1').open")
    page.run("document.querySelector('a[href=\"#scene-float-full-r02\"]').click()")
    assert page.run("return new Promise(done => setTimeout(() => done(document.getElementById('scene-float-full-r02').open), 100))")
    page.run("location.hash = ''; document.getElementById('scene-float-full-r02').open = false")


def test_every_link_has_its_place(page):
    assert page.run("""return [...document.querySelectorAll('a[href^="#"]')].map(a => a.getAttribute('href').slice(1))
                       .filter(id => !document.getElementById(id))""") == []


def test_a_row_leads_to_its_plot_its_cause_and_its_case(page):
    links = page.run("""return [...document.querySelectorAll('#table-glance tbody tr')].filter(row => row.cells[0].textContent === 's1')
                        .map(row => [...row.cells[7].querySelectorAll('a')].map(a => a.getAttribute('href')))""")
    assert ["#run-out", "#run-s1"] in links
    assert any("#cause-toe" in row for row in links)


def test_the_first_screen_holds_what_others_judge_and_the_rest_is_closed(page):
    heads = page.run("return [...document.querySelectorAll('#table-glance th')].map(head => head.textContent.trim())")
    assert heads == ["scene", "quantity", "error to DEM", "to published", "tolerance", "times dearer", "verdict", "see"]
    rows = page.run("""return [...document.querySelectorAll('#table-glance tbody tr')]
                       .map(row => [...row.cells].map(cell => cell.textContent.trim()))""")
    assert all(row[2] or row[3] or row[6] == "not run" for row in rows)
    assert [row[4] for row in rows if row[:2] == ["s1", "run out"]] == ["0.05 h0, band 0.1 h0"]
    assert page.run("return document.getElementById('rest').open") is False
    assert page.run("return [...document.querySelectorAll('#rest tbody tr')].some(row => row.textContent.includes('period'))")


def test_the_filter_leaves_what_holds_its_words(page):
    def rows():
        return page.run("return [...document.querySelectorAll('#table-glance tbody tr')].filter(row => !row.hidden).length")

    def write(text):
        page.run(f"const box = document.getElementById('filter'); box.value = '{text}'; box.dispatchEvent(new Event('input'))")

    everything = rows()
    write("float-full-r02 share")
    assert 0 < rows() < everything
    assert page.run("return document.getElementById('scene-float-full-r02').open && document.getElementById('scene-s1').hidden")
    write("")
    assert rows() == everything
    assert not page.run("return document.getElementById('scene-float-full-r02').open")
