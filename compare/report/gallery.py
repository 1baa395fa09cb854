"""A picture and one line of every scene that `make verify` runs: the table of docs/gallery.md and the pictures beside it, which
trust_table.py writes."""

import io
from collections import Counter

from PIL import Image, ImageOps

from granvof_files import toml_of, write_whole
from report import film, results

PICTURES = "docs/gallery"
WIDE, HIGH = 320, 160  # pixels that a picture fits into
COLOURS = 64
LEAST_ACROSS = 40  # pixels of a column of few cells


def cases_of(root):
    """{id of a run: its case}, in the order of the table of checks."""
    table = toml_of(root / "compare/checks.toml")
    return {run["id"]: run.get("case") or run.get("beside") or run["id"] for run in table["run"]}


def picture_of(case):
    return f"{PICTURES}/{case.replace('/', '-')}.png"


def title_of(root, case):
    return toml_of(root / f"cases/{case}.toml")["scene"]["title"]


def shown_run(case, runs):
    """The run of a case that its picture shows: that of its own name, else the first."""
    return case.split("/")[-1] if case.split("/")[-1] in runs else runs[0]


def table(kept, root):
    """A line a scene of which rows are kept, in the order of the checks: picture, what it is, and what its rows say."""
    known, lines = cases_of(root), {}
    for row in kept["rows"]:
        if row["scene"] in known:
            lines.setdefault(known[row["scene"]], Counter())[row["verdict"]] += 1
    text = "| | scene | rows of the checks |\n| --- | --- | --- |\n"
    for case in dict.fromkeys(known.values()):
        if case in lines:
            name = picture_of(case)
            picture = f"![{case}]({name.removeprefix('docs/')})" if (root / name).exists() else "not among the runs of `make verify`"
            said = ", ".join(f"{count} {verdict}" for verdict, count in lines[case].most_common())
            text += f"| {picture} | [{case}](../cases/{case}.toml): {title_of(root, case)} | {said} |\n"
    return text


def write_pictures(verify, root):
    """Those of all scenes whose runs have fields: half-way through its instants."""
    found = results.load(verify)
    known = cases_of(root)
    runs = {}
    for run in known:
        if run in found.curves:
            runs.setdefault(known[run], []).append(run)
    for case, of_case in runs.items():
        shots = list(results.snapshots(found.curves[shown_run(case, of_case)]))
        if shots:
            _, f_s, alpha, _ = shots[len(shots) // 2]
            written = io.BytesIO()
            small(film.pixels_of(f_s, alpha)).save(written, format="PNG", optimize=True)
            (root / PICTURES).mkdir(parents=True, exist_ok=True)
            write_whole(root / picture_of(case), written.getvalue())


def small(picture):
    """In few colours and a frame, as large as fits; a column of few cells is drawn wider than it is."""
    share = min(WIDE / picture.width, HIGH / picture.height)
    size = (max(LEAST_ACROSS, round(picture.width * share)), max(LEAST_ACROSS // 2, round(picture.height * share)))
    return ImageOps.expand(picture.resize(size, Image.Resampling.NEAREST), border=1, fill="grey").quantize(COLOURS)
