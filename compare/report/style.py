"""One style for all plots: fit for print, colour-blind safe, each stamped with what it was drawn from."""

import io
import textwrap

import matplotlib
from granvof_files import write_whole

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib import patheffects  # noqa: E402

# Okabe & Ito's palette: told apart with any common colour vision, and in grey by their order.
BLUE, ORANGE, GREEN, PURPLE, SKY, RED, YELLOW, BLACK = (
    "#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#F0E442", "#000000")
CYCLE = [BLUE, ORANGE, GREEN, PURPLE, SKY, RED]
MARKERS = ["o", "s", "^", "D", "v", "P", "<", "p", ">", "H"]  # one more than the colours of the charts: none repeats soon
LINES = ["-", "--", "-.", ":"]
HALO = patheffects.withStroke(linewidth=2.0, foreground="white")
THEORY = {"color": BLACK, "linestyle": "--", "linewidth": 1.0}
DEM = RED
PEER = PURPLE

plt.rcParams.update({
    "figure.dpi": 100, "savefig.dpi": 150, "figure.constrained_layout.use": True,
    "font.size": 10, "axes.labelsize": 10, "legend.fontsize": 8.5, "legend.frameon": False,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25,
    "axes.prop_cycle": matplotlib.cycler(color=CYCLE), "lines.linewidth": 1.6, "pdf.fonttype": 42,
    "svg.fonttype": "none", "image.cmap": "viridis",
})


def legend(axis, columns=None, size=None):
    """Above the axes, off the data; in as many columns as fit, at most three, or as given; `size` of its letters."""
    handles, labels = axis.get_legend_handles_labels()
    if handles:
        longest = max(len(label) for label in labels)
        fitting = max(1, int(11 * axis.figure.get_figwidth()) // (longest + 6))
        axis.legend(handles, labels, loc="lower left", bbox_to_anchor=(0.0, 1.01), borderaxespad=0.0, fontsize=size,
                    ncols=columns or min(fitting, 3, len(handles)))


def stamp(figure, runs):
    """One line of small print: version, case hashes and host of the runs a plot shows."""
    facts = [run for run in runs if run.get("case_hash")]
    if not facts:
        return
    versions = ", ".join(sorted({label_of_version(run) for run in facts}))
    hashes = " ".join(f"{run['id']}:{run['case_hash'][:8]}" for run in facts)
    hosts = ", ".join(sorted({run["host"] for run in facts}))
    text = textwrap.fill(f"granvof {versions} | {hashes} | {hosts}", width=int(24 * figure.get_figwidth()))
    figure.supxlabel(text, fontsize=5.5, color="0.45")


def label_of_version(run):
    version = run.get("version") or "of unknown version"
    return f"{version} ({run['commit']})" if run.get("commit") else version


def save(figure, directory, name, pdf=True):
    """Writes <name>.png and, unless it is one of a picture for every run, <name>.pdf; gives the name back."""
    write_drawn(figure, directory / f"{name}.png")
    if pdf:
        figure.set_layout_engine("none")  # the layout is found once; it is the slow part
        # No creation date: the same results give the same file.
        write_drawn(figure, directory / f"{name}.pdf", metadata={"CreationDate": None})
    plt.close(figure)
    return name


def write_drawn(figure, path, **options):
    """Drawn in memory first: on a full disk the writer of PDF fails by other errors than the system's."""
    drawn = io.BytesIO()
    figure.savefig(drawn, format=path.suffix[1:], **options)
    write_whole(path, drawn.getvalue())
