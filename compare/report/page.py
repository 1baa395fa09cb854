"""report.html: one file that needs nothing else, from disk, on a phone, in light and dark."""

from pathlib import Path

import jinja2

from granvof_files import bytes_of
from report import figures, kept_results, overview, style
from report.embedded import encoded
from report.film import caption, film
from report.overview import ORDER
from report.results import changes, instants
from report.snapshots import record_of

KEPT_MOVED = 5e-3  # by which a kept value must have moved to be another: more than its last figure shown


def render(results, plots, sections=(), kept=None):
    """The page as text. `plots` are names in results.directory / "plots"; `sections` those of others (sections.py); `kept` what
    README and docs state (kept_results.read())."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).parent), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["number"] = number
    environment.filters["plot_word"] = plot_word
    environment.filters["rounded"] = overview.short
    environment.filters["words"] = lambda name: name.replace("_", " ")
    environment.filters["slug"] = lambda text: text.replace(" ", "-").replace("/", "-")
    states, (kept_date, kept_version) = kept_results.due(kept or {"rows": []}, results.frequency)
    moving = films(results)  # first: it adds to what is damaged
    counts = {verdict: sum(row["verdict"] == verdict for row in results.rows) for verdict in ORDER}
    return environment.get_template("page.html").render(
        date=results.date,
        frequency=results.frequency,
        previous_date=results.previous_date,
        unexpected=[row for row in results.rows if row["unexpected"]],
        glance=overview.at_a_glance(results, plots),
        known=[row for row in results.rows if row["verdict"] == "expected failure"],
        causes=overview.by_cause(results),
        scenes=overview.by_scene(results),
        kept_date=kept_date, kept_version=kept_version,
        kept_changes=changes(results, relative=KEPT_MOVED, since=states) if states else [],
        idle=[row for row in results.rows if row["verdict"] in ("not run", "stale") and not row["unexpected"]],
        changes=changes(results),
        counts=[(verdict, count) for verdict, count in counts.items() if count],
        rows=results.rows,
        runs=[run_facts(run) for run in results.runs.values()],
        films=moving,
        damaged=results.damaged,
        sections=sections,
        plots=[{"name": name, "caption": figures.caption(name),
                "data": encoded(bytes_of(results.directory / "plots" / f"{name}.png"))} for name in plots])


def plot_word(name):
    return "fields" if name.startswith("snapshots-") else "plot"


def films(results):
    """Films of the runs that have one; written beside the plots too."""
    made = []
    for run, entry in results.curves.items():
        if not results.shown(lambda: any(instants(entry))):
            continue  # where a run cannot be shown, its record is not asked
        name, record = results.shown(lambda: record_of(results, results.record_of(run))) or (None, None)
        moving = results.shown(lambda: film(entry, record, f"DEM-VOF ({name})"))
        if moving is None:
            continue
        data = moving.write(results.directory / "plots" / f"film-{run}")
        made.append({"name": f"film-{run}", "data": encoded(data), "caption": caption(run, entry["scene"], record is not None)})
    return made


def run_facts(run):
    numbers = run.get("numbers", {})
    simulated = numbers.get("simulated_time")
    cost = numbers.get("core_seconds")
    return {
        "id": run["id"], "case": run.get("case", run["id"]), "state": run["state"], "reason": run["reason"],
        "set": ", ".join(run["set"]), "cells": numbers.get("cells"), "steps": numbers.get("steps"), "core_seconds": cost,
        "per_second": cost / simulated if cost and simulated else None,
        "speed": numbers.get("cell_steps_per_second"),
        "version": style.label_of_version(run) if run.get("case_hash") else "", "hash": run.get("case_hash", ""),
        "host": run.get("host", ""),
    }


def number(value, digits=4):
    if value is None:
        return "–"
    return value if isinstance(value, str) else f"{value:.{digits}g}"
