"""Sections of the page that others make: a folder of figures beside out/verify, with one JSON that says what they show.

    out/NAME/NAME.json     {"title": "Accuracy against cost", "text": ["one paragraph", ...],
                            "figures": [{"file": "s1.png", "caption": "..."}, ...],
                            "tables": [{"caption": "...", "columns": ["a", ...], "rows": [[1.5, ...], ...]}, ...],
                            "commit": "abc1234", "date": "2026-01-01T00:00:00Z"}

Only "title" is needed. Without "figures" all PNG of the folder are shown, named by their files. A section that was
made at another commit than the runs of the page says so by its own commit and date.
"""

from dataclasses import dataclass, field
from pathlib import Path

from granvof_files import bytes_of, json_of
from report import versions
from report.embedded import encoded
from report.results import Damaged

NAMES = ("charts", "stability", "energy", "faults", "mutate")  # in the order of the page


@dataclass
class Section:
    name: str
    title: str
    text: list = field(default_factory=list)
    figures: list = field(default_factory=list)  # {"name", "caption", "data"}
    tables: list = field(default_factory=list)
    made: str = ""


def read_all(out, directories=None, now=None):
    """The sections that are there, below the directory that also holds verify/ or where `directories` has them. Raises
    Damaged, a ValueError with the file's name, where one is. `now`: the page's minor version (versions.py)."""
    places = {name: out / name for name in NAMES} | (directories or {})
    return [read(places[name], now) for name in NAMES if (places[name] / f"{name}.json").exists()]


def read(directory, now=None):
    source = directory / f"{directory.name}.json"
    try:
        given = json_of(source)
        figures = given.get("figures", [{"file": path.name, "caption": path.stem.replace("-", " ")}
                                        for path in sorted(directory.glob("*.png"))])
        return Section(directory.name, given["title"], listed(given.get("text", [])),
                       [figure(directory, entry) for entry in figures],
                       [{"caption": table.get("caption", ""), "columns": table["columns"], "rows": table["rows"]}
                        for table in given.get("tables", [])],
                       ", ".join(versions.named(given[key], now) if key == "commit" else given[key]
                                 for key in ("commit", "date") if given.get(key)))
    except (KeyError, TypeError, AttributeError, OSError, ValueError) as error:
        raise Damaged(source, error) from error


def figure(directory, entry):
    path = directory / Path(entry["file"]).name
    return {"name": f"{directory.name}-{path.stem}", "caption": entry["caption"],
            "data": encoded(bytes_of(path))}


def listed(text):
    return [text] if isinstance(text, str) else list(text)
