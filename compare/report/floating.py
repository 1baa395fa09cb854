"""Figures of the floating bed: motion of its centre, immersed share, period."""

from report import style
from report.drawing import draw_records, runs_with
from report.style import plt

RATIOS = ["r02", "r04", "r06", "r08"]
GROUPS = [("float-full-{}", "bed across the tank, with drag"), ("float-full-{}-nodrag", "bed across the tank, without drag"),
          ("float-free-{}", "free bed")]


def centre_plot(results, directory):
    """Fig. 11: height of the bed's centre about its late mean, four density ratios."""
    groups = [(title, runs_with(results, [pattern.format(ratio) for ratio in RATIOS], "y_c_deviation"))
              for pattern, title in GROUPS]
    groups = [group for group in groups if group[1]]
    if not groups:
        return []
    figure, axes = plt.subplots(len(groups), 1, figsize=(6.4, 2.6 * len(groups)), sharex=True, squeeze=False)
    for (title, runs), axis in zip(groups, axes[:, 0]):
        for run in runs:
            draw_centre(axis, results, run)
        axis.set_title(title, loc="left", fontsize=9)
        axis.set_ylabel(r"$y_c - \bar{y}_c$ [mm]")
        axis.legend(title=r"$\rho_s / \rho_l$", ncol=4, loc="upper right", title_fontsize=8)
    axes[-1, 0].set_xlabel("t [s]")
    style.stamp(figure, results.facts(*(run for _, runs in groups for run in runs)))
    return [style.save(figure, directory, "centre-height")]


def draw_centre(axis, results, run):
    index = next(i for i, ratio in enumerate(RATIOS) if ratio in run)
    colour, ratio = style.CYCLE[index], f"0.{RATIOS[index][-1]}"
    cells, smooth = results.curve(run, "y_c_deviation"), results.curve(run, "y_solid_mean_deviation")
    if cells and smooth:  # eq (27) moves in steps, as rows of cells pass its threshold
        axis.plot(cells[0], 1e3 * cells[1], color=colour, linewidth=0.5, alpha=0.4)
    if smooth or cells:
        t, deviation = smooth or cells
        axis.plot(t, 1e3 * deviation, color=colour, linewidth=1.1, label=ratio)
    draw_records(axis, results, run, "y_solid_mean_deviation", colour, "", scale=1e3)


def floating_plot(results, directory):
    """Fig. 12: immersed share against density ratio, and computed against expected period."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.4, 3.7))
    drawn = draw_shares(left, results) + draw_periods(right, results)
    if not drawn:
        plt.close(figure)
        return []
    style.stamp(figure, results.facts(*drawn))
    return [style.save(figure, directory, "floating-theory")]


def draw_shares(axis, results):
    """h/H against the density ratio; gives back the runs shown."""
    axis.plot([0, 1], [0, 1], label=r"$h/H = \rho_s/\rho_l$", **style.THEORY)
    shown = []
    for metric, colour, marker, label in (("immersed_share", style.BLUE, "o", "continuum, bed across the tank"),
                                          ("immersed_share_free", style.GREEN, "^", "continuum, free bed")):
        rows = rows_of(results, metric, "theory")
        axis.plot([row["reference"] for row in rows], [row["value"] for row in rows], linestyle="none", color=colour,
                  marker=marker, label=label if rows else None)
        shown += [row["scene"] for row in rows]
    recorded = rows_of(results, "immersed_share", "DEM")
    ratios = [results.curves[row["scene"]]["scene"]["density_ratio"] for row in recorded]
    draw_dem(axis, ratios, recorded)
    axis.set_xlabel(r"density ratio $\rho_s / \rho_l$ [-]")
    axis.set_ylabel(r"immersed share $h / H$ [-]")
    style.legend(axis)
    return shown


def draw_periods(axis, results):
    """T_c against T_e; gives back the runs shown."""
    rows = rows_of(results, "period", "theory")
    axis.set_xlabel(r"theory $T_e = 2\pi\sqrt{\rho_s H / (\rho_l g)}$ [s]")
    axis.set_ylabel("computed period $T_c$ [s]")
    if not rows:
        axis.text(0.5, 0.5, "not run", transform=axis.transAxes, ha="center", color="0.5")
        return []
    top = 1.15 * max(max(row["value"], row["reference"]) for row in rows)
    axis.plot([0, top], [0, top], label="$T_c = T_e$", **style.THEORY)
    for free, colour, marker, label in ((False, style.ORANGE, "s", "continuum, without drag"),
                                        (True, style.GREEN, "^", "continuum, free bed")):
        kind = [row for row in rows if ("free" in row["scene"]) == free]
        axis.plot([row["reference"] for row in kind], [row["value"] for row in kind], linestyle="none", color=colour,
                  marker=marker, label=label if kind else None)
    theory = {row["scene"]: row["reference"] for row in rows}
    recorded = [row for row in rows_of(results, "period", "DEM") if row["scene"] in theory]
    draw_dem(axis, [theory[row["scene"]] for row in recorded], recorded)
    style.legend(axis)
    return [row["scene"] for row in rows]


def draw_dem(axis, x, rows):
    """What the records have, with their band as an error bar."""
    if rows:
        axis.errorbar(x, [row["reference"] for row in rows], yerr=[row["band"] for row in rows], linestyle="none", marker="x",
                      color=style.DEM, capsize=2, label="DEM-VOF" if any(row["band"] for row in rows) else "DEM-VOF (no band)")


def rows_of(results, metric, kind):
    return [row for row in results.rows if row["metric"].split("@")[0] == metric and row["reference_kind"] == kind
            and row["value"] is not None and row["reference"] is not None]
