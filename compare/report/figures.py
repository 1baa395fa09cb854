"""The plots, in the form of the paper's figures. Every curve comes computed from granvof-compare; nothing here
defines a metric. Each function gives back the names of the plots it wrote, none if it has nothing to show."""

from report import energy, ledgers, stability, states
from report.beads import dambreak_beads_plot, water_entry_plot
from report.collapse import base_pressure_plot, dry_front_plot, floating_run_out_plot, run_out_plot, viscous_plot
from report.floating import centre_plot, floating_plot
from report.parts import dam_break_plot, sedimentation_plot, sloshing_plot
from report.snapshots import plan_plot, snapshot_plot

PLOTS = (run_out_plot, dry_front_plot, base_pressure_plot, floating_run_out_plot, centre_plot, floating_plot, dam_break_plot,
         sloshing_plot, sedimentation_plot, viscous_plot, water_entry_plot, dambreak_beads_plot)

# Plot name -> what it shows; the page prints these beneath the plots.
CAPTIONS = {
    "run-out": "Run-out of the submerged collapses against time (paper, Fig. 4); dash-dotted: with the choices beside the "
               "paper's model (runs s1-sourced, s2-sourced).",
    "dry-front": "Collapse in air (canary-dry): the front that 99.5 % of the grains have not passed, of each set of choices, beside "
                 "DEM-VOF.",
    "base-pressure": "Excess pore pressure at the base of the column at the onset (paper, Fig. 5).",
    "floating-run-out": "Run-out of floating grains and the fit l = a t^b (paper, Fig. 8). The measured a and b are not "
                        "to be had.",
    "centre-height": "Height of the bed's centre about its mean over the last half of the run (paper, Fig. 11): all solids; thin: "
                     "the cells with f_s > 0.95 f_s,min, eq (27).",
    "floating-theory": "Immersed share and period against theory (paper, Fig. 12).",
    "dam-break": "Front of a collapsing water column without grains.",
    "sloshing": "Sloshing without grains from a step of the surface.",
    "sedimentation": "Fronts of a settling suspension, where f_s passes 0.25 and 0.55.",
    "viscous-collapse": "Collapse in a viscous liquid: front and excess pore pressure at the base. The model has no viscous "
                        "dilatancy: its sign is what can be compared, not its time scale.",
    "water-entry": "Beads falling into water: height of their centre of mass, and of the surface they raise.",
    "dambreak-beads": "Dam break with beads: front of the water, and where 99.5 % of the beads have not yet passed.",
}


# Quantity (a metric without its instant) -> the plots that show it, the first that was drawn is linked.
SHOWN_IN = {
    "run_out": ("run-out", "viscous-collapse"), "run_out_dense": ("run-out",), "run_out_quantile": ("run-out", "dry-front"),
    "run_out_distance": ("run-out",), "base_pressure": ("base-pressure",), "base_pressure_peak": ("base-pressure",),
    "base_pressure_sign": ("base-pressure", "viscous-collapse"), "base_pressure_distance": ("viscous-collapse",),
    "grain_front_distance": ("viscous-collapse",), "run_out_exponent": ("floating-run-out",),
    "immersed_share": ("floating-theory",), "immersed_share_cells": ("floating-theory",),
    "immersed_share_free": ("floating-theory",), "period": ("floating-theory",), "decay_rate": ("centre-height",),
    "decay_rate_late": ("centre-height",), "dam_break_distance": ("dam-break",), "solid_level_distance": ("sedimentation",),
    "solid_height": ("water-entry",), "interface_height": ("water-entry",), "liquid_front": ("dambreak-beads",),
    "grain_front": ("dambreak-beads",),
}
# Runs that those plots draw; of any other run its snapshots are linked.
DRAWN = {
    "run-out": ("s1", "s2"), "dry-front": ("canary-dry",), "base-pressure": ("s1-loose", "s1-dense"), "dam-break": ("dam-break",), "sedimentation": ("sedimentation",),
    "viscous-collapse": ("rondon-loose", "rondon-dense"), "water-entry": ("water-entry",), "dambreak-beads": ("dambreak-beads",),
}


def plot_of(run, case, quantity, plots):
    """The plot of a run's quantity among those that were drawn; its fields where there is none; else nothing."""
    for name in SHOWN_IN.get(quantity, ()):
        if name in plots and case in DRAWN.get(name, (case,)):
            return name
    for name in (f"snapshots-{run}", f"snapshots-{case}"):
        if name in plots:
            return name
    return None


def caption(name):
    if name == "stability-map":
        return stability.CAPTION
    if name.startswith("energy-"):
        return energy.caption(name.removeprefix("energy-"))
    if name.startswith("ledger-"):
        return ledgers.caption(name.removeprefix("ledger-"))
    if name.startswith("plan-"):
        return f"{name.removeprefix('plan-')}: the 3D scene from above; colour: depth of the solid, of grains without pores."
    if name.startswith("states-"):
        return states.caption(name.removeprefix("states-"))
    if name.startswith("snapshots-"):
        return (f"{name.removeprefix('snapshots-')}: solid fraction, colour of the grains and, where recorded, DEM-VOF; black line: "
                "alpha = 0.5 (paper, Fig. 3); of a 3D scene its mid-plane.")
    return CAPTIONS[name]


def on_its_own(results):
    """Runs that are judged by more than that they are the same as another."""
    return {row["scene"] for row in results.rows if not row["metric"].startswith("series_difference")}


def draw_all(results, directory, kept=None):
    """All plots that the results allow, as names in the order of the page; `kept` holds results of earlier studies."""
    names = []
    for plot in PLOTS:
        names += results.shown(lambda: plot(results, directory)) or []
    names += results.shown(lambda: stability.map_plot(stability.load(results.directory, kept), directory, results.version)) or []
    judged = on_its_own(results)
    pictured = [run for run in results.curves if run in judged]
    for run in pictured:
        names += results.shown(lambda: energy.energy_plot(results, run, directory)) or []
        names += results.shown(lambda: ledgers.ledger_plot(results, run, directory)) or []
    for run in pictured:
        names += results.shown(lambda: snapshot_plot(results, run, directory)) or []
        names += results.shown(lambda: plan_plot(results, run, directory)) or []
        if results.records.get(results.record_of(run)):
            names += results.shown(lambda: states.state_plot(results, run, directory)) or []
    return names
