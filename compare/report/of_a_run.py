"""Film, plots and a page of any run directory: `compare/show DIR...`. Needs no table of checks and no other run."""

import math
from pathlib import Path

import jinja2
import numpy as np

import granvof
from granvof_files import OF_READING, bytes_of, toml_in, write_whole
from report import snapshots, states, style
from report.embedded import encoded
from report.film import caption, film
from report.results import Results
from report.style import plt

# (title, unit, columns of series.csv, factor): a plot each, of the columns that there are
PLOTS = (("fronts", "mm", ("front_dense", "front_dilute", "front_quantile", "liquid_front"), 1e3),
         ("heights", "mm", ("deposit_height", "y_solid_mean", "interface_height", "bed_top"), 1e3),
         ("pressure at the base", "Pa", ("p_base",), 1.0),
         ("largest speeds", "m/s", ("u_s_max", "u_liquid_max"), 1.0))
FACTS = ("version", "start_date", "cells", "steps", "simulated_time", "core_seconds", "solid_volume_error", "liquid_volume_error",
         "solid_fraction_max")


def scene_of(facts):
    """What the pictures need of a scene, from the resolved case that a run.json holds. Raises granvof.NotARun."""
    try:
        case = toml_in(facts["resolved_case"])
        tank, bed = case["tank"], case.get("bed", {})
        scaled = case["time"].get("unit") == "column"
        scene = {"title": text(facts["title"]), "tank": [*tank["size"], tank.get("depth", 1.0)][:3], "dimensions": case["scene"]["dimensions"],
                 "cells": facts["grid"]["cells"], "spacing": facts["grid"]["spacing"],
                 "time_unit": math.sqrt(bed["height"] / tank["gravity"]) if scaled else 1.0}
        for lengths in (scene["tank"], scene["cells"], scene["spacing"], [scene["time_unit"]] * 3):
            if len(lengths) != 3 or not all(0.0 < length < math.inf for length in lengths):
                raise ValueError("tank, cells, spacing or unit of time are no lengths")
        return scene
    except OF_READING as error:
        raise granvof.NotARun(f"run.json: {type(error).__name__}: {error}") from error


def text(value):
    if not isinstance(value, str):
        raise ValueError(f"{type(value).__name__} given, not a text")
    return value


def said_of(facts, directory):
    """What the page says of a run: its entry as of a comparison, what was warned of, and a table. Raises granvof.NotARun."""
    try:
        host = facts.get("host") or {}
        entry = {"id": text(facts.get("scene", directory.name)), "case": facts.get("scene", directory.name),
                 "case_hash": text(facts.get("case_hash", "")), "version": text(facts.get("version", "")),
                 "commit": text(facts.get("git_commit", "")), "host": text(host.get("cpu_model", ""))}
        if Path(entry["id"]).name != entry["id"]:
            raise ValueError(f"'{entry['id']}' is no name of a scene")
        table = [(what.replace("_", " "), shortened(facts[what])) for what in FACTS if facts.get(what) is not None]
        return entry, warnings_of(facts), table + model_of(facts)
    except OF_READING as error:
        raise granvof.NotARun(f"run.json: {type(error).__name__}: {error}") from error


def series_plots(run, directory):
    """Names and captions of the plots of series.csv."""
    made = []
    time = np.asarray(run.series.index if granvof.pandas else run.series["time"])
    for title, unit, columns, factor in PLOTS:
        shown = [(name, factor * np.asarray(run.series[name])) for name in columns if name in run.series]
        shown = [(name, values) for name, values in shown if np.isfinite(values).any()]
        if not shown:
            continue
        figure, axis = plt.subplots(figsize=(6.4, 3.6))
        for (name, values), colour, line in zip(shown, style.CYCLE, style.LINES):
            axis.plot(time, values, line, color=colour, label=name)
        axis.set_xlabel("t [s]")
        axis.set_ylabel(f"{title} [{unit}]")
        style.legend(axis)
        name = "series-" + title.replace(" ", "-")
        made.append((style.save(figure, directory, name), f"{title} against time: {', '.join(name for name, _ in shown)}."))
    return made


def show(directory):
    """Writes DIR/report/ (plots, film, report.html) and gives back the page. Raises granvof.NotARun."""
    run = granvof.load(directory, fields=False)
    if not run.facts:
        raise granvof.NotARun(f"{run.directory}: there is no run.json")
    scene = scene_of(run.facts)
    described, warnings, table = said_of(run.facts, run.directory)
    name, out = described["id"], run.directory / "report"
    entry = {"scene": scene, "directory": str(run.directory)}
    results = Results(out, "", "verify", [], {name: described})
    results.curves = {name: entry}
    plots = series_plots(run, out)
    plane = "mid-plane of the tank" if scene["dimensions"] == 3 else "the slice"
    for drawn in snapshots.snapshot_plot(results, name, out):
        plots.append((drawn, f"Solid fraction and colour of the grains, {plane}; black line: alpha = 0.5."))
    for drawn in snapshots.plan_plot(results, name, out):
        plots.append((drawn, "From above: depth of the solid, of grains without pores."))
    plots += [(drawn, states.caption(name)) for drawn in states.state_plot(results, name, out)]
    figures = [{"data": encoded(bytes_of(out / f"{plot}.png")), "caption": said} for plot, said in plots]
    moving = film(entry)
    if moving:
        figures.insert(0, {"data": encoded(moving.write(out / "film")), "caption": caption(name, scene, False)})
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).parent), autoescape=True, undefined=jinja2.StrictUndefined)
    page = out / "report.html"
    write_whole(page, environment.get_template("run_page.html").render(
        name=name, title=scene["title"], figures=figures, resolved=run.facts["resolved_case"], warnings=warnings, facts=table))
    return page


def model_of(facts):
    """The parts of the model that act in the run, as its run.json lists them; nothing where it lists none."""
    parts = [f"{part['name']} {part['equations']}".strip() for part in facts.get("parts", [])]
    return [("model", "; ".join(parts))] if parts else []


def warnings_of(facts):
    ended = facts.get("exit", {})
    said = [] if ended.get("state") == "finished" else [f"The run did not finish: {ended.get('reason') or ended.get('state', 'unknown')}"]
    return said + [warning if isinstance(warning, str) else ", ".join(f"{key}: {value}" for key, value in warning.items())
                   for warning in facts.get("warnings", [])]


def shortened(value):
    return f"{value:.4g}" if isinstance(value, float) else str(value)
