#!/usr/bin/python3
"""Plots and report.html from what `granvof-compare check` wrote; runs nothing."""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "compare"), str(ROOT / "solver/python")]

from complaint import complain, ended, given_path  # noqa: E402
from granvof_files import write_whole  # noqa: E402
from report import charts, figures, kept_results, page, results, sections  # noqa: E402


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--verify", type=given_path, required=True, help="directory with results.json and curves.json")
    parser.add_argument("--cases", type=given_path, default=ROOT / "cases", help="case files, with published/")
    parser.add_argument("--kept", type=given_path, default=ROOT / "compare/kept", help="results of earlier studies, for what was not run")
    options = parser.parse_args(arguments)
    try:
        loaded = results.load(options.verify, options.cases)
        return write(loaded, options)
    except results.Damaged as error:
        complain(f"report: {error}")
        return 2


def write(loaded, options):
    """Plots and page of what was loaded; Damaged where a section of others is damaged."""
    out = options.verify.resolve().parent
    directories = {"charts": out / "charts"}
    if not (out / "charts/charts.json").exists() and charts.from_kept(options.kept, options.verify / "kept/charts", loaded.version):
        directories["charts"] = options.verify / "kept/charts"
    for name in ("stability", "mutate", "faults"):
        if not (out / name / f"{name}.json").exists():
            directories[name] = options.kept / name
    others = sections.read_all(out, directories, loaded.version)
    plots = figures.draw_all(loaded, options.verify / "plots", options.kept)
    kept = kept_results.read(options.kept / "verify/results.json")
    write_whole(options.verify / "report.html", page.render(loaded, plots, others, kept))
    for sentence in loaded.damaged:
        complain(f"report: {sentence}")
    return 1 if loaded.damaged else 0


if __name__ == "__main__":
    try:
        sys.exit(ended(main, sys.argv[1:]))
    except OSError as cause:  # a full disk, above all
        complain(f"report: it cannot be written: {cause}")
        sys.exit(1)
