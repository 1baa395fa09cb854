"""README and docs: links resolve, paths exist, the picture is that of the code, the first page stays short."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", ROOT / "reference/README.md", ROOT / "compare/lay/README.md",
         *sorted((ROOT / "docs").rglob("*.md"))]
TOP = "solver|compare|reference|cases|ci|docs"


def name(page):
    return page.relative_to(ROOT).as_posix()


def without_code(text):
    return re.sub(r"^ *```.*?^ *```$", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(page):
    """Anchors of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", without_code(page.read_text(encoding="utf-8")), re.MULTILINE)
    plain = (re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading) for heading in headings)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in plain}


def broken_links(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", without_code(page.read_text(encoding="utf-8"))):
        if "://" in target:
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists() or (anchor and anchor not in anchors(file)):
            yield target


def missing_paths(page):
    """Paths of the repository in `code` that are not there; those with a placeholder in capitals, or made by a build, left out."""
    for path in re.findall(rf"`((?:{TOP})/[\w./-]+)`", without_code(page.read_text(encoding="utf-8"))):
        if not re.search(r"[A-Z]{3}", path.replace("README", "").replace("CMake", "")) and not (ROOT / path).exists():
            yield path


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_links_resolve(page):
    assert not list(broken_links(page))


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_paths_exist(page):
    assert not list(missing_paths(page))


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_commands_name_targets_and_cases_that_are_there(page):
    """`make TARGET` and cases/NAME.toml, in blocks of commands and in `code`."""
    text = page.read_text(encoding="utf-8")
    blocks = re.findall(r"^ *```(\w*)\n(.*?)^ *```$", text, re.MULTILINE | re.DOTALL)
    code = "\n".join([block for language, block in blocks if language in ("", "sh")] + re.findall(r"`([^`\n]+)`", without_code(text)))
    targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    assert not set(re.findall(r"\bmake ([a-z]+)\b", code)) - targets
    example = {"cases/small.toml"}  # of the how-tos
    cases = set(re.findall(r"\bcases/[a-z0-9-]+\.toml", code)) - example
    assert not [case for case in sorted(cases) if not (ROOT / case).exists()]


def test_every_page_is_reached_from_the_readme():
    reached, waiting = set(), [ROOT / "README.md"]
    while waiting:
        page = waiting.pop()
        if page in reached or page.suffix != ".md":
            continue
        reached.add(page)
        for target in re.findall(r"\]\(([^)\s#]+)", without_code(page.read_text(encoding="utf-8"))):
            if "://" not in target:
                waiting.append((page.parent / target).resolve())
    assert not [name(page) for page in (ROOT / "docs").rglob("*.md") if page not in reached]


def test_readme_is_short():
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) < 200


def test_the_paper_is_cited_on_the_first_screen():
    top = "\n".join((ROOT / "README.md").read_text(encoding="utf-8").splitlines()[:20])
    assert "Numerical Simulation Model of Gas-Liquid-Solid Flows with Gas-Liquid Free Surface and Solid Particles Flows" in top


def test_the_picture_of_the_parts_is_that_of_the_code():
    done = subprocess.run([ROOT / "docs/architecture.py", "--check"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_version_is_the_same_everywhere():
    version = re.search(r"project\(granvof VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    newest = re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)[1]
    assert newest == version


# What GitHub's Markdown does not forgive: an odd number of $ in a line, $ beside a letter, a backslash before a comma within $ $ (the
# backslash is taken off before the formula is read), a display formula without its fence.
@pytest.mark.parametrize("page", sorted((ROOT / "docs/theory").glob("*.md")), ids=name)
def test_formulas_are_rendered(page):
    text = page.read_text(encoding="utf-8")
    assert "$$" not in text
    assert len(re.findall(r"^ *```", text, re.MULTILINE)) % 2 == 0
    prose = re.sub(r"`[^`\n]*`", "", without_code(text))
    assert not [line for line in prose.splitlines() if line.count("$") % 2]
    inline = re.findall(r"(.?)(\$[^$\n]+\$)(.?)", prose)
    assert not [formula for before, formula, after in inline
                if re.search(r"\\[^\w\s]", formula) or re.search(r"\w", before + after)]
