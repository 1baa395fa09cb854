#!/usr/bin/python3
"""Error against cost, one picture a scene, from points.json of `granvof-compare charts`; runs nothing.

Leaves charts.json beside the pictures, the section of the report (sections.py), with the ablations and the advice that
there are (SCENE/ablate.json of `granvof-compare ablate`, SCENE.json of `granvof-compare advise`) as tables.

--keep DIR copies what was drawn from, a few JSON files, to DIR (compare/kept): the report of a clone in which no chart was
run shows these, with their version and date. A chart that was not drawn stays as it was kept.
"""

import argparse
import math
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "compare"), str(ROOT / "solver/python")]

from complaint import complain, ended, given_path  # noqa: E402
from granvof_files import json_of, required, write_json  # noqa: E402
from report import style, versions  # noqa: E402
from report.results import Damaged, read_json  # noqa: E402
from report.style import plt  # noqa: E402

LOWEST = 1e-4  # relative; an error below it is drawn there, as is one far inside the reference's own uncertainty


def load(directory):
    """Content of points.json; None where there is none."""
    path = Path(directory) / "points.json"
    return read_json(path, "charts", "methods", "date") if path.exists() else None


def ablations(directory):
    """What `granvof-compare ablate` left below `directory`, one entry a scene, in the order of their names."""
    return [read_json(path, "scene", "rows", "metrics") for path in sorted(Path(directory).glob("*/ablate.json"))]


def advices(directory):
    """What `granvof-compare advise` left in `directory`, one entry a scene."""
    return [read_json(path, "scene", "steps", "summary") for path in sorted(Path(directory).glob("*.json"))]


def look(methods):
    """Colour, marker and line of each method, the same in all charts."""
    colours = style.CYCLE + ["#882255", "0.45", style.BLACK]  # yellow is too pale for a line
    return {method["name"]: {"color": colours[i % len(colours)], "marker": style.MARKERS[i % len(style.MARKERS)],
                             "linestyle": style.LINES[i % len(style.LINES)]} for i, method in enumerate(methods)}


def draw(chart, methods, directory):
    """Writes error-cost-CASE.{png,pdf} and gives its name back; None if no panel has a reference."""
    panels = [panel for panel in chart["panels"] if panel["defined"] and any(error is not None for error in panel["errors"])]
    if not panels:
        return None
    columns = min(len(panels), 2)
    rows = math.ceil(len(panels) / columns)
    figure, axes = plt.subplots(rows, columns, squeeze=False, figsize=(3.9 * columns + 2.6, 4.2 * rows + 0.2))
    for axis in axes.flat[len(panels):]:
        axis.set_axis_off()
    for axis, panel in zip(axes.flat, panels):
        draw_panel(axis, chart, panel, look(methods))
    handles, labels = axes[0][0].get_legend_handles_labels()
    for axis in axes.flat[1:]:
        for handle, label in zip(*axis.get_legend_handles_labels()):
            if label not in labels:
                handles.append(handle)
                labels.append(label)
    axes[0][-1].legend(handles, labels, loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=7.5)
    style.stamp(figure, stamps(chart))
    return style.save(figure, directory, f"error-cost-{chart['case']}")


def shown_at(panel, error):
    """Where an error is drawn: what lies below a quarter of the reference's uncertainty means nothing, and stands there."""
    return max(error, LOWEST, 0.25 * panel["floor"])


