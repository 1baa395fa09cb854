"""The page of a run (`granvof report DIR`) in a real browser: wide and narrow, light and dark."""

import importlib.util
from pathlib import Path

import pytest

from report import of_a_run

_spec = importlib.util.spec_from_file_location("browser", Path(__file__).with_name("browser.py"))
browser = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(browser)


@pytest.fixture(scope="module")
def page(run_shown, tmp_path_factory):
    opened = browser.Browser(tmp_path_factory.mktemp("profile"))
    opened.open(of_a_run.show(run_shown))
    yield opened
    opened.close()


@pytest.fixture(params=[1280, 360])
def width(page, request):
    page.devtools("Emulation.setDeviceMetricsOverride", width=request.param, height=740, deviceScaleFactor=2, mobile=request.param < 600)
    yield request.param
    page.devtools("Emulation.clearDeviceMetricsOverride")


def colours(page, scheme):
    """Brightness of the background, of text, of what is soft and of what is bad."""
    page.devtools("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
    found = page.run("""const of = name => getComputedStyle(document.querySelector(name));
                        return [of('body').backgroundColor, of('body').color, of('dt').color, of('.bad').color, of('pre').color]""")
    return [luminance(colour) for colour in found]


def luminance(colour):
    """Of "rgb(r, g, b)", by WCAG."""
    parts = [int(part) / 255 for part in colour[colour.index("(") + 1:-1].split(",")[:3]]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055)**2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    return (max(one, other) + 0.05) / (min(one, other) + 0.05)


def test_the_page_of_a_run(page):
    assert page.log() == [] and page.run("return document.title").startswith("granvof: ")
    fetched = page.run("return performance.getEntriesByType('resource').map(entry => entry.name)")
    assert [name for name in fetched if not name.startswith("data:")] == []
    images = page.run("return [...document.images].map(image => [image.complete && image.naturalWidth > 100, image.alt.length > 10])")
    assert len(images) == 3 and all(map(all, images))


def test_it_fits_its_window_with_its_case_open_too(page, width):
    page.run("document.querySelector('details').open = true")
    page.run("for (const name of ['h1', '.bad', 'dd', 'figcaption', 'pre']) document.querySelector(name).append(' ' + 'x'.repeat(400))")
    shown, inner = page.run("return [innerWidth, document.documentElement.clientWidth]")  # a scrollbar takes some of it
    assert shown == width
    assert page.run("return document.documentElement.scrollWidth") <= inner
    assert page.run("return Math.max(...[...document.images].map(image => image.getBoundingClientRect().right))") <= inner


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_can_be_read(page, scheme):
    back, *texts = colours(page, scheme)
    assert (back > 0.9) == (scheme == "light") and (back < 0.05) == (scheme == "dark")
    assert min(contrast(back, text) for text in texts) >= 4.5, texts
