"""Figures of single parts of the model against published series."""

from report import style
from report.drawing import draw_peers, draw_published, draw_run, finish, runs_with
from report.style import plt


def dam_break_plot(results, directory):
    """Front of a water column without grains against Martin & Moyce."""
    if not runs_with(results, ["dam-break"], "scaled_liquid_front"):
        return []
    figure, axis = plt.subplots(figsize=(5.6, 3.8))
    draw_run(axis, results, "dam-break", "scaled_liquid_front", style.BLUE, "continuum")
    draw_peers(axis, results, "dam-break", "scaled_liquid_front")
    draw_published(axis, results, "martin_moyce_1952.tsv", "delta", style.BLACK, "Martin & Moyce (1952)")
    return finish(figure, axis, r"$\tau = t \sqrt{2 g / a}$ [-]", r"front $\delta = x / a$ [-]", results, ["dam-break"], directory,
                  "dam-break")


def sloshing_plot(results, directory):
    """Level at the wall of a tank of water without grains, beside stock programs."""
    if not runs_with(results, ["sloshing"], "liquid_height_left"):
        return []
    figure, axis = plt.subplots(figsize=(5.6, 3.8))
    draw_run(axis, results, "sloshing", "liquid_height_left", style.BLUE, "continuum", scale=1e3)
    draw_peers(axis, results, "sloshing", "liquid_height_left", scale=1e3)
    return finish(figure, axis, "t [s]", "level at x = 0 [mm]", results, ["sloshing"], directory, "sloshing")


def sedimentation_plot(results, directory):
    """Fronts of a settling suspension against Pham Van Bang et al."""
    if not runs_with(results, ["sedimentation"], "solid_level_0.25"):
        return []
    figure, axis = plt.subplots(figsize=(5.6, 3.8))
    for level, column, colour in ((0.25, "upper_front", style.BLUE), (0.55, "packed_front", style.ORANGE)):
        draw_run(axis, results, "sedimentation", f"solid_level_{level:g}", colour, f"continuum, $f_s = {level:g}$", scale=1e3)
        draw_published(axis, results, "pham_van_bang_fronts.tsv", column, colour,
                       f"Pham Van Bang et al., {column.replace('_', ' ')}", scale=1e3)
    return finish(figure, axis, "t [s]", "height above the bottom [mm]", results, ["sedimentation"], directory, "sedimentation")
