#!/usr/bin/python3
"""Draws which part of the code includes which: docs/architecture.svg, from the #include lines.

docs/architecture.py            write the picture
docs/architecture.py --check    write nothing; exit code 1 if the picture is not that of the code, if parts include each other in
                                a circle, or what they may not
"""

import argparse
import re
import sys
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs/architecture.svg"
GROUPS = ("reference/demvof", "solver", "compare")  # from left to right
GROUP_FOLDERS = ("reference/", "solver/", "compare/")  # what else is included is another project's
LEFT_OUT = {"tests", "bench"}
COLOURS = {"reference/demvof": "#eedfc9", "solver": "#d5e4f2", "compare": "#dcecd8"}
ABOUT = {
    "solver/scene": "case file to scene, checked",
    "solver/model": "lists of closures, fluids",
    "solver/grid": "cells, faces, sides, loops",
    "solver/linear": "multigrid, CG, BiCGSTAB",
    "solver/closures": "one law, one header",
    "solver/closures/drag": "laws of drag, a list",
    "solver/closures/friction": "friction coefficients, a list",
    "solver/closures/packing": "where grains touch, a list",
    "solver/closures/critical_packing": "what shear drives to, a list",
    "solver/closures/granular_temperature": "what of (7) is solved, a list",
    "solver/closures/radial_distribution": "g0, a list",
    "solver/closures/kinetic_transport": "what flying grains carry, a list",
    "solver/closures/slope_limiter": "fluxes of grains, a list",
    "solver/operators": "one term, one file",
    "solver/state": "fields, energy terms",
    "solver/output": "run directory, scalars",
    "solver/parallel": "processes of mpirun",
    "solver/run": "time step, monitors, energy",
    "solver/program": "granvof",
    "compare/input": "runs, records, series",
    "compare/metrics": "one metric, one file",
    "compare/checks": "table, registry, verdicts",
    "compare/lay": "series of others",
    "compare/output": "results, JUnit",
    "compare/engine": "runs: lanes, limits, ends",
    "compare/study": "ablate, charts, advise",
    "compare/program": "granvof-compare",
    "reference/demvof/beads": "LIGGGHTS",
    "reference/demvof/fluid": "OpenFOAM",
    "reference/demvof/coupling": "mapping, drag, impulses",
    "reference/demvof/preparation": "columns, rough floor",
    "reference/demvof/bulk_friction": "chute, mu(I)",
    "reference/demvof/element": "element tests, a material",
    "reference/demvof/program": "demvof",
}
# What a part may include of the others: the libraries `scene` and `output` know nothing of the solver, and are all of it that compare
# knows; demvof also shares the closure of the drag. The first that a part's name begins with holds.
MAY_INCLUDE = {
    "solver/scene": ("solver/scene", "solver/model", "solver/closures/drag", "solver/closures/friction",
                     "solver/closures/radial_distribution", "solver/closures/kinetic_transport", "solver/closures/packing",
                     "solver/closures/critical_packing", "solver/closures/granular_temperature",
                     "solver/closures/slope_limiter"),  # what its keys choose from
    "solver/plausibility": ("solver/scene", "solver/model", "solver/closures"),  # pure functions, in headers
    "solver/output": ("solver/scene", "solver/plausibility"),
    "solver": ("solver",),
    "compare": ("compare", "solver/scene", "solver/output"),
    "reference/demvof/element": ("reference", "solver/scene", "solver/model", "solver/output", "solver/closures"),  # keys of its laws
    "reference": ("reference", "solver/scene", "solver/model", "solver/output", "solver/closures/drag"),
}
WIDTH, HEIGHT, GAP, ROW = 176, 44, 18, 92  # of a box, between boxes, between rows


def sources(root):
    return sorted(path for group in GROUPS for kind in ("*.hpp", "*.cpp") for path in (root / group).rglob(kind)
                  if not LEFT_OUT & set(path.relative_to(root).parts))


def lines_of_includes(root):
    """(part, its file, what the file includes), a line each."""
    for path in sources(root):
        for target in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.MULTILINE):
            yield path.parent.relative_to(root).as_posix(), path, target


def includes(root):
    """Part -> parts it includes."""
    graph = {path.parent.relative_to(root).as_posix(): set() for path in sources(root)}
    for part, _, target in lines_of_includes(root):
        other = Path(target).parent.as_posix()
        if other in graph and other != part:
            graph[part].add(other)
    return graph


