"""Where the energy of a run goes: one plot a run, from the budget that granvof-compare reads off its series."""

import numpy as np

from report import style
from report.results import arrays
from report.style import plt

LOSSES = [("friction", "contact friction", style.BLUE), ("drag", "drag", style.ORANGE),
          ("collisions", "collisions", style.GREEN), ("viscosity", "fluid viscosity, LES", style.SKY),
          ("numerical_momentum", "numerics: momentum transport", style.PURPLE),
          ("numerical_time", "numerics: implicit steps", style.YELLOW)]
LINES = [("numerical_volume", "numerics: volume transport", style.RED, "--"),
         ("numerical_granular", "numerics: stress against $\\Theta$", style.BLACK, ":"),
         ("dilatancy", "work of $P_s^{EF}$", style.GREEN, "-."),
         ("open", "not accounted for", style.BLACK, "-")]


def energy_plot(results, run, directory):
    """Left: what is stored, as changes. Right: where it went, losses stacked, what may have either sign as lines."""
    curves = {name.removeprefix("energy:"): arrays(results.curves[run], name)
              for name in results.curves[run]["curves"] if name.startswith("energy:")}
    if "open" not in curves or not any(np.abs(y).max() > 0 for _, y in curves.values()):
        return []
    unit = results.curves[run]["scene"]["time_unit"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 4.4), sharex=True)
    for (name, label), colour, line in zip([("potential", "potential, all phases"), ("kinetic", "kinetic, both phases"),
                                            ("granular", "granular"), ("elastic", "elastic, contacts")],
                                           style.CYCLE, style.LINES):
        t, y = curves[name]
        left.plot(t / unit, 1e3 * y, color=colour, linestyle=line, label=label)
    left.set_ylabel("change of stored energy [mJ]")
    style.legend(left, columns=2)
    t = curves["open"][0]
    stacked = [np.maximum(1e3 * curves[name][1], 0.0) for name, _, _ in LOSSES]
    right.stackplot(t / unit, stacked, colors=[colour for _, _, colour in LOSSES], labels=[label for _, label, _ in LOSSES],
                    alpha=0.8, linewidth=0)
    for name, label, colour, line in LINES:
        right.plot(t / unit, 1e3 * curves[name][1], color=colour, linestyle=line, linewidth=1.1, label=label)
    right.set_ylabel("energy lost (negative: made) [mJ]")
    style.legend(right, columns=2, size=6.5)
    for axis in (left, right):
        axis.set_xlabel("T [-]" if unit != 1.0 else "t [s]")
        axis.axhline(0, color="0.6", linewidth=0.6)
    figure.suptitle(run, x=0.01, horizontalalignment="left", fontsize=9)
    style.stamp(figure, results.facts(run))
    return [style.save(figure, directory, f"energy-{run}", pdf=False)]


def caption(run):
    return (f"{run}: energy budget. Left: changes of what is stored. Right: losses since the start, stacked, with the terms of "
            "either sign as lines; “not accounted for” is the residual of the solvers. Volume "
            "transport makes energy in stable layers (upwind fluxes spread grains upwards), in proportion to the cell size.")
