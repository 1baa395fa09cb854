"""Plots of lay.json: one quantity each, ours and theirs."""


import numpy as np

from granvof_files import json_of
from report import style
from report.style import plt


def draw(directory):
    """Names of the plots written into `directory`."""
    laid = json_of(directory / "lay.json")
    names = []
    for curve in laid["curves"]:
        figure, axis = plt.subplots(figsize=(5.6, 3.8))
        for side, label, colour, line in (("ours", "granvof", style.BLUE, "-"), ("theirs", laid["theirs"], style.RED, "--")):
            x, y = np.array(curve[side]["x"]), np.array(curve[side]["y"])
            axis.plot(x, y, color=colour, linestyle=line, marker="o" if len(x) < 30 else None, markersize=3.5, label=label)
        axis.set_xlabel(curve["abscissa"])
        axis.set_ylabel(f"{curve['name'].replace('_', ' ')} [{curve['unit']}]")
        axis.set_title(f"{laid['scene']}: rms apart {curve['rms']:.3g} {curve['unit']}", loc="left", fontsize=9)
        style.legend(axis)
        style.stamp(figure, [laid["run"]])
        names.append(style.save(figure, directory, f"lay-{curve['name'].replace('_', '-')}"))
    return names
