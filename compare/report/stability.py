"""The stability map: for every axis and method, how far it holds, from what compare/stability wrote."""

import math

import matplotlib.patches as patches

from report import style, versions
from report.results import read_json
from report.style import plt

KINDS = {"step collapse": (style.ORANGE, "//"), "blow-up": (style.RED, "xx"),
         "wrong answer, detected": (style.PURPLE, ".."), "wrong answer, undetected": (style.BLACK, "++")}


def load(verify, kept=None):
    """What compare/stability wrote beside the directory of results, else what `kept` holds of an earlier version, or None."""
    paths = [directory / "stability/stability.json" for directory in (verify.parent, kept) if directory]
    return next((read_json(path, "axes") for path in paths if path.exists()), None)


def place(entry, value):
    """0 to 1 along the axis' whole range."""
    ends = [entry["nominal"]] + [border["end"] for border in entry["borders"]]
    low, high = min(ends), max(ends)
    if entry["scale"] == "log":
        low, high, value = math.log(low), math.log(high), math.log(value)
    return (value - low) / (high - low)


def bar(axis, left, right, y, height, **look):
    axis.add_patch(patches.Rectangle((min(left, right), y - height / 2), abs(right - left), height, **look))


def map_plot(found, directory, now=None):
    if not found or not found["axes"]:
        return []
    names = list(dict.fromkeys(entry["axis"] for entry in found["axes"]))
    methods = list(dict.fromkeys(entry["method"] for entry in found["axes"]))
    figure, axis = plt.subplots(figsize=(8.4, 0.34 * len(names) + 1.4))
    height = 0.7 / len(methods)
    shown = set()
    for entry in found["axes"]:
        y = -names.index(entry["axis"]) - (methods.index(entry["method"]) - (len(methods) - 1) / 2) * height
        nominal = place(entry, entry["nominal"])
        for border in entry["borders"]:
            holds = nominal if border["holds"] is None else place(entry, border["holds"])
            end = place(entry, border["end"])
            bar(axis, nominal, holds, y, 0.85 * height, facecolor=style.SKY, edgecolor="none")
            if border["fails"] is None:
                continue
            colour, hatch = KINDS[border["kind"]]
            fails = place(entry, border["fails"])
            bar(axis, fails, end if end != fails else holds, y, 0.85 * height, facecolor="white", edgecolor=colour, hatch=hatch,
                linewidth=0.8)
            bar(axis, holds, fails, y, 0.85 * height, facecolor="0.85", edgecolor="none")
            axis.text(holds, y, f"{border['holds']:.3g}" if border["holds"] is not None else "none", fontsize=5.5, va="center",
                      ha="right" if end > nominal else "left")
            shown.add(border["kind"])
        axis.plot([nominal], [y], marker="|", color="black", markersize=8)
        if entry["method"] == methods[0]:
            ends = sorted([entry["nominal"]] + [border["end"] for border in entry["borders"]])
            unit = "" if entry["unit"] == "-" else f" {entry['unit']}"
            axis.text(-0.01, -names.index(entry["axis"]), f"{entry['axis']}: {ends[0]:.3g} to {ends[-1]:.3g}{unit}", ha="right",
                      va="center", fontsize=7.5)
    handles = [patches.Patch(facecolor=style.SKY, label="holds"), patches.Patch(facecolor="0.85", label="border lies here")]
    handles += [patches.Patch(facecolor="white", edgecolor=colour, hatch=hatch, label=kind)
                for kind, (colour, hatch) in KINDS.items() if kind in shown]
    axis.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.4, -0.02), ncol=3, fontsize=7)
    axis.set_title("upper to lower bar: " + ", ".join(methods) + "; tick: nominal value", loc="left", fontsize=8)
    if found.get("commit"):
        figure.supxlabel(f"{versions.named(found['commit'], now)}, {found['date'][:10]}", fontsize=5.5, color="0.45")
    axis.set_xlim(0, 1)
    axis.set_ylim(-len(names) + 0.5, 0.5)
    axis.set_axis_off()
    return [style.save(figure, directory, "stability-map")]


CAPTION = ("Where the methods hold: each axis from end to end of what was tried, found by bisection on small scenes "
           "(compare/stability.toml). To hold: the run ends, no monitor warns, and half the step gives the same answer.")
