"""Reads what a run of granvof or demvof leaves behind, for a notebook or a script of one's own:

    import granvof
    run = granvof.load("out/runs/s1")
    run.series["front_dense"].plot()                              # pandas DataFrame, its index the time [s]
    run.fields["f_s"].sel(time=0.35, method="nearest").plot()     # xarray Dataset over time, z, y, x [m]
    run.facts["core_seconds"]                                     # run.json

Needs numpy and h5py; with pandas and xarray (Debian: python3-xarray) the tables carry names, without them they are plain
arrays under the same names. Everything in SI units; docs/output.md says what each name is.
"""

import csv
import hashlib
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from granvof_files import OF_READING, fields_of, is_there, json_of, opened, values_of

try:
    import pandas
    import xarray
except ImportError:
    pandas = xarray = None

# name: (unit, what it is), as in docs/output.md
FIELDS = {
    "f_s": ("-", "solid fraction"),
    "alpha": ("-", "liquid share of the continuous phase"),
    "p_c": ("Pa", "fluid pressure"),
    "p_s": ("Pa", "solid pressure"),
    "theta": ("m2/s2", "granular temperature"),
    "phi": ("-", "colour of the solid"),
    "u_s": ("m/s", "velocity of the grains"),
    "u_c": ("m/s", "velocity of the continuous phase"),
}


class NotARun(ValueError):
    """The directory does not hold what a run leaves behind; says which file, and why."""


@dataclass
class Run:
    directory: Path
    series: object  # DataFrame, attrs["units"]: name -> unit; without pandas a dict of arrays, with "time"
    fields: object  # Dataset; without xarray a dict of arrays (time, z, y, x[, component]), with "time", "x", "y", "z"; None
    #                 where the run wrote none
    facts: dict  # run.json, or record.json of a record
    units: dict  # name -> unit, of series and fields


def load(directory, fields=True):
    """The run in a directory. `fields=False` leaves fields.h5 alone, which may be large. Raises NotARun."""
    directory = Path(directory)
    series, units = read_series(directory / "series.csv")
    facts = {}
    for name in ("run.json", "record.json"):
        if is_there(directory / name):
            facts = read_facts(directory / name)
            break
    data = None
    if fields and is_there(directory / "fields.h5"):
        data = read_fields(directory / "fields.h5")
        units |= {name: unit for name, (unit, _) in FIELDS.items()}
    require_stated(directory, facts, ("series.csv", "fields.h5") if fields else ("series.csv",))
    return Run(directory, series, data, facts, units)


def require_stated(directory, facts, names):
    """NotARun where a file of a finished run is not the one whose SHA-256 its record states: of another run, say. Of a run that
    goes on the record is older than its files."""
    stated, end = facts.get("files"), facts.get("exit")
    if not isinstance(stated, dict) or not isinstance(end, dict) or end.get("state") != "finished":
        return
    for name in names:
        about = stated.get(name)
        digest = about.get("sha256") if isinstance(about, dict) else None
        if not digest:  # a record of an earlier version, or instants in files of their own
            continue
        try:
            with opened(directory / name, "rb") as file:
                found = hashlib.sha256()
                while block := file.read(1 << 20):
                    found.update(block)
        except OF_READING as error:
            raise NotARun(f"{directory / name}: {error}") from error
        if found.hexdigest() != digest:
            raise NotARun(f"{directory / name}: it is not the file that was written (its SHA-256 is another)")


def read_facts(path):
    try:
        facts = json_of(path)
        if not isinstance(facts, dict):
            raise ValueError("no JSON object")
        return facts
    except (OSError, ValueError) as error:
        raise NotARun(f"{path}: {error}") from error


def read_series(path):
    """Columns by their names without units, and the units; an empty field is NaN."""
    try:
        with opened(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        heads = [re.fullmatch(r"(.*\S) \[(.*)\]", head).groups() for head in rows[0]]
        values = np.array([[float(text) if text else np.nan for text in row] for row in rows[1:]], dtype=float)
        values = values.reshape(len(rows) - 1, len(heads))
        columns = {name: values[:, place] for place, (name, _) in enumerate(heads)}
        columns["time"]
    except OF_READING as error:
        raise NotARun(f"{path}: {error}") from error
    units = {name: unit for name, unit in heads}
    if pandas is None:
        return columns, units
    frame = pandas.DataFrame(columns).set_index("time")
    frame.attrs["units"] = units
    return frame, units


def read_fields(path):
    """All instants of a fields.h5, at the centres of the cells."""
    try:
        with fields_of(path) as file:
            return _labelled(file)
    except OF_READING as error:
        raise NotARun(f"{path}: {error}") from error


def _labelled(file):
    times = {float(group.attrs["time"]): group for group in file.values() if "time" in group.attrs}
    if len(times) < sum("time" in group.attrs for group in file.values()) or not np.isfinite(list(times)).all():
        raise ValueError("two instants of one time, or one without")
    time = np.array(sorted(times))
    groups = [times[instant] for instant in time]
    cells, spacing, origin = (np.asarray(file.attrs[name]) for name in ("cells", "spacing", "origin"))
    if not cells.shape == spacing.shape == origin.shape == (3,) or not (spacing > 0.0).all():
        raise ValueError("cells, spacing and origin are not three each, or no lengths")
    data = {name: np.stack([values_of(group[name]) for group in groups])
            for name in FIELDS if groups and all(name in group for group in groups)}
    if other := [name for name, values in data.items() if values.shape[1:4] != tuple(cells[::-1])]:
        raise ValueError(f"{other[0]} is not of {' x '.join(map(str, cells))} cells")
    centres = [origin[d] + (np.arange(cells[d]) + 0.5) * spacing[d] for d in range(3)]
    coordinates = {"time": time, "z": centres[2], "y": centres[1], "x": centres[0]}
    if xarray is None:
        return data | coordinates
    described = {name: (("time", "z", "y", "x", "component")[:values.ndim], values,
                        {"units": FIELDS[name][0], "long_name": FIELDS[name][1]}) for name, values in data.items()}
    title = file.attrs["scene"]
    made = xarray.Dataset(described, coords=coordinates | {"component": ["x", "y", "z"]},
                          attrs={"scene": title.decode() if isinstance(title, bytes) else title, "spacing": spacing})
    for name, unit in (("time", "s"), ("x", "m"), ("y", "m"), ("z", "m")):
        made[name].attrs["units"] = unit
    return made
