"""Figures of the collapses: run-out and pore pressure of the submerged ones, run-out of the floating ones."""

from report import style
from report.drawing import draw_peers, draw_published, draw_records, draw_run, finish, runs_with
from report.style import plt


WEIGHT = 100.0  # Pa, about what the submerged weight of these columns makes; logarithmic beyond, where needed


def run_out_plot(results, directory):
    """Fig. 4: run-out against time, S1 and S2: the paper's model, and with the choices that matter under water."""
    shown = runs_with(results, ("s1", "s2"), "run_out")
    if not shown:
        return []
    figure, axis = plt.subplots(figsize=(5.6, 4.0))
    for run, colour in zip(shown, style.CYCLE):
        draw_run(axis, results, run, "run_out", colour, f"continuum, {run.upper()}")
        draw_run(axis, results, f"{run}-sourced", "run_out", colour, f"with all choices, {run.upper()}", linestyle="-.")
        draw_records(axis, results, run, "run_out", colour, run.upper())
        draw_peers(axis, results, run, "run_out")
    axis.set_xlim(left=0)
    return finish(figure, axis, r"$T = t / \sqrt{h_0 / g}$ [-]", r"run-out $(l - l_0) / h_0$, front at $f_s = 0.30$ [-]", results, shown, directory,
                  "run-out")


DRY = {"canary-dry": "preset paper", "canary-dry-frictional": "frictional restitution", "canary-dry-advised": "preset advised"}


def dry_front_plot(results, directory):
    """The collapse in air: the front of nearly all grains, of each set of choices, beside the beads' record."""
    shown = runs_with(results, DRY, "run_out_quantile")
    if not shown:
        return []
    figure, axis = plt.subplots(figsize=(5.6, 4.0))
    for run, colour in zip(shown, style.CYCLE):
        draw_run(axis, results, run, "run_out_quantile", colour, f"continuum, {DRY[run]}")
    draw_records(axis, results, "canary-dry", "run_out_quantile", style.DEM, "")
    axis.set_xlim(left=0)
    return finish(figure, axis, r"$T = t / \sqrt{h_0 / g}$ [-]", r"front of 99.5 % of the grains, $(l - l_0) / h_0$ [-]", results, shown,
                  directory, "dry-front")


def base_pressure_plot(results, directory):
    """Fig. 5: excess pore pressure at the base, loose against dense; apart, as they differ a hundredfold."""
    shown = runs_with(results, ("s1-loose", "s1-dense"), "excess_base_pressure")
    if not shown:
        return []
    figure, axes = plt.subplots(len(shown), 1, figsize=(5.6, 2.6 * len(shown)), sharex=True, squeeze=False)
    for run, axis, colour in zip(shown, axes[:, 0], style.CYCLE):
        kind = run.removeprefix("s1-")
        packing = f", initial packing {results.curves[run]['scene']['bed']['solid_fraction']:g}" if run in results.curves else ""
        draw_run(axis, results, run, "excess_base_pressure", colour, f"continuum, {kind}{packing}")
        draw_records(axis, results, run, "excess_base_pressure", colour, kind)
        axis.axhline(0, color="0.6", linewidth=0.8)
        if max(abs(limit) for limit in axis.get_ylim()) > 100 * WEIGHT:  # a shock beside what the weight of the grains can do
            axis.set_yscale("symlog", linthresh=WEIGHT)
        axis.set_ylabel("excess pressure [Pa]")
        style.legend(axis)
    axes[-1, 0].set_xlabel("t [s]")
    style.stamp(figure, results.facts(*shown))
    return [style.save(figure, directory, "base-pressure")]


def floating_run_out_plot(results, directory):
    """Fig. 8: run-out of floating grains against time, with the fit l = a t^b up to the far wall."""
    shown = runs_with(results, ("sw", "fw", "sw-2d", "fw-2d"), "front_dense")
    if not shown:
        return []
    figure, axis = plt.subplots(figsize=(5.6, 4.0))
    for run, colour in zip(shown, style.CYCLE):
        name = run.upper().replace("-2D", " in 2D")
        draw_run(axis, results, run, "front_dense", colour, f"continuum, {name}")
        draw_records(axis, results, run, "front_dense", colour, name)
        fit = results.curves.get(run, {}).get("power_law")
        if fit:
            t, _ = results.curve(run, "front_dense")
            fitted = t[(t >= fit["begin"]) & (t <= fit["end"])]
            axis.plot(fitted, fit["factor"] * fitted ** fit["exponent"], color=colour, linestyle=":", linewidth=1.0,
                      label=f"$l = {fit['factor']:.3f}\\, t^{{{fit['exponent']:.3f}}}$")
    return finish(figure, axis, "t [s]", "run-out $l$ [m]", results, shown, directory, "floating-run-out")


def viscous_plot(results, directory):
    """Collapse in a viscous liquid against Rondon et al.: front and excess pore pressure, loose and dense."""
    shown = runs_with(results, ("rondon-loose", "rondon-dense"), "front_dense")
    if not shown:
        return []
    figure, axes = plt.subplots(2, 1, figsize=(5.6, 5.6), sharex=True)
    for run, colour in zip(("rondon-loose", "rondon-dense"), style.CYCLE):
        kind = run.removeprefix("rondon-")
        for axis, curve, quantity, scale in ((axes[0], "front_dense", "front", 100.0),
                                             (axes[1], "excess_base_pressure", "pressure", 1.0)):
            draw_run(axis, results, run, curve, colour, f"continuum, {kind}", scale=scale)
            draw_records(axis, results, run, curve, colour, kind, scale=scale)
            column = "front" if quantity == "front" else "excess_pressure"
            draw_published(axis, results, f"rondon2011/{kind}_{quantity}.tsv", column, colour, f"Rondon et al., {kind}",
                           scale=scale)
    axes[1].axhline(0, color="0.6", linewidth=0.8)
    axes[0].set_ylabel("front [cm]")
    axes[1].set_ylabel("excess pressure [Pa]")
    axes[1].set_xlabel("t [s]")
    style.legend(axes[0])
    style.stamp(figure, results.facts(*shown))
    return [style.save(figure, directory, "viscous-collapse")]
