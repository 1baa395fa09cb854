"""The plots, in the form of the paper's figures. Every curve comes computed from granvof-compare; nothing here
defines a metric. Each function gives back the names of the plots it wrote, none if it has nothing to show."""

import numpy as np

from report import style
from report.results import arrays, snapshots
from report.style import plt

FRONT_CHANGES = 8.0  # T at which run_out changes from the dense to the dilute front (compare/metrics/run_out.hpp)
RATIOS = ["r02", "r04", "r06", "r08"]


def snapshot_plot(results, run, directory):
    """Fig. 3: solid fraction and colour of the grains at the output times, black line where alpha = 0.5."""
    entry = results.curves[run]
    scene = entry["scene"]
    shots = [shot for shot in snapshots(entry)]
    if not shots:
        return []
    if len(shots) > 8:
        shots = [shots[i] for i in np.unique(np.linspace(0, len(shots) - 1, 8).round().astype(int))]
    width, height = 1e3 * scene["tank"][0], 1e3 * scene["tank"][1]
    coloured = any(has_colours(f_s, phi) for _, f_s, _, phi in shots)
    tall = height > 1.5 * width
    stretched = height > 5 * width  # a column: drawn wider than it is
    columns = 2 if coloured else 1
    if tall:
        figure, axes = plt.subplots(columns, len(shots), figsize=(1.1 * len(shots) + 1.2, 3.2 * columns), squeeze=False,
                                    sharex=True, sharey=True)
        axes = axes.T
    else:
        figure, axes = plt.subplots(len(shots), columns, squeeze=False, sharex=True, sharey=True,
                                    figsize=(3.6 * columns + 0.8, (3.4 * height / width + 0.28) * len(shots) + 0.9))
    for (time, f_s, alpha, phi), pair in zip(shots, axes):
        images = draw_snapshot(pair, f_s, alpha, phi if coloured else None, width, height)
        scaled = scene["time_unit"] != 1.0
        time = abs(time)  # the first instant may be -0
        pair[0].set_title(f"T = {time / scene['time_unit']:.3g}" if scaled else f"t = {time:.3g} s", loc="left",
                          fontsize=8)
        for axis in pair:
            axis.set_aspect("auto" if stretched else "equal")
    for image, column, label in zip(images, range(columns), ("solid fraction $f_s$ [-]", "colour $\\phi$ [-]")):
        figure.colorbar(image, ax=axes[:, column], label=label, shrink=0.8, location="right" if tall else "bottom",
                        aspect=30, pad=0.01)
    figure.supylabel("y [mm]", fontsize=9)
    last = axes[-1] if not tall else axes[:, -1]
    for axis in last:
        axis.set_xlabel("x [mm]")
    style.stamp(figure, results.facts(run))
    return [style.save(figure, directory, f"snapshots-{run}")]


def has_colours(f_s, phi):
    """Whether the grains carry more than one colour."""
    if phi is None or not (f_s > 0.05).any():
        return False
    shown = phi[f_s > 0.05]
    return shown.max() - shown.min() > 0.05


def draw_snapshot(axes, f_s, alpha, phi, width, height):
    extent = (0, width, 0, height)
    rows, columns = f_s.shape
    images = [axes[0].imshow(f_s, origin="lower", extent=extent, vmin=0, vmax=0.63, cmap="YlOrBr")]
    if phi is not None:
        shown = np.ma.masked_where(f_s < 0.05, phi)
        images.append(axes[1].imshow(shown, origin="lower", extent=extent, vmin=0, vmax=1, cmap="cividis"))
    for axis in axes:
        axis.grid(False)
        if min(rows, columns) > 1 and alpha.min() < 0.5 < alpha.max():
            axis.contour((np.arange(columns) + 0.5) * width / columns, (np.arange(rows) + 0.5) * height / rows, alpha,
                         levels=[0.5], colors="black", linewidths=1.0)
    return images


def draw_records(axis, results, name, curve, label):
    """The recorded DEM-VOF variants: their mean as a line, their spread as a band."""
    variants = [found for entry in results.records.get(name, {}).values() if (found := arrays(entry, curve))]
    if not variants:
        return
    end = min(x[-1] for x, _ in variants)
    common = np.linspace(0.0, end, 400)
    stack = np.array([np.interp(common, x, y) for x, y in variants])
    axis.plot(common, stack.mean(axis=0), color=style.DEM, linewidth=1.2, label=f"DEM-VOF, {label}")
    axis.fill_between(common, stack.min(axis=0), stack.max(axis=0), color=style.DEM, alpha=0.25, linewidth=0)


