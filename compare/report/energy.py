"""Where the energy of a run goes: one plot a run, of every term of the ledger that its run.json states."""

from dataclasses import dataclass

import numpy as np

from report import style
from report.results import arrays
from report.style import plt


@dataclass
class Term:
    label: str
    time: np.ndarray
    energy: np.ndarray  # [J]


@dataclass
class Drawn:
    stored: list  # changes of what is stored
    stacked: list  # losses that never gain
    lines: list  # losses of either sign
    rest: Term  # what all of these do not make up


def drawn(entry):
    """Every term of the budget, each once: their sum is the rest. None for a run that keeps no ledger."""
    ledger = entry.get("ledger", [])
    curves = {term["name"]: arrays(entry, f"energy:{term['name']}") for term in ledger}
    rest = arrays(entry, "energy:open")
    if not ledger or rest is None or any(curve is None for curve in curves.values()):
        return None

    def terms(chosen):
        return [Term(term["label"], *curves[term["name"]]) for term in ledger
                if term["kind"] not in ("part", "residual") and chosen(term)]

    return Drawn(terms(lambda term: term["kind"] == "stored"),
                 terms(lambda term: term["kind"] != "stored" and term["never_gains"]),
                 terms(lambda term: term["kind"] != "stored" and not term["never_gains"]),
                 Term(next(term["label"] for term in ledger if term["kind"] == "residual"), *rest))


def energy_plot(results, run, directory):
    """Left: what is stored, as changes. Right: where it went, losses stacked, what may have either sign as lines."""
    entry = results.curves[run]
    shown = drawn(entry)
    if shown is None or not any(np.abs(term.energy).max() > 0 for term in shown.stored + shown.stacked + shown.lines):
        return []
    unit = entry["scene"]["time_unit"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 4.6), sharex=True)
    for term, colour, line in zip(shown.stored, style.CYCLE, style.LINES):
        left.plot(term.time / unit, 1e3 * term.energy, color=colour, linestyle=line, label=term.label)
    left.set_ylabel("change of stored energy [mJ]")
    style.legend(left, columns=2)
    colours = plt.get_cmap("tab20").colors
    used = [term for term in shown.stacked if np.abs(term.energy).max() > 0]
    if used:
        right.stackplot(used[0].time / unit, [1e3 * term.energy for term in used], colors=colours,
                        labels=[term.label for term in used], alpha=0.8, linewidth=0)
    either = [term for term in shown.lines if np.abs(term.energy).max() > 0]
    for index, term in enumerate(either):
        right.plot(term.time / unit, 1e3 * term.energy, color=colours[(len(used) + index) % len(colours)],
                   linestyle=style.LINES[index % len(style.LINES)], linewidth=1.1, label=term.label)
    right.plot(shown.rest.time / unit, 1e3 * shown.rest.energy, color=style.BLACK, linewidth=1.1, label=shown.rest.label)
    right.set_ylabel("energy lost (negative: made) [mJ]")
    style.legend(right, columns=2, size=5.5)
    for axis in (left, right):
        axis.set_xlabel("T [-]" if unit != 1.0 else "t [s]")
        axis.axhline(0, color="0.6", linewidth=0.6)
    figure.suptitle(run, x=0.01, horizontalalignment="left", fontsize=9)
    style.stamp(figure, results.facts(run))
    return [style.save(figure, directory, f"energy-{run}", pdf=False)]


def caption(run):
    return (f"{run}: energy budget. Left: changes of what is stored. Right: losses since the start, stacked, with the terms of "
            "either sign as lines; “not accounted for” is what all the others, each measured by itself, do not make up. The "
            "transport of grains makes energy in stable layers (upwind fluxes spread them upwards), in proportion to the "
            "cell size.")
