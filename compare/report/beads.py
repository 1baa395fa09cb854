"""Figures of beads that meet water (Sun & Sakai's set-ups): continuum against DEM-VOF."""

from report import style
from report.drawing import draw_records, draw_run, finish, runs_with
from report.style import plt


def water_entry_plot(results, directory):
    """Centre of mass of beads that fall into water, and the level they raise."""
    return curves_plot(results, directory, "water-entry", "height [mm]",
                       (("y_solid_mean", "centre of mass"), ("interface_height", "level")))


def dambreak_beads_plot(results, directory):
    """Fronts of water and beads in a dam break with beads."""
    return curves_plot(results, directory, "dambreak-beads", "front [mm]",
                       (("liquid_front", "water"), ("front_quantile", "99.5 % of the beads")))


def curves_plot(results, directory, scene, ylabel, curves):
    if not any(runs_with(results, [scene], curve) for curve, _ in curves):
        return []
    figure, axis = plt.subplots(figsize=(5.6, 3.8))
    for (curve, text), colour in zip(curves, style.CYCLE):
        draw_run(axis, results, scene, curve, colour, f"continuum, {text}", scale=1e3)
        draw_records(axis, results, scene, curve, colour, text, scale=1e3)
    return finish(figure, axis, "t [s]", ylabel, results, [scene], directory, scene)
