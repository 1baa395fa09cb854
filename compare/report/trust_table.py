#!/usr/bin/python3
"""How far to trust the program: the tables of README.md, docs/results.md and docs/gallery.md, from kept results of `make verify`.

compare/report/trust_table.py                          write the tables from what is kept
compare/report/trust_table.py --verify out/verify      keep these results, then write the tables, the gallery's pictures, and the
                                                       README's if its figure is there: after `make verify`
compare/report/trust_table.py --check [--verify DIR]   write nothing; exit code 1 if a table is not what is kept, or with
                                                       --verify if the results in DIR are not what is kept
"""

import argparse
import re
import sys
from dataclasses import dataclass
from pathlib import Path
from statistics import mean

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "compare"), str(ROOT / "solver/python")]

from complaint import complain, ended, given_path  # noqa: E402
from granvof_files import json_of, write_whole  # noqa: E402
from report import charts, gallery, kept_results  # noqa: E402

AGREES = ("agrees", "within band")
FLOATING = tuple(f"float-full-r{ratio}" for ratio in ("02", "04", "06", "08"))


# Set of choices -> what it adds to the name of the paper's run.
PRESETS = {"paper": "", "advised": "-advised", "sourced": "-sourced"}


@dataclass(frozen=True)
class Line:
    """One line of the README's table: rows of one kind in one or several scenes, for each set of choices that was run."""

    what: str
    scenes: tuple
    metrics: tuple
    kind: str
    record: str = ""  # scene of the DEM record whose cost stands beside ours


def run_out(what, run, record, metric="run_out", at=(2, 5, 8, 10)):
    return Line(what, (run,), tuple(f"{metric}@{t}" for t in at), "DEM", record)


LINES = (
    run_out("run-out of S1 at T = 2 / 5 / 8 / 10", "s1", "s1"),
    run_out("run-out of S2, the same", "s2", "s2"),
    run_out("front of 99.5 % of the grains in air at T = 1 / 2 / 3 / 4.9, frictional restitution", "canary-dry-frictional",
            "canary-dry", "run_out_quantile", (1, 2, 3, 4.9)),
    Line("pore pressure of the loose column at 0.02 / 0.04 / 0.1 s [Pa]", ("s1-loose",),
         ("base_pressure@0.02", "base_pressure@0.04", "base_pressure@0.1"), "DEM", "s1-loose"),
    Line("immersed share h/H at density ratio 0.2 / 0.4 / 0.6 / 0.8", FLOATING, ("immersed_share",), "theory"),
    Line("rate of its approach to rest [1/s]", FLOATING, ("decay_rate",), "DEM", "float-full-r02"),
    Line("its period without drag, 0.2 / 0.4 / 0.6 [s]", tuple(f"{scene}-nodrag" for scene in FLOATING[:3]), ("period",), "theory"),
    Line("front of a dam break without grains, rms over a", ("dam-break",), ("dam_break_distance-delta",), "published"),
    Line("energy that the scheme makes, of what the flow is given otherwise: S1 / S2 / canary in air", ("s1", "s2", "canary-dry"),
         ("energy_created",), "theory"),
    Line("slope of a heap at rest, T = 10 to 40, moves by [degrees]", ("heap",), ("slope_drift",), "theory"),
    Line("fastest fluid in a pool at rest [m/s]", ("pool",), ("fluid_speed_max",), "theory"),
)
# Of all runs that have the row: the worst.
WORST = (("solid volume, largest relative change", "solid_volume_error"),
         ("liquid volume, largest relative change", "liquid_volume_error"),
         ("energy not accounted for, of that turned over", "energy_closure"))


def number(value):
    return "-" if value is None else f"{value:.3g}"


def together(values):
    return " / ".join(number(value) for value in values)


def verdicts(rows):
    """"3 of 4", and what the others are."""
    others = sorted({row["verdict"] for row in rows if row["verdict"] not in AGREES})
    count = f"{sum(row['verdict'] in AGREES for row in rows)} of {len(rows)}"
    return f"{count}; {', '.join(others)}" if others else count


def seconds(cost):
    """Two figures, without a power of ten."""
    return f"{float(f'{cost:.2g}'):g}"


