"""report.html: one file that needs nothing else, from disk, on a phone, in light and dark."""

import base64
from pathlib import Path

import jinja2

from report import figures, style
from report.film import film
from report.results import changes

ORDER = ["error", "differs", "stale", "not run", "expected failure", "within band", "agrees"]


def render(results, plots, sections=()):
    """The page as text. `plots` are names in results.directory / "plots"; `sections` those of others (sections.py)."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).parent), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["number"] = number
    environment.filters["slug"] = lambda text: text.replace(" ", "-")
    moving = films(results)  # first: it adds to what is damaged
    counts = {verdict: sum(row["verdict"] == verdict for row in results.rows) for verdict in ORDER}
    return environment.get_template("page.html").render(
        date=results.date,
        frequency=results.frequency,
        previous_date=results.previous_date,
        unexpected=[row for row in results.rows if row["unexpected"]],
        known=[row for row in results.rows if row["verdict"] == "expected failure"],
        idle=[row for row in results.rows if row["verdict"] in ("not run", "stale") and not row["unexpected"]],
        changes=changes(results),
        counts=[(verdict, count) for verdict, count in counts.items() if count],
        rows=sorted(results.rows, key=lambda row: (not row["unexpected"], ORDER.index(row["verdict"]))),
        runs=[run_facts(run) for run in results.runs.values()],
        films=moving,
        damaged=results.damaged,
        sections=sections,
        plots=[{"name": name, "caption": figures.caption(name),
                "data": encoded(results.directory / "plots" / f"{name}.png")} for name in plots])


def films(results):
    """Films of the runs that have one; written beside the plots too."""
    made = []
    for run, entry in results.curves.items():
        moving = results.shown(lambda: film(entry))
        if moving is None:
            continue
        (results.directory / "plots").mkdir(exist_ok=True)
        (results.directory / "plots" / f"film-{run}.apng").write_bytes(moving)
        made.append({"name": f"film-{run}", "data": base64.b64encode(moving).decode("ascii"),
                     "caption": f"{run}: film; colour: solid fraction, blue: liquid, dark line: alpha = 0.5."})
    return made


def run_facts(run):
    numbers = run.get("numbers", {})
    simulated = numbers.get("simulated_time")
    cost = numbers.get("core_seconds")
    return {
        "id": run["id"], "state": run["state"], "reason": run["reason"],
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


def encoded(path):
    return base64.b64encode(path.read_bytes()).decode("ascii")
