"""The energy of a run beside that of the beads: the same terms of both codes, from the series that each wrote.

    python3 compare/report/ledgers.py --at T,T,... DIR DIR ...           a table, one column a run or record
    python3 compare/report/ledgers.py --shares --at T,T,... DIR DIR ...  what each term takes of what is released between them

The terms are those in which both count alike. What the continuum calls friction and collisions, and the work of its contact
pressures, are for the beads one loss between grains, rough floor included; what planes and the gate's plate take is net of
what moves them; agitation is Theta there and the beads' motion about the cell's mean here, spin included.
"""

import argparse
import csv
import sys
from pathlib import Path

import numpy as np

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).resolve().parent.parent), str(Path(__file__).resolve().parent.parent.parent / "solver/python")]
from granvof_files import opened  # noqa: E402
from report import style  # noqa: E402
from report.results import OF_READING, Damaged  # noqa: E402
from report.style import plt  # noqa: E402

# As compare/input/shared_ledger.cpp has them. Term -> label, columns that add to it, columns that are taken from it. A name that ends in * stands for all that begin so.
TERMS = {
    "released": ("potential energy released", (), ("energy_potential",)),
    "motion": ("kinetic, mean motion", ("energy_kinetic",), ()),
    "agitation": ("agitation of the grains", ("energy_granular", "energy_spin"), ()),
    "elastic": ("elastic, contacts", ("energy_elastic",), ()),
    "contacts": ("lost between grains", ("lost_friction", "lost_collisions", "lost_contacts"),
                 ("gained_dilatancy", "gained_shear_dilatancy")),
    "walls": ("lost at walls and plate, net", ("lost_walls",), ("gained_walls", "gained_gate")),
    "drag": ("lost to drag", ("lost_drag",), ()),
    "viscosity": ("lost to the fluid's viscosity", ("lost_viscosity",), ()),
    "numerics": ("lost to numerics", ("lost_numerical_*",), ()),
    "open": ("not accounted for", ("energy_residual",), ()),
}


def read_ledger(directory):
    """Time [s] and, for each of TERMS, its change since the first row [J]; None where the series has no energy budget."""
    path = Path(directory) / "series.csv"
    try:
        with opened(path, newline="", encoding="utf-8") as file:
            header, *rows = csv.reader(file)
        columns = {name.split(" [")[0]: index for index, name in enumerate(header)}
        if "lost_drag" not in columns:
            return None
        values = np.array([[float(value or "nan") for value in row] for row in rows])
    except OF_READING as error:
        raise Damaged(path, error) from error

    def total(names):
        found = [column for name in names for column in columns
                 if column == name or (name.endswith("*") and column.startswith(name[:-1]))]
        return sum((values[:, columns[column]] for column in found), np.zeros(len(rows)))

    changes = {}
    for term, (_, plus, minus) in TERMS.items():
        curve = total(plus) - total(minus)
        changes[term] = curve - curve[0]
    return values[:, columns["time"]], changes


def ledgers_of(results, run):
    """Ours and those of the recorded seeds of the run's scene; nothing unless both are there."""
    scene = results.record_of(run)
    ours = read_ledger(results.curves[run]["directory"])
    beads = [found for entry in results.records.get(scene, {}).values() if (found := read_ledger(entry["directory"]))]
    return (ours, beads) if ours and beads else None


def ledger_plot(results, run, directory):
    """Left: released and stored. Right: where it went. Ours as lines, DEM-VOF dashed in the same colours."""
    if not (Path(results.curves[run]["directory"]) / "series.csv").exists():
        return []
    found = ledgers_of(results, run)
    if not found:
        return []
    unit = results.curves[run]["scene"]["time_unit"]
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 3.8), sharex=True)
    sides = (("released", "motion", "agitation", "elastic"), ("contacts", "walls", "drag", "viscosity", "numerics", "open"))
    for axis, terms in zip(axes, sides):
        for term, colour in zip(terms, style.CYCLE):
            (t, ours), beads = found
            axis.plot(t / unit, 1e3 * ours[term], color=colour, label=TERMS[term][0])
            for seed, (time, changes) in enumerate(beads):
                axis.plot(time / unit, 1e3 * changes[term], color=colour, linestyle="--", linewidth=1.1,
                          label="DEM-VOF, dashed" if axis is axes[1] and term == terms[0] and seed == 0 else None)
        axis.set_xlabel("T [-]" if unit != 1.0 else "t [s]")
        axis.axhline(0, color="0.6", linewidth=0.6)
        style.legend(axis, 2)
    axes[0].set_ylabel("energy [mJ]")
    style.stamp(figure, results.facts(run))
    return [style.save(figure, directory, f"ledger-{run}", pdf=False)]


def caption(run):
    return (f"{run}: the energy of the run (lines) and of DEM-VOF (dashed), in the terms that both count alike. Left: potential "
            "energy released, and what of it is in motion. Right: where it went.")


def ledgers_in(directories):
    read = {}
    for directory in directories:
        ledger = read_ledger(directory)
        if ledger is None:
            raise Damaged(Path(directory) / "series.csv", ValueError("it has no energy budget"))
        read[directory] = ledger
    return read


def table(directories, times):
    """Rows of text: a term a row, at each time the value of each directory [mJ]."""
    read, lines = ledgers_in(directories), []
    for time in times:
        lines.append(f"t = {time:g} s")
        for term, (label, _, _) in TERMS.items():
            cells = [1e3 * np.interp(time, t, changes[term]) for t, changes in read.values()]
            lines.append(f"  {label:32}" + "".join(f"{cell:12.3f}" for cell in cells))
    return lines


def shares(directories, times):
    """Rows of text: a term a row, between each two times what it takes of the potential energy released there [%]."""
    read, lines = ledgers_in(directories), []
    for begin, end in zip(times, times[1:]):
        lines.append(f"t = {begin:g} to {end:g} s")
        for term, (label, _, _) in TERMS.items():
            gained = [(changes[term], changes["released"], t) for t, changes in read.values()]
            cells = [100 * (np.interp(end, t, curve) - np.interp(begin, t, curve)) / (np.interp(end, t, released) - np.interp(begin, t, released))
                     for curve, released, t in gained]
            lines.append(f"  {label:32}" + "".join(f"{cell:12.1f}" for cell in cells))
    return lines


def main(arguments):
    parser = argparse.ArgumentParser(description="The energy of runs and records beside each other, in mJ.")
    parser.add_argument("--shares", action="store_true", help="in %% of the potential energy released between each two of the times")
    parser.add_argument("--at", metavar="T,T,...", required=True, help="times since the release [s]")
    parser.add_argument("directories", nargs="+", metavar="DIR", help="a run, or a record of reference/results")
    options = parser.parse_args(arguments)
    try:
        shown = shares if options.shares else table
        print("\n".join(shown(options.directories, [float(word) for word in options.at.split(",")])))
    except ValueError as error:
        print(f"ledgers: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