def draw_panel(axis, chart, panel, looks):
    axis.set_xscale("log")
    axis.set_yscale("log")
    drawn = [shown_at(panel, error) for error in panel["errors"] + panel.get("other_errors", []) if error is not None]
    for name, how in looks.items():
        shown = sorted((point["core_s_per_s"], shown_at(panel, error), point["cell"])
                       for point, error in zip(chart["points"], panel["errors"])
                       if point["method"] == name and error is not None and point["core_s_per_s"] > 0)
        if not shown:
            continue
        axis.plot([x for x, _, _ in shown], [y for _, y, _ in shown], label=name, markersize=5, linewidth=1.3, **how)
        if name == next(iter(looks)):  # the grids of one line: those of the others stand nearly above them
            for x, y, cell in shown:
                axis.annotate(f"{1e3 * cell:.3g} mm", (x, y), textcoords="offset points", xytext=(0, 8), ha="center", fontsize=6.5,
                              color=how["color"], path_effects=[style.HALO])
    draw_front(axis, chart, panel)
    draw_failed(axis, chart, looks, 1.6 * max(drawn))
    draw_others(axis, chart, panel)
    if panel["floor"] > 0:
        axis.axhspan(axis.get_ylim()[0] / 10, panel["floor"], color="0.85", zorder=0,
                     label="inside the reference's own uncertainty")
        axis.set_ylim(bottom=0.8 * min(min(drawn), panel["floor"]))
    if chart["dem_cost"]:
        axis.axvline(chart["dem_cost"], color=style.DEM, linewidth=1.2, linestyle=":", label="cost of DEM-VOF (demvof)")
    axis.set_title(f"{chart['case']}: {panel['quantity'].replace('_', ' ')} against {panel['against']}", loc="left", fontsize=9)
    axis.set_ylabel("relative error [-]")
    axis.set_xlabel("cost [core-s per simulated s]")
    add_work_units(axis, chart)


def draw_front(axis, chart, panel):
    front = [(chart["points"][i]["core_s_per_s"], shown_at(panel, panel["errors"][i])) for i in panel["pareto"]]
    if front:
        axis.plot([x for x, _ in front], [y for _, y in front], color=style.BLACK, linewidth=0.8, linestyle="-", alpha=0.5,
                  marker="o", markersize=11, markerfacecolor="none", markeredgewidth=0.8, label="Pareto front")


OTHER_MARKERS = ["*", "X", "h", "d", "8"]


def draw_others(axis, chart, panel):
    """What other programs made of the case, and the reference at other resolutions: points, joined to a line where they have one."""
    lines = {}
    for other, error in zip(chart.get("others", []), panel.get("other_errors", [])):
        named = other["name"] + (f" ({other['about']})" if other["about"] else "")
        marked = lines.setdefault(other.get("line") or named, [])
        if error is not None:
            marked.append((other["core_s_per_s"], shown_at(panel, error), other["name"].rpartition(", ")[2]))
    for i, (name, points) in enumerate(lines.items()):
        if not points:
            continue
        points.sort()
        joined = len(points) > 1
        axis.plot([x for x, _, _ in points], [y for _, y, _ in points], linestyle="--" if joined else "none", linewidth=0.9,
                  color=style.BLACK, marker=OTHER_MARKERS[i % len(OTHER_MARKERS)], markersize=9, markerfacecolor="white",
                  markeredgewidth=1.1, label=name)
        for x, y, mark in points if joined else []:
            axis.annotate(mark, (x, y), textcoords="offset points", xytext=(0, -12), ha="center", fontsize=6.5,
                          path_effects=[style.HALO])


def draw_failed(axis, chart, looks, height):
    """Runs that failed, at the cost they had come to, above all errors."""
    costs = [point["core_s_per_s"] for point in chart["points"] if point["core_s_per_s"] > 0]
    for point in chart["points"]:
        if point["failure"]:
            cost = point["core_s_per_s"] or min(costs, default=1.0)
            axis.plot([cost], [height], linestyle="none", marker="X", markersize=9, color=looks[point["method"]]["color"],
                      label=style_once(axis, "failed"))
            axis.annotate(f"{1e3 * point['cell']:.3g}", (cost, height), textcoords="offset points", xytext=(5, 4), fontsize=6)


def style_once(axis, label):
    return None if label in axis.get_legend_handles_labels()[1] else label


