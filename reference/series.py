"""A column of a record's series."""
import csv

import numpy as np

from recorder import opened


def curve(folder, column):
    """Times and values of a column, undefined ones left out; None without the column."""
    with opened(folder / "series.csv", newline="") as file:
        rows = [(row["time [s]"], row.get(column)) for row in csv.DictReader(file)]
    points = [(float(time), float(value)) for time, value in rows if value]
    return tuple(np.array(points).T) if len(points) > 1 else None