def rows_of(kept, line, preset):
    runs = [scene + PRESETS[preset] for scene in line.scenes]
    return [row for run in runs for metric in line.metrics for row in kept["rows"]
            if (row["scene"], row["metric"], row["reference_kind"]) == (run, metric, line.kind)]


def preset_of(run):
    return next((preset for preset, end in PRESETS.items() if end and run.endswith(end)), "paper")


def dem_cost(scene, results=ROOT / "reference/results"):
    """Mean core-seconds of the records of a scene, None where there is none."""
    costs = [json_of(path)["core_seconds"]
             for path in sorted((results / scene).glob("seed*/record.json"))]
    return mean(costs) if costs else None


def costs_of(kept, line, presets):
    """Of the first run of each preset, and of one record."""
    ours = [kept["costs"].get(line.scenes[0] + PRESETS[preset], {}).get("core_seconds") for preset in presets]
    theirs = dem_cost(line.record) if line.record else None
    return " / ".join(seconds(cost) if cost else "-" for cost in ours) + (f"; {seconds(theirs)}" if theirs else "")


def one_reference(rows):
    """What the values are held against; one number where all are the same, with what may be off."""
    references = {row["reference"] for row in rows}
    shown = number(rows[0]["reference"]) if len(references) == 1 else together(row["reference"] for row in rows)
    tolerances = {re.sub(r" \[[^]]*\]", "", row["tolerance"]) for row in rows}
    if len(tolerances) > 1:
        return shown
    tolerance = tolerances.pop()
    bound = re.match(r"(at most|at least), within (.*)", tolerance)
    return f"{bound[1]} {shown}, within {bound[2]}" if bound else f"{shown} ± {tolerance}"


def cell(rows, shown):
    """Values, and how many of them agree."""
    if not rows:
        return "-"
    unexpected = ", unexpected" * any(row["unexpected"] for row in rows)
    return f"{shown} ({sum(row['verdict'] in AGREES for row in rows)} of {len(rows)}{unexpected})"


def trust_rows(kept, presets):
    shown, missing = [], []
    for line in LINES:
        rows = {preset: rows_of(kept, line, preset) for preset in presets}
        made_of = next((found for found in rows.values() if found), None)
        if made_of is None:
            missing.append(line.what)
            continue
        values = [cell(found, together(row["value"] for row in found)) for found in rows.values()]
        shown.append((line.what, *values, one_reference(made_of), line.kind, costs_of(kept, line, presets)))
    for what, metric in WORST:
        all_of = [row for row in kept["rows"] if row["metric"] == metric and row["value"] is not None]
        if not all_of:
            continue
        values = []
        for preset in presets:
            rows = [row for row in all_of if preset_of(row["scene"]) == preset]
            values.append(cell(rows, number(max((abs(row["value"]) for row in rows), default=None))))
        shown.append((f"{what}, worst of all runs", *values, one_reference(all_of[:1]), "theory", ""))
    return shown, missing