def trespasses(root):
    """What a file includes and may not, one sentence each."""
    for part, path, target in lines_of_includes(root):
        allowed = next(may for of, may in MAY_INCLUDE.items() if part.startswith(of))
        if target.startswith(GROUP_FOLDERS) and not target.startswith((part + "/", *allowed)):
            yield f"{path.relative_to(root)} includes {target}; {part} may include {', '.join(allowed)}"


def circle(graph):
    """Parts that include each other, [] where there are none."""
    done, path = set(), []

    def visit(part):
        if part in path:
            return path[path.index(part):] + [part]
        if part in done:
            return []
        path.append(part)
        for other in sorted(graph[part]):
            found = visit(other)
            if found:
                return found
        path.pop()
        done.add(part)
        return []

    for part in sorted(graph):
        found = visit(part)
        if found:
            return found
    return []


def reach(graph, part):
    found = set()
    for other in graph[part]:
        found |= {other} | reach(graph, other)
    return found


def direct(graph):
    """Without what follows from the rest: if a includes b and b includes c, a to c is not drawn."""
    return {part: others - {other for between in others for other in reach(graph, between)} for part, others in graph.items()}


def level(graph, part):
    return max((level(graph, other) + 1 for other in graph[part]), default=0)


def places(graph):
    """Part -> (x, y) of its box's upper left corner."""
    rows = {part: level(graph, part) for part in graph}
    top = max(rows.values())
    at, left = {}, GAP
    for group in GROUPS:
        members = {}
        for part in sorted(graph):
            if part.startswith(group + "/"):
                members.setdefault(rows[part], []).append(part)
        columns = max(map(len, members.values()), default=0)
        for row, parts in members.items():
            shift = (columns - len(parts)) * (WIDTH + GAP) / 2
            for column, part in enumerate(parts):
                at[part] = (left + shift + column * (WIDTH + GAP), GAP + (top - row) * ROW)
        left += columns * (WIDTH + GAP) + GAP
    return at


def group_of(part):
    return next(group for group in GROUPS if part.startswith(group + "/"))


def svg(graph):
    at = places(graph)
    width = max(x for x, _ in at.values()) + WIDTH + GAP
    height = max(y for _, y in at.values()) + HEIGHT + GAP
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" font-family="sans-serif">',
             "<title>Which part of the code includes which</title>", f'<rect width="{width:.0f}" height="{height:.0f}" fill="#ffffff"/>',
             '<marker id="to" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
             '<path d="M0,0 L8,4 L0,8 z" fill="#666"/></marker>']
    for part, others in sorted(direct(graph).items()):
        for other in sorted(others):
            (x, y), (u, v) = at[part], at[other]
            x, y, u = x + WIDTH / 2, y + HEIGHT, u + WIDTH / 2
            lines.append(f'<path d="M{x:.0f},{y:.0f} C{x:.0f},{y + ROW / 2:.0f} {u:.0f},{v - ROW / 2:.0f} {u:.0f},{v:.0f}" '
                         'fill="none" stroke="#666" marker-end="url(#to)"/>')
    for part, (x, y) in sorted(at.items()):
        lines += [f'<rect x="{x:.0f}" y="{y:.0f}" width="{WIDTH}" height="{HEIGHT}" rx="5" fill="{COLOURS[group_of(part)]}" '
                  'stroke="#888"/>',
                  f'<text x="{x + WIDTH / 2:.0f}" y="{y + 18:.0f}" text-anchor="middle" font-size="13" font-weight="bold">'
                  f'{escape(part.removeprefix("reference/"))}</text>',
                  f'<text x="{x + WIDTH / 2:.0f}" y="{y + 35:.0f}" text-anchor="middle" font-size="11">'
                  f'{escape(ABOUT.get(part, ""))}</text>']
    return "\n".join([*lines, "</svg>"]) + "\n"


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only say whether the picture is current")
    options = parser.parse_args(arguments)
    graph = includes(ROOT)
    round_about = circle(graph)
    if round_about:
        print(f"architecture: parts include each other: {' -> '.join(round_about)}", file=sys.stderr)
        return 1
    forbidden = list(trespasses(ROOT))
    if forbidden:
        print("\n".join(f"architecture: {line}" for line in forbidden), file=sys.stderr)
        return 1
    if not options.check:
        PICTURE.write_text(svg(graph), encoding="utf-8")
    elif PICTURE.read_text(encoding="utf-8") != svg(graph):
        print("architecture: docs/architecture.svg is not that of the code; docs/architecture.py draws it", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
