"""What moves and presses: speeds, fluid pressure and granular temperature of a run, at a few instants."""

import numpy as np
from matplotlib.ticker import MaxNLocator

from report import style
from report.results import across, instants
from report.snapshots import EMPTY, arranged, evenly, label_axes

MOST_SHOTS = 4
FIELDS = ("f_s", "alpha", "u_s", "u_c", "p_c", "theta")


def speed(velocity):
    return np.linalg.norm(velocity, axis=-1)


# (label, what is drawn of the fields of an instant, only where there are grains)
COLUMNS = (("speed of the grains [m/s]", lambda at: speed(at["u_s"]), True),
           ("speed of the fluid [m/s]", lambda at: speed(at["u_c"]), False),
           ("fluid pressure [Pa]", lambda at: at["p_c"], False),
           ("granular temperature $\\Theta$ [m$^2$/s$^2$]", lambda at: at["theta"], True))


def state_plot(results, run, directory):
    """A row an instant, a column a quantity, each on one scale for all instants; nothing where a field was not written."""
    entry = results.curves[run]
    scene = entry["scene"]
    shots = [(time, dict(zip(FIELDS, fields))) for time, fields in instants(entry, FIELDS)]
    if not shots or any(field is None for _, fields in shots for field in fields.values()):
        return []
    kept = evenly(min(1, len(shots) - 1), len(shots), MOST_SHOTS)  # at first all is at rest
    shots = [(time, {name: across(field, scene["dimensions"]) for name, field in fields.items()})
             for time, fields in (shots[i] for i in kept)]
    width, height = 1e3 * scene["tank"][0], 1e3 * scene["tank"][1]
    figure, axes, tall = arranged(len(shots), len(COLUMNS), width, height)
    for column, (label, quantity, of_grains) in enumerate(COLUMNS):
        shown = [np.ma.masked_where(fields["f_s"] < EMPTY, quantity(fields)) if of_grains else np.ma.asarray(quantity(fields))
                 for _, fields in shots]
        known = np.concatenate([field.compressed() for field in shown])
        low, high = (known.min(), known.max()) if known.size else (0.0, 1.0)
        low = min(low, 0.0) if label != COLUMNS[2][0] else low
        for axis, field in zip(axes[:, column], shown):
            drawn = axis.imshow(field, origin="lower", extent=(0, width, 0, height), vmin=low, vmax=high, cmap="viridis")
        bar = figure.colorbar(drawn, ax=axes[:, column], label=label, shrink=0.8, location="right" if tall else "bottom", aspect=30, pad=0.01)
        bar.locator = MaxNLocator(nbins=4)
        bar.formatter.set_powerlimits((-2, 4))
        bar.update_ticks()
    label_axes(figure, axes, [time for time, _ in shots], scene, tall)
    style.stamp(figure, results.facts(run))
    return [style.save(figure, directory, f"states-{run}", pdf=False)]


def caption(run):
    return f"{run}: speeds, fluid pressure and granular temperature; where there are hardly any grains, those of the grains are left out."