def markdown(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def made(kept):
    """"0.1.0 (abc), 2026-01-02; ..." of all rows."""
    return "; ".join(sorted({f"{row['version']} ({row['commit']}), {row['date']}" for row in kept["rows"] if row["version"]}))


def trust_table(kept):
    there = {preset_of(row["scene"]) for row in kept["rows"]}
    presets = [preset for preset in PRESETS if preset in there]
    shown, missing = trust_rows(kept, presets)
    text = markdown(["what", *presets, "reference", "kind", f"core-seconds: {' / '.join(presets)}; demvof"], shown)
    if missing:
        text += f"\nNo result is kept for: {'; '.join(missing)}.\n"
    return text + f"\nMeasured by granvof {made(kept)}.\n"


def all_rows(kept):
    """The rows of one scene, metric and kind on a line."""
    groups = {}
    for row in kept["rows"]:
        groups.setdefault((row["scene"], row["metric"].partition("@")[0], row["reference_kind"]), []).append(row)
    scenes = list(dict.fromkeys(row["scene"] for row in kept["rows"]))
    lines = []
    for (scene, metric, kind), rows in sorted(groups.items(), key=lambda group: scenes.index(group[0][0])):
        at = [row["metric"].partition("@")[2] for row in rows]
        where = f" at {' / '.join(at)}" if all(at) else ""
        lines.append((scene, metric + where, together(row["value"] for row in rows), rows[0]["unit"], one_reference(rows), kind,
                      verdicts(rows)))
    return f"{len(kept['rows'])} rows, {verdicts(kept['rows'])}.\n\n" + markdown(
        ["run", "metric", "value", "unit", "reference", "kind", "agrees"], lines)


def failures(kept):
    """Every row that does not agree, with its reason."""
    reasons = {}
    for row in kept["rows"]:
        if row["verdict"] not in AGREES:
            reason = row["reason"] or row["note"] or ("no reason is stated" if row["asserted"] else "reported, not asserted")
            reasons.setdefault((row["verdict"], row["scene"], reason), []).append(row)
    lines = [f"- **{scene}**, {', '.join(row['metric'] for row in rows)} "
             f"({verdict}; off by {together(row['distance'] for row in rows)} "
             f"beyond the tolerance): {reason}\n" for (verdict, scene, reason), rows in reasons.items()]
    return "".join(lines) or "None.\n"


def costs(kept):
    return markdown(["run", "core-seconds", "made by"], [
        (name, seconds(cost["core_seconds"]), f"{cost['version']} ({cost['commit']}), {cost['date']}")
        for name, cost in sorted(kept["costs"].items())])


# File -> marker -> its table, from what is kept and the root of the repository.
TABLES = {"README.md": {"trust": lambda kept, _: trust_table(kept)},
          "docs/results.md": {"failures": lambda kept, _: failures(kept), "rows": lambda kept, _: all_rows(kept),
                              "costs": lambda kept, _: costs(kept)},
          "docs/gallery.md": {"gallery": gallery.table}}


def replaced(text, name, content):
    """`text` with `content` between the markers of `name`."""
    begin, end = f"<!-- {name}: made by compare/report/trust_table.py -->\n", f"<!-- end of {name} -->"
    head, opened, rest = text.partition(begin)
    _, closed, tail = rest.partition(end)
    if not opened or not closed:
        raise ValueError(f"there are no markers '{begin.strip()}' and '{end}'")
    return f"{head}{begin}\n{content}\n{end}{tail}"


def render(root, kept):
    """File below `root` -> its text with present tables."""
    texts = {}
    for file, tables in TABLES.items():
        texts[file] = (root / file).read_text(encoding="utf-8")
        for name, make in tables.items():
            try:
                texts[file] = replaced(texts[file], name, make(kept, root))
            except ValueError as error:
                raise ValueError(f"{file}: {error}") from error
    return texts


def check(root, kept, verified):
    problems = [f"{file}: its tables are not those of the kept results; compare/report/trust_table.py writes them"
                for file, text in render(root, kept).items() if text != (root / file).read_text(encoding="utf-8")]
    if verified:
        for row, old in kept_results.moved(kept, verified):
            problems.append(f"{row['id']}: kept {number(old['value'])}, {old['verdict']}; "
                            f"now {number(row['value'])}, {row['verdict']}")
    return problems


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--verify", type=given_path, help="directory with results.json of `make verify`")
    parser.add_argument("--check", action="store_true", help="only say whether the tables are current")
    parser.add_argument("--root", type=given_path, default=ROOT, help="the repository")
    options = parser.parse_args(arguments)
    path = options.root / "compare/kept/verify/results.json"
    kept, verified = kept_results.read(path), None
    try:
        if options.verify:
            verified = json_of(options.verify / "results.json")
        if options.check:
            problems = check(options.root, kept, verified)
            print("\n".join(problems) or "tables and kept results agree")
            return 1 if problems else 0
        if verified:
            kept = kept_results.merged(kept, verified)
            if (options.verify / "curves.json").exists():
                gallery.write_pictures(options.verify, options.root)
        texts = render(options.root, kept)
    except (OSError, ValueError) as error:
        complain(f"trust_table: {error}")
        return 2
    if verified:
        kept_results.write(path, kept)
        figure = options.verify / "plots/run-out.png"
        if figure.exists():
            charts.shrink(figure, options.root / "compare/report/picture.png")
    for file, text in texts.items():
        write_whole(options.root / file, text)
    return 0


if __name__ == "__main__":
    sys.exit(ended(main, sys.argv[1:]))