def run_out_plot(results, directory):
    """Fig. 4: run-out against time, S1 and S2."""
    shown = [run for run in ("s1", "s2") if results.curve(run, "run_out")]
    if not shown:
        return []
    figure, axis = plt.subplots(figsize=(5.6, 4.0))
    for run, line, marker in zip(shown, style.LINES, style.MARKERS):
        T, run_out = with_gap(*results.curve(run, "run_out"), FRONT_CHANGES)
        axis.plot(T, run_out, linestyle=line, marker=marker, markevery=max(len(T) // 12, 1), markersize=4,
                  label=f"continuum, {run.upper()}")
        draw_records(axis, results, run, "run_out", run.upper())
    axis.axvline(FRONT_CHANGES, color="0.7", linewidth=0.8)
    axis.text(FRONT_CHANGES, axis.get_ylim()[0], "front: $f_s = 0.95 f_{s,min}$ | $f_s = 0.30$", fontsize=6.5, color="0.4", ha="center",
              va="bottom")
    axis.set_xlabel(r"$T = t / \sqrt{h_0 / g}$ [-]")
    axis.set_ylabel(r"run-out $(l - l_0) / h_0$ [-]")
    axis.set_xlim(left=0)
    axis.legend()
    style.stamp(figure, results.facts(*shown))
    return [style.save(figure, directory, "run-out")]


def with_gap(x, y, at):
    """The curve with a break at `at`, where its definition changes."""
    index = np.searchsorted(x, at * (1 + 1e-9), side="right")
    if 0 < index < len(x):
        return np.insert(x, index, at), np.insert(y, index, np.nan)
    return x, y


def base_pressure_plot(results, directory):
    """Fig. 5: excess pore pressure at the base, loose against dense."""
    shown = [run for run in ("s1-loose", "s1-dense") if results.curve(run, "excess_base_pressure")]
    if not shown:
        return []
    figure, axes = plt.subplots(len(shown), 1, figsize=(5.6, 2.6 * len(shown)), sharex=True, squeeze=False)
    for run, axis, colour in zip(shown, axes[:, 0], style.CYCLE):
        t, pressure = results.curve(run, "excess_base_pressure")
        packing = results.curves[run]["scene"]["bed"]["solid_fraction"]
        axis.plot(t, pressure, color=colour, label=f"continuum, initial packing {packing:g}")
        draw_records(axis, results, run, "excess_base_pressure", f"{packing:g}")
        axis.axhline(0, color="0.6", linewidth=0.8)
        axis.set_ylabel("excess pressure [Pa]")
        axis.legend()
    axes[-1, 0].set_xlabel("t [s]")
    style.stamp(figure, results.facts(*shown))
    return [style.save(figure, directory, "base-pressure")]


def floating_run_out_plot(results, directory):
    """Fig. 8: run-out of floating grains against time, with the fit l = a t^b."""
    shown = [run for run in ("sw", "fw", "sw-2d", "fw-2d") if results.curve(run, "front_dense")]
    if not shown:
        return []
    figure, axis = plt.subplots(figsize=(5.6, 4.0))
    for run, colour, marker in zip(shown, style.CYCLE, style.MARKERS):
        t, front = results.curve(run, "front_dense")
        axis.plot(t, front, color=colour, marker=marker, markevery=max(len(t) // 12, 1), markersize=4,
                  label=f"continuum, {run.upper()}")
        fit = results.curves[run].get("power_law")
        if fit:
            begin = t[t >= fit["begin"]]
            axis.plot(begin, fit["factor"] * begin ** fit["exponent"], color=colour, linestyle="--", linewidth=1.0,
                      label=f"$l = {fit['factor']:.3f}\\, t^{{{fit['exponent']:.3f}}}$")
    axis.set_xlabel("t [s]")
    axis.set_ylabel("run-out $l$ [m]")
    axis.legend()
    style.stamp(figure, results.facts(*shown))
    return [style.save(figure, directory, "floating-run-out")]


def centre_plot(results, directory):
    """Fig. 11: height of the bed's centre about its late mean, four density ratios."""
    groups = [("float-full-{}", "bed across the tank, with drag"), ("float-full-{}-nodrag", "bed across the tank, without drag"),
              ("float-free-{}", "free bed")]
    groups = [(pattern, title, [run for ratio in RATIOS if results.curve(run := pattern.format(ratio), "y_c_deviation")])
              for pattern, title in groups]
    groups = [group for group in groups if group[2]]
    if not groups:
        return []
    figure, axes = plt.subplots(len(groups), 1, figsize=(6.4, 2.6 * len(groups)), sharex=True, squeeze=False)
    for (_, title, runs), axis in zip(groups, axes[:, 0]):
        for run in runs:
            ratio = results.curves[run]["scene"]["density_ratio"]
            colour, line = style_of_ratio(run)
            t, deviation = results.curve(run, "y_c_deviation")
            smooth = results.curve(run, "y_solid_mean_deviation")
            if smooth:  # eq (27) moves in steps, as rows of cells pass its threshold
                axis.plot(t, 1e3 * deviation, color=colour, linewidth=0.5, alpha=0.4)
                t, deviation = smooth
            axis.plot(t, 1e3 * deviation, color=colour, linestyle=line, linewidth=1.1, label=f"{ratio:.1f}")
        axis.set_title(title, loc="left", fontsize=9)
        axis.set_ylabel(r"$y_c - \bar{y}_c$ [mm]")
        axis.legend(title=r"$\rho_s / \rho_l$", ncol=4, loc="upper right", title_fontsize=8)
    axes[-1, 0].set_xlabel("t [s]")
    style.stamp(figure, results.facts(*(run for group in groups for run in group[2])))
    return [style.save(figure, directory, "centre-height")]


def style_of_ratio(run):
    index = next(i for i, ratio in enumerate(RATIOS) if ratio in run)
    return style.CYCLE[index], style.LINES[index]


def floating_plot(results, directory):
    """Fig. 12: immersed share against density ratio, and computed against expected period."""
    shares = rows_with_values(results, "immersed_share")
    periods = rows_with_values(results, "period")
    if not shares and not periods:
        return []
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.4, 3.7))
    left.plot([0, 1], [0, 1], label=r"$h/H = \rho_s/\rho_l$", **style.THEORY)
    for row in shares:
        left.plot(row["reference"], row["value"], linestyle="none", color=style.BLUE, marker="o",
                  label=label_once(left, "continuum, bed across the tank"))
    left.set_xlabel(r"density ratio $\rho_s / \rho_l$ [-]")
    left.set_ylabel(r"immersed share $h / H$ [-]")
    left.legend()
    if periods:
        top = 1.15 * max(max(row["value"], row["reference"]) for row in periods)
        right.plot([0, top], [0, top], label="$T_c = T_e$", **style.THEORY)
        for row in periods:
            right.plot(row["reference"], row["value"], linestyle="none", color=style.ORANGE, marker="s",
                       label=label_once(right, "continuum, without drag"))
        right.legend()
    else:
        right.text(0.5, 0.5, "not run", transform=right.transAxes, ha="center", color="0.5")
    right.set_xlabel(r"theory $T_e = 2\pi\sqrt{\rho_s H / (\rho_l g)}$ [s]")
    right.set_ylabel("computed period $T_c$ [s]")
    style.stamp(figure, results.facts(*(row["scene"] for row in shares + periods)))
    return [style.save(figure, directory, "floating-theory")]


