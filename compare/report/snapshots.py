"""Fig. 3 of the paper: the fields at the output times, ours beside those of the DEM-VOF record where there is one."""

import numpy as np

from report import style
from report.results import instants, snapshots
from report.style import plt

MOST_SHOTS = 8
LEAST_COMMON = 2  # instants that a record must share with a run; then these alone are shown
EMPTY = 0.05  # solid fraction below which a cell shows no colour


def snapshot_plot(results, run, directory):
    """Solid fraction, colour of the grains and the record's solid fraction; black line where alpha = 0.5."""
    entry = results.curves[run]
    scene = entry["scene"]
    shots = list(snapshots(entry))
    if not shots:
        return []
    variant, recorded = recorded_shots(results, results.record_of(run), [shot[0] for shot in shots], scene)
    if sum(shot is not None for shot in recorded) >= LEAST_COMMON:
        shots, recorded = zip(*[pair for pair in zip(shots, recorded) if pair[1]])
    else:
        variant = None
    if len(shots) > MOST_SHOTS:
        kept = evenly(0, len(shots), MOST_SHOTS)
        shots, recorded = [shots[i] for i in kept], [recorded[i] for i in kept if recorded]
    columns = [("solid fraction $f_s$ [-]", solid_image, shots)]
    if any(has_colours(f_s, phi) for _, f_s, _, phi in shots):
        columns.append(("colour $\\phi$ [-]", colour_image, shots))
    if variant:
        columns.append((f"DEM-VOF ({variant}), $f_s$ [-]", solid_image, recorded))
    draw(columns, shots, scene, results.facts(run), directory / f"snapshots-{run}")
    return [f"snapshots-{run}"]


def plan_plot(results, run, directory):
    """A 3D scene from above: how deep the solid lies, of grains without pores, at the output times."""
    entry = results.curves[run]
    scene = entry["scene"]
    if scene["dimensions"] != 3:
        return []
    shots = [(time, fields[0].sum(axis=1) * 1e3 * scene["spacing"][1]) for time, fields in instants(entry)]
    if not shots:
        return []
    shots = [shots[i] for i in evenly(0, len(shots), MOST_SHOTS)]
    length, depth = 1e3 * scene["tank"][0], 1e3 * scene["tank"][2]
    figure, axes = plt.subplots(len(shots), 1, squeeze=False, sharex=True, sharey=True,
                                figsize=(4.4, (3.4 * depth / length + 0.28) * len(shots) + 0.9))
    deepest = max(solid.max() for _, solid in shots)
    for axis, (time, solid) in zip(axes[:, 0], shots):
        drawn = axis.imshow(solid, origin="lower", extent=(0, length, 0, depth), vmin=0, vmax=deepest, cmap="YlOrBr")
        axis.set_title(label_of_time(time, scene), loc="left", fontsize=8)
        axis.grid(False)
    axes[-1, 0].set_xlabel("x [mm]")
    figure.supylabel("z [mm]", fontsize=9)
    figure.colorbar(drawn, ax=axes[:, 0], label="depth of solid [mm]", location="bottom", shrink=0.8, aspect=30, pad=0.01)
    style.stamp(figure, results.facts(run))
    return [style.save(figure, directory, f"plan-{run}", pdf=False)]


def record_of(results, case):
    """(name, entry) of the first record of a case that has fields; (None, None) where there is none."""
    return next(((variant, entry) for variant, entry in sorted(results.records.get(case, {}).items()) if any(instants(entry))), (None, None))


def recorded_shots(results, case, times, scene):
    """Name of the first variant of a case with fields, and its instants at `times`, None where it has none."""
    for variant, entry in sorted(results.records.get(case, {}).items()):
        found = list(snapshots(entry))
        near = [next((shot for shot in found if abs(shot[0] - time) < 0.02 * scene["time_unit"]), None) for time in times]
        if any(near):
            return variant, near
    return None, []


def draw(columns, shots, scene, facts, path):
    width, height = 1e3 * scene["tank"][0], 1e3 * scene["tank"][1]
    figure, axes, tall = arranged(len(shots), len(columns), width, height)
    for column, (label, image, given) in enumerate(columns):
        drawn = [draw_shot(axis, image, shot, width, height) for axis, shot in zip(axes[:, column], given)]
        figure.colorbar(drawn[0], ax=axes[:, column], label=label, shrink=0.8, location="right" if tall else "bottom",
                        aspect=30, pad=0.01)
    label_axes(figure, axes, [shot[0] for shot in shots], scene, tall)
    style.stamp(figure, facts)
    style.save(figure, path.parent, path.name, pdf=False)


def arranged(shots, columns, width, height):
    """(figure, axes[shot, column], whether the tank is so tall that its instants stand beside each other)."""
    if height > 1.5 * width:
        figure, axes = plt.subplots(columns, shots, squeeze=False, sharex=True, sharey=True, figsize=(1.1 * shots + 1.2, 3.2 * columns))
        return figure, axes.T, True
    figure, axes = plt.subplots(shots, columns, squeeze=False, sharex=True, sharey=True,
                                figsize=(3.6 * columns + 0.8, (3.4 * height / width + 0.28) * shots + 0.9))
    return figure, axes, False


def label_axes(figure, axes, times, scene, tall):
    """What the axes of arranged() say, and in which proportions a tank is drawn."""
    for axis, time in zip(axes[:, 0], times):
        axis.set_title(label_of_time(time, scene), loc="left", fontsize=8)
    width, height = scene["tank"][:2]
    for axis in axes.flat:
        axis.grid(False)
        axis.set_aspect("auto" if height > 5 * width else "equal")  # a column: drawn wider than it is
    figure.supylabel("y [mm]", fontsize=9)
    for axis in axes[:, -1] if tall else axes[-1]:
        axis.set_xlabel("x [mm]")


def evenly(first, count, most):
    """At most `most` places from `first` to count - 1, both of them, as even as whole numbers are."""
    return np.unique(np.linspace(first, count - 1, most).round().astype(int))


def label_of_time(time, scene):
    time = abs(time)  # the first instant may be -0
    return f"T = {time / scene['time_unit']:.3g}" if scene["time_unit"] != 1.0 else f"t = {time:.3g} s"


def has_colours(f_s, phi):
    """Whether the grains carry more than one colour."""
    if phi is None or not (f_s > EMPTY).any():
        return False
    shown = phi[f_s > EMPTY]
    return shown.max() - shown.min() > 0.05


def solid_image(axis, f_s, _, extent):
    return axis.imshow(f_s, origin="lower", extent=extent, vmin=0, vmax=0.63, cmap="YlOrBr")


def colour_image(axis, f_s, phi, extent):
    return axis.imshow(np.ma.masked_where(f_s < EMPTY, phi), origin="lower", extent=extent, vmin=0, vmax=1, cmap="cividis")


def draw_shot(axis, image, shot, width, height):
    _, f_s, alpha, phi = shot
    rows, columns = f_s.shape
    drawn = image(axis, f_s, phi, (0, width, 0, height))
    if min(rows, columns) > 1 and alpha.min() < 0.5 < alpha.max():
        axis.contour((np.arange(columns) + 0.5) * width / columns, (np.arange(rows) + 0.5) * height / rows, alpha, levels=[0.5],
                     colors="black", linewidths=1.0)
    return drawn
