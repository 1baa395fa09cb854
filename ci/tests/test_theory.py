"""docs/theory and the code: every equation has an owner and a section, and no comment cites one that has none."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
THEORY = ROOT / "docs/theory"
EQUATIONS = range(1, 28)
SOURCES = [path for folder in ("solver", "compare", "reference") for kind in ("*.hpp", "*.cpp")
           for path in sorted((ROOT / folder).rglob(kind))]
# "(13)" or "(11)-(20)" in a comment or a text, not the "(2)" of a call, a year or a volume.
CITED = re.compile(r"(?<![\w>\])}])\((\d{1,2})\)(?!\s*\{)")


def comments(path):
    """Comments and texts of a source: where equations are cited."""
    text = path.read_text(encoding="utf-8")
    return "\n".join(re.findall(r"//[^\n]*|\"[^\"\n]*\"", text))


def cited(path):
    return {int(number) for number in CITED.findall(comments(path))}


def sections():
    """Equation -> (page, heading)."""
    found = {}
    for page in sorted(THEORY.glob("*.md")):
        for heading in re.findall(r"^## (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE):
            number = re.match(r"\((\d+)\) ", heading)
            if number:
                assert int(number[1]) not in found, f"{number[0]} has two sections"
                found[int(number[1])] = (page, heading)
    return found


def section_text(page, heading):
    text = page.read_text(encoding="utf-8")
    return text.split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]


def owners():
    """Equation -> owner, as the table of the index states them."""
    index = (THEORY / "README.md").read_text(encoding="utf-8")
    table = re.findall(r"^\| \((\d+)\) [^|]*\|[^|]*\| \[[^\]]*\]\(([^)]*)\) \|$", index, re.MULTILINE)
    return {int(number): (THEORY / path).resolve() for number, path in table}


def test_every_equation_has_a_section_and_an_owner():
    assert sorted(sections()) == list(EQUATIONS)
    assert sorted(owners()) == list(EQUATIONS)


@pytest.mark.parametrize("number", EQUATIONS)
def test_the_owner_names_its_equation_and_the_section_names_its_owner(number):
    owner, (page, heading) = owners()[number], sections()[number]
    assert number in cited(owner), f"{owner.relative_to(ROOT)} does not name ({number})"
    code = section_text(page, heading).partition("**Code.**")[2]
    assert owner.name in code, f"the section '{heading}' of {page.name} does not name {owner.name} as its code"


@pytest.mark.parametrize("number", EQUATIONS)
def test_a_section_has_its_formula_and_its_source(number):
    text = section_text(*sections()[number])
    assert "```math" in text
    assert "**Source.**" in text


def test_no_comment_cites_an_equation_without_a_section():
    known = set(sections())
    # Numbers beyond (27) in brackets are no equations; those within are.
    unknown = {f"{path.relative_to(ROOT)}: ({number})" for path in SOURCES for number in cited(path)
               if number in EQUATIONS and number not in known}
    assert not unknown


def test_a_correction_is_cited_by_its_equation():
    texts = {path.relative_to(ROOT): re.sub(r"\s*\n// *", " ", comments(path)) for path in SOURCES}
    assert not [f"{path}: {said}" for path, text in texts.items() for said in re.findall(r"corrections? \d+", text)]
    named = {(path, int(number)) for path, text in texts.items() for number in re.findall(r"corrections? of \((\d+)\)", text)}
    assert named
    assert not [f"{path}: ({number})" for path, number in named if "**Correction" not in section_text(*sections()[number])]


def test_every_closure_is_on_a_page():
    linked = "\n".join(re.findall(r"\]\(([^)]*)\)", "\n".join(page.read_text(encoding="utf-8") for page in THEORY.glob("*.md"))))
    named = [path.relative_to(ROOT).as_posix() for path in sorted((ROOT / "solver/closures").rglob("*.hpp"))]
    assert len(named) > 40
    assert not [name for name in named if name not in linked], "closures without a section in docs/theory"


@pytest.mark.parametrize("header", [path.relative_to(ROOT).as_posix() for path in SOURCES
                                    if path.suffix == ".hpp" and path.parts[len(ROOT.parts)] == "solver" and "tests" not in path.parts])
def test_a_header_leads_to_the_pages_of_the_equations_it_cites(header):
    where = sections()
    pages = {where[number][0].relative_to(ROOT).as_posix() for number in cited(ROOT / header) if number in where}
    said = comments(ROOT / header)
    assert not [page for page in sorted(pages) if page not in said]


# A word of which the docs have several meanings (README.md, "Words") -> the names of the code that may hold it.
WORDS = {
    "dilatancy": re.compile(r"shear_?dilatancy|dilatancy_(slope|friction|tangent)|largest_dilatancy_tangent", re.IGNORECASE),
    "solid_flux": re.compile(r"(?!)"),
}


@pytest.mark.parametrize("word", WORDS)
def test_a_word_has_one_meaning_in_the_code(word):
    """Names alone: keys of the case file and columns of output, which are texts, keep theirs."""
    found = set()
    for path in SOURCES:
        if "tests" not in path.parts:
            code = re.sub(r"//[^\n]*|\"[^\"\n]*\"", "", path.read_text(encoding="utf-8"))
            found |= {(path.relative_to(ROOT).as_posix(), name) for name in re.findall(r"\w+", code) if word in name.lower()}
    assert not [(path, name) for path, name in sorted(found) if not WORDS[word].fullmatch(name)]


def test_every_key_with_such_a_word_is_explained():
    keys = {key for path in (ROOT / "solver/scene").glob("*.cpp")
            for key in re.findall(r"\"([a-z_]+\.[a-z_]+)\"", path.read_text(encoding="utf-8")) if any(word in key for word in WORDS)}
    words = section_text(THEORY / "README.md", "Words")
    assert len(keys) == 8
    assert not [key for key in sorted(keys) if f"`{key}`" not in words]