def add_work_units(axis, chart):
    """A second scale on top: the same cost in work units, by the kernel timed beside the runs (median)."""
    units = sorted(point["core_s_per_s"] / point["work_units_per_s"] for point in chart["points"] if point["work_units_per_s"] > 0)
    if not units:
        return
    unit = units[len(units) // 2]
    second = axis.secondary_xaxis("top", functions=(lambda x: x / unit, lambda x: x * unit))
    second.set_xlabel("work units per simulated s", fontsize=7)
    second.tick_params(labelsize=6)


def stamps(chart):
    """One entry a version and case: what a plot is stamped with."""
    found = {}
    for point in chart["points"]:
        if point["case_hash"]:
            key = (point["version"], point["case_hash"], point["host"])
            found.setdefault(key, {"id": chart["case"], "version": point["version"], "case_hash": point["case_hash"],
                                   "host": point["host"]})
    return list(found.values())


def draw_all(content, directory):
    """Names of the pictures, in the order of the charts."""
    names = (draw(chart, content["methods"], directory) for chart in content["charts"])
    return [name for name in names if name]


def caption(name, made=""):
    """`made`: the version, where it is another than the page's."""
    return (f"{name.removeprefix('error-cost-')}: error against cost{made}; points are grids, circles the Pareto front; grey: inside the "
            "reference's own uncertainty (what lies below a quarter of it is drawn there).")


def versions_of(charts):
    return sorted({point["version"] for chart in charts for point in chart["points"] if point["version"]})


def older(made, now):
    """", by version 0.1.0, of an older minor version: not comparable", or ""."""
    found = [versions.named(version, now) for version in made if versions.remark(version, now)]
    return f", by version {', '.join(found)}" if found else ""


def ablation_table(study, now=None):
    """Change of each metric without a part, for the page; what is beyond its tolerance carries a star."""
    def cell(effect, full):
        value = effect["value"] if full else effect["change"]
        return "-" if value is None else f"{value:{'' if full else '+'}.3g}{' *' if effect['beyond'] else ''}"

    references = [metric.get("reference") for metric in study["metrics"]]
    rows = [["reference", *("-" if value is None else f"{value:.3g}" for value in references), "-"]]
    for index, row in enumerate(row for row in study["rows"] if row["applies"]):
        cells = [cell(effect, index == 0) for effect in row["effects"]] or ["failed"] * len(study["metrics"])
        rows.append([row["part"], *cells, row["core_seconds"]])
    setting = " ".join([study["scene"], *study["set"]])
    return {"caption": f"{setting}: each part of the model removed or changed in turn, change of each metric against the full model; "
                       f"* beyond its tolerance (granvof {versions.named(study['version'], now)}, case {study['case_hash'][:8]}, {study['host']})",
            "columns": ["part"] + [metric["metric"] for metric in study["metrics"]] + ["core-s"], "rows": rows}


def advice_table(study, now=None):
    """The evidence of an advice: every configuration that was tried, in order."""
    rows = [[step["configuration"], "-" if step["error"] is None else f"{100 * step['error']:.2g} %", step["core_s_per_s"],
             step["remark"]] for step in study["steps"]]
    return {"caption": f"advice for {study['scene']} ({versions.named(study['version'], now)}): " + "; ".join(study["summary"]),
            "columns": ["configuration", "error", "core-s per s", "remark"], "rows": rows}


def section(content, names, ablated, advised=(), now=None):
    """charts.json, as sections.py reads it, for a page of the minor version `now`."""
    text = ["Errors are relative; lower left is better. Methods: " +
            "; ".join(method["name"] + (f" ({method['about']})" if method["about"] else "") for method in content["methods"]) + "."]
    for chart in content["charts"]:
        text += chart["lines"]
        if chart["left_out"]:
            text.append(f"{chart['case']}, left out: {'; '.join(chart['left_out'])}.")
    made = {f"error-cost-{chart['case']}": older(versions_of([chart]), now) for chart in content["charts"]}
    return {"title": "Accuracy against cost", "text": text, "commit": ", ".join(versions_of(content["charts"])), "date": content["date"],
            "figures": [{"file": f"{name}.png", "caption": caption(name, made[name])} for name in names],
            "tables": [advice_table(study, now) for study in advised] + [ablation_table(study, now) for study in ablated]}


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--charts", type=given_path, required=True, help="directory with points.json")
    parser.add_argument("--ablations", type=given_path, help="directory of the ablations (default: ablate beside it)")
    parser.add_argument("--advice", type=given_path, help="directory of the advice (default: advise beside it)")
    parser.add_argument("--keep", type=given_path, help="copy what was drawn from to this directory")
    parser.add_argument("--picture", type=given_path, help="write the picture of one scene here too (PNG, few bytes)")
    parser.add_argument("--scene", default="s1", help="the scene of --picture (s1)")
    options = parser.parse_args(arguments)
    try:
        content = load(options.charts)
        if content is None:
            complain(f"charts: no points.json in {options.charts}; run `make charts` first")
            return 2
        return write(content, options)
    except Damaged as error:
        complain(f"charts: {error}")
        return 2


def write(content, options):
    """Pictures, the section, and what was asked for beside them; Damaged where a file of a study is."""
    beside = options.charts.resolve().parent
    names = make_section(options.charts, content, options.ablations or beside / "ablate", options.advice or beside / "advise")
    if options.keep:
        keep(options, beside)
    for name in names:
        print(options.charts / f"{name}.png")
    if options.picture:
        name = f"error-cost-{options.scene}"
        if name not in names:
            complain(f"charts: no chart of {options.scene} in {options.charts}")
            return 2
        shrink(options.charts / f"{name}.png", options.picture)
    return 0


def make_section(directory, content, ablated, advised, now=None):
    """Pictures and charts.json into `directory`; names of the pictures. Without `now` the newest of the charts is the page's."""
    names = draw_all(content, directory)
    now = now or versions.newest(versions_of(content["charts"]))
    write_json(directory / "charts.json", section(content, names, ablations(ablated), advices(advised), now))
    return names


def from_kept(kept, directory, now=None):
    """Draws the charts of an earlier version that `kept` holds, and says so in their section; False if it holds none."""
    content = load(kept / "charts")
    if content is None:
        return False
    make_section(directory, content, kept / "ablate", kept / "advise", now)
    path = directory / "charts.json"
    shown = json_of(path)
    shown["title"] += " (kept results)"
    shown["text"].insert(0, f"Not run here: results kept in the repository, {made(content, now)}. `make charts` runs them anew.")
    write_json(path, shown)
    return True


def made(content, now=None):
    """"s1, canary: VERSION, DATE; s2: ..."."""
    cases = {}
    for chart in content["charts"]:
        by = ", ".join(versions.named(version, now) for version in versions_of([chart]))
        cases.setdefault(f"{by}, {chart.get('date', content['date'])[:10]}", []).append(chart["case"])
    return "; ".join(f"{', '.join(of)}: {how}" for how, of in cases.items())


def merged(content, kept):
    """`content`, and the charts that only `kept` has; each with its own date."""
    if kept is None:
        return content
    charts = {chart["case"]: {"date": each["date"]} | chart for each in (kept, content) for chart in each["charts"]}
    names = {method["name"] for method in content["methods"]}
    methods = content["methods"] + [method for method in kept["methods"] if method["name"] not in names]
    return content | {"methods": methods, "charts": list(charts.values())}


def write_kept(path, content):
    write_json(path, content, separators=(",", ":"))


def keep(options, beside):
    write_kept(options.keep / "charts/points.json", merged(load(options.charts), load(options.keep / "charts")))
    for source, target in [(options.ablations or beside / "ablate", "ablate"), (options.advice or beside / "advise", "advise")]:
        for path in sorted(source.glob("**/*.json")):
            write_kept(options.keep / target / path.relative_to(source), json_of(path))
    stability = beside / "stability/stability.json"
    if stability.exists():
        write_kept(options.keep / "stability/stability.json", json_of(stability))


def shrink(source, target):
    """A copy of at most 900 pixels in 256 colours."""
    from PIL import Image
    image = Image.open(required(source)).convert("RGB")
    width = min(image.width, 900)
    image = image.resize((width, round(image.height * width / image.width)), Image.LANCZOS)
    image.quantize(256, method=Image.Quantize.FASTOCTREE).save(target, optimize=True)  # keeps the colours of the lines


if __name__ == "__main__":
    sys.exit(ended(main, sys.argv[1:]))
