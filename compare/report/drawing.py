"""How one curve of each kind is drawn, the same in all figures: our runs as solid lines, DEM-VOF records dashed in the
same colour with their band, stock programs dotted, published series as open marks, theory in black."""

import numpy as np

from report import style
from report.results import arrays


def draw_run(axis, results, run, curve, colour, label, scale=1.0, linestyle="-"):
    """Our own curve; False where there is none."""
    found = results.curve(run, curve)
    if not found:
        return False
    x, y = found
    axis.plot(x, scale * y, color=colour, label=label, linestyle=linestyle)
    return True


def draw_records(axis, results, scene, curve, colour, label, scale=1.0):
    """The recorded DEM-VOF seeds of a scene: their mean, and as a band their range. One seed has no band, and its label
    says so. False where there is no record."""
    seeds = [found for entry in results.records.get(scene, {}).values() if (found := arrays(entry, curve))]
    if not seeds:
        return False
    begin, end = max(x[0] for x, _ in seeds), min(x[-1] for x, _ in seeds)
    common = np.linspace(begin, end, 400)
    stack = scale * np.array([np.interp(common, x, y) for x, y in seeds])
    mean = stack.mean(axis=0)
    text = f"DEM-VOF{label and ', ' + label} ({band_of(len(seeds))})"
    known = axis.get_legend_handles_labels()[1]
    axis.plot(common, mean, color=colour, linestyle="--", linewidth=1.2, label=None if text in known else text)
    if len(seeds) > 1:
        axis.fill_between(common, stack.min(axis=0), stack.max(axis=0), color=colour, alpha=0.25, linewidth=0)
    return True


def band_of(seeds):
    return "one seed, no band" if seeds == 1 else f"mean and range of {seeds} seeds"


def draw_peers(axis, results, run, curve, scale=1.0):
    """The same case by stock programs; False where there is no record."""
    found = {program: drawn for program, entry in results.peers.get(run, {}).items() if (drawn := arrays(entry, curve))}
    for program, (x, y) in found.items():
        axis.plot(x, scale * y, color=style.PEER, linestyle=":", linewidth=1.4, label=program)
    return bool(found)


def draw_published(axis, results, file, column, colour, label, scale=1.0):
    """A series of cases/published as open marks; False where the file is not there."""
    series = results.published(file, column)
    if series is None:
        return False
    axis.plot(series[0], scale * series[1], color=colour, linestyle="none", marker="o", markersize=4, markerfacecolor="none",
              label=label)
    return True


def runs_with(results, runs, curve):
    """Those of `runs` that have the curve, or of which a record has it."""
    return [run for run in runs if results.curve(run, curve)
            or any(arrays(entry, curve) for entry in results.records.get(run, {}).values())]


def finish(figure, axis, xlabel, ylabel, results, runs, directory, name):
    axis.set_xlabel(xlabel)
    axis.set_ylabel(ylabel)
    style.legend(axis)
    style.stamp(figure, results.facts(*runs))
    return [style.save(figure, directory, name)]