def rows_with_values(results, metric):
    return [row for row in results.rows if row["metric"] == metric and row["value"] is not None and row["reference"]]


def label_once(axis, label):
    return None if label in axis.get_legend_handles_labels()[1] else label


# Plot name -> what it shows; the page prints these beneath the plots.
CAPTIONS = {
    "run-out": "Run-out of the submerged collapses against time (paper, Fig. 4).",
    "base-pressure": "Excess pore pressure at the base of the column at the onset (paper, Fig. 5).",
    "floating-run-out": "Run-out of floating grains and the fit l = a t^b (paper, Fig. 8).",
    "centre-height": "Height of the bed's centre about its mean over the last half of the run (paper, Fig. 11): all solids; thin: "
                     "the cells with f_s > 0.95 f_s,min, eq (27).",
    "floating-theory": "Immersed share and period against theory (paper, Fig. 12).",
}


def caption(name):
    if name.startswith("snapshots-"):
        return f"{name.removeprefix('snapshots-')}: solid fraction and colour of the grains; black line: alpha = 0.5 (paper, Fig. 3)."
    return CAPTIONS[name]


def draw_all(results, directory):
    """All plots that the results allow, as names in the order of the page."""
    names = []
    for plot in (run_out_plot, base_pressure_plot, floating_run_out_plot, centre_plot, floating_plot):
        names += plot(results, directory)
    for run in results.curves:
        names += snapshot_plot(results, run, directory)
    return names
