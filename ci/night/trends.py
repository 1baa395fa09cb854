"""Trend plots: each metric and cost against the date of the nights, in one self-contained page. Every night says its date, commit
and value, and leads to its summary where that is kept; the colours are those of the reader's screen, light or dark."""

from __future__ import annotations

import datetime
import html
import statistics
from collections import defaultdict
from pathlib import Path
from typing import Sequence

from granvof_files import write_whole
from night.change import METRIC, noise
from night.history import History, Point

SHOWN = 60  # nights
WIDTH, HEIGHT = 320, 140
LEFT, RIGHT, TOP, BOTTOM = 58, 310, 12, 108  # of what is drawn in
FLAT = 0.01  # of the median, to each side, where numbers never move: else rounding would be all that is seen
# The marks are told apart by the colour-blind, and by their shape, too.
STYLE = """
:root{--text:#1a1a1a;--soft:#595959;--back:#ffffff;--mark:#0072b2;--bad:#a63a00;--band:#99999940}
@media(prefers-color-scheme:dark){:root{--text:#e8e8e8;--soft:#a8b0b8;--back:#14171a;--mark:#7cc0f5;--bad:#ff9a66;--band:#99999950}}
body{font:15px/1.4 sans-serif;max-width:72rem;margin:auto;padding:1rem;color:var(--text);background:var(--back)}
pre{overflow-x:auto}h3{font-size:.85rem;margin:0;overflow-wrap:anywhere}small{color:var(--soft);font-weight:400}
section{display:grid;gap:.8rem;grid-template-columns:repeat(auto-fill,minmax(min(100%,20rem),1fr))}svg{width:100%;height:auto}
text{fill:var(--soft);font-size:10px}polyline{fill:none;stroke:var(--mark)}.axis,.median{stroke:var(--soft);stroke-width:.7}
.band{fill:var(--band)}.night circle{fill:var(--mark)}.night rect{fill:var(--bad)}a:focus-visible{outline:2px solid var(--mark)}
"""


def _days(date: str) -> float:
    return datetime.datetime.fromisoformat(date.replace("Z", "+00:00")).timestamp() / 86400.0


def _scale(low: float, high: float, begin: float, end: float):
    """From [low, high] to [begin, end]; where there is one value only, to the middle."""
    if low == high:
        return lambda value: 0.5 * (begin + end)
    return lambda value: begin + (value - low) / (high - low) * (end - begin)


def _mark(point: Point, x: float, y: float, runs: Path) -> str:
    bad = point.verdict == "differs"
    said = f"{point.date[:10]}, {point.commit[:12]}: {point.value:.6g}" + (", differs" if bad else "")
    shape = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3"/>' if not bad else \
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1"/><rect class="differs" x="{x - 3.5:.1f}" y="{y - 3.5:.1f}" width="7" height="7"/>'
    night = f'<g class="night"><title>{html.escape(said)}</title>{shape}</g>'
    summary = runs / point.run / "summary.txt"
    return f'<a href="../{html.escape(point.run)}/summary.txt">{night}</a>' if point.run and summary.exists() else night


def _panel(title: str, unit: str, points: Sequence[Point], runs: Path) -> str:
    points = points[-SHOWN:]
    known = [point for point in points if point.value is not None]
    heading = f"<div><h3>{html.escape(title)} <small>[{html.escape(unit)}]</small></h3>"
    if not known:
        return f"{heading}<p><small>no value in {len(points)} nights</small></p></div>"
    values = [point.value for point in known]
    median = statistics.median(values)
    spread = METRIC.width * noise(values)
    low, high = min(*values, median - spread), max(*values, median + spread)
    if high - low < 1e-6 * abs(median) or high == low:
        apart = max(FLAT * abs(median), 1e-12)
        low, high = median - apart, median + apart
    days = [_days(point.date) for point in points]
    across, up = _scale(days[0], days[-1], LEFT + 6, RIGHT - 6), _scale(low, high, BOTTOM - 6, TOP + 6)
    places = [(across(_days(point.date)), up(point.value)) for point in known]
    drawn = [f'<rect class="band" x="{LEFT}" width="{RIGHT - LEFT}" y="{up(median + spread):.1f}" '
             f'height="{max(0.0, up(median - spread) - up(median + spread)):.1f}"/>',
             f'<line class="median" x1="{LEFT}" x2="{RIGHT}" y1="{up(median):.1f}" y2="{up(median):.1f}"/>',
             f'<path class="axis" fill="none" d="M{LEFT} {TOP}V{BOTTOM}H{RIGHT}"/>',
             *(f'<text x="{LEFT - 4}" y="{up(value) + 3:.1f}" text-anchor="end">{value:.5g}</text>' for value in (low, high)),
             f'<text x="{LEFT}" y="{BOTTOM + 14}">{points[0].date[:10]}</text>',
             f'<text x="{RIGHT}" y="{BOTTOM + 14}" text-anchor="end">{points[-1].date[:10]}</text>',
             f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in places)}"/>',
             *(_mark(point, x, y, runs) for point, (x, y) in zip(known, places))]
    return f'{heading}<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{html.escape(title)}">{"".join(drawn)}</svg></div>'


def write_page(history: History, host: str, summary: str, path: Path) -> None:
    """One section a scene and one for the costs of this host, the summary on top. `path`: in the directory of its run, beside those
    of the others."""
    panels: dict[str, list] = defaultdict(list)
    for check, scene, metric, unit in history.metric_names():
        kind = check.rsplit(".", 1)[-1]  # of the reference; one metric may be held against several
        panels[scene].append((f"{metric} ({kind})", unit, history.metric_points(check)))
    costs = [(name, unit, history.cost_points(name, host)) for name, unit in history.cost_names(host)]
    sections = [*((scene, scene, found) for scene, found in sorted(panels.items())), *([("cost", f"cost on {host}", costs)] if costs else [])]
    body = [f"<pre>{html.escape(summary)}</pre>"]
    for key, title, section in sections:
        drawn = "".join(_panel(*panel, path.parent.parent) for panel in section)
        body.append(f'<h2>{html.escape(title)}</h2><section id="{html.escape(key)}">{drawn}</section>')
    write_whole(
        path, '<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
        f'<meta name="color-scheme" content="light dark"><title>granvof nightly: trends</title><link rel="icon" href="data:,">'
        f"<style>{STYLE}</style><h1>granvof nightly: trends</h1>{''.join(body)}</html>\n")
