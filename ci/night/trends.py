"""Trend plots: each metric and cost against the nights, with the commit under each point, in one self-contained page."""

from __future__ import annotations

import base64
import html
import io
import statistics
from collections import defaultdict
from pathlib import Path
from typing import Sequence

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

from granvof_files import write_whole  # noqa: E402
from night.change import METRIC, noise  # noqa: E402
from night.history import History, Point  # noqa: E402

SHOWN = 60  # nights
BLUE, ORANGE, GREY = "#0072b2", "#d55e00", "#999999"  # told apart by the colour-blind too


def _draw(axes, title: str, unit: str, points: Sequence[Point]) -> None:
    points = points[-SHOWN:]
    known = [(i, p.value) for i, p in enumerate(points) if p.value is not None]
    axes.set_title(title, fontsize=8)
    axes.set_ylabel(f"[{unit}]", fontsize=7)
    axes.tick_params(labelsize=6)
    if known:
        values = [value for _, value in known]
        median = statistics.median(values)
        spread = METRIC.width * noise(values)
        axes.axhspan(median - spread, median + spread, color=GREY, alpha=0.25, linewidth=0)
        axes.axhline(median, color=GREY, linewidth=0.8)
        axes.plot(*zip(*known), color=BLUE, marker="o", markersize=3, linewidth=1)
        bad = [(i, p.value) for i, p in enumerate(points) if p.value is not None and p.verdict == "differs"]
        if bad:
            axes.plot(*zip(*bad), color=ORANGE, marker="s", markersize=5, linestyle="none")
        # Numbers that never move would else be drawn at the scale of their rounding errors.
        if max(values) - min(values) < 1e-6 * abs(median):
            axes.set_ylim(median - max(0.01 * abs(median), 1e-12), median + max(0.01 * abs(median), 1e-12))
    every = max(1, len(points) // 8)
    axes.set_xticks(range(0, len(points), every), [p.commit[:7] for p in points[::every]], rotation=45)


def _figure(panels: Sequence[tuple[str, str, Sequence[Point]]]) -> bytes:
    columns = 3
    rows = (len(panels) + columns - 1) // columns
    figure, grid = pyplot.subplots(rows, columns, figsize=(11, 2.3 * rows), squeeze=False, layout="constrained")
    for axes in grid.flat[len(panels):]:
        axes.set_visible(False)
    for axes, (title, unit, points) in zip(grid.flat, panels):
        _draw(axes, title, unit, points)
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=110, metadata={"Software": None})
    pyplot.close(figure)
    return out.getvalue()


def write_page(history: History, host: str, summary: str, path: Path) -> None:
    """One section a scene and one for the costs of this host, the summary on top."""
    panels: dict[str, list] = defaultdict(list)
    for check, scene, metric, unit in history.metric_names():
        kind = check.rsplit(".", 1)[-1]  # of the reference; one metric may be held against several
        panels[scene].append((f"{metric} ({kind})", unit, history.metric_points(check)))
    costs = [(name, unit, history.cost_points(name, host)) for name, unit in history.cost_names(host)]
    sections = [*sorted(panels.items()), *([(f"cost on {host}", costs)] if costs else [])]
    body = [f"<pre>{html.escape(summary)}</pre>"]
    for title, section in sections:
        image = base64.b64encode(_figure(section)).decode()
        heading = html.escape(title)
        body.append(f'<h2>{heading}</h2><img alt="trends of {heading}" src="data:image/png;base64,{image}">')
    write_whole(
        path, '<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
        "<title>granvof nightly: trends</title><style>body{font:15px/1.4 sans-serif;max-width:72rem;margin:auto;"
        "padding:1rem}img{max-width:100%}pre{overflow-x:auto}</style>"
        f"<h1>granvof nightly: trends</h1>{''.join(body)}</html>\n")
