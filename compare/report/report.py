#!/usr/bin/python3
"""Plots and report.html from what `granvof-compare check` wrote; runs nothing."""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from report import figures, page, results  # noqa: E402


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--verify", type=Path, required=True, help="directory with results.json and curves.json")
    options = parser.parse_args(arguments)
    loaded = results.load(options.verify)
    plots = figures.draw_all(loaded, options.verify / "plots")
    (options.verify / "report.html").write_text(page.render(loaded, plots), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
