"""Fields of other codes: what stands for ours there, and the fields.h5 (docs/output.md) they are written into.

They then go through the same extraction as ours, so that fronts and levels mean the same on both sides.
"""

import re
from dataclasses import dataclass

import h5py
import numpy as np

from lay.their_series import UNITS


class CaseError(Exception):
    """What is wrong with the case, in one line."""


# Our field -> the number of its components, and its unit.
FIELDS = {"alpha": (1, "-"), "f_s": (1, "-"), "u_c": (3, "m/s"), "u_s": (3, "m/s"), "p_c": (1, "Pa"), "theta": (1, "m2/s2")}


@dataclass(frozen=True)
class Source:
    """A field of theirs that stands for one of ours."""
    name: str
    factor: float = 1.0  # to the SI unit
    rest: bool = False   # ours is what theirs leaves of 1, as grains of the share of the fluid

    def of(self, values):
        values = self.factor * np.asarray(values, dtype=float)
        return 1.0 - values if self.rest else values

    def __str__(self):
        return ("1 - " if self.rest else "") + self.name + (f", times {self.factor:g}" if self.factor != 1.0 else "")


def sources(names, known):
    """Source of each name of a map, {"f_s": "1-EP_G", "u_s": "Us [cm/s]"}; `known` maps ours to (components, unit)."""
    found = {}
    for our, their in names.items():
        if our not in known:
            raise CaseError(f"--map: '{our}' given; allowed: {', '.join(known)}")
        parts = re.fullmatch(r"(1\s*-\s*)?(.*?)\s*(?:\[\s*(.*?)\s*\])?", their)
        unit = known[our][1]
        si, factor = UNITS.get(parts.group(3) or unit, (None, None))
        if si != unit:
            fitting = ", ".join(name for name, (of, _) in UNITS.items() if of == unit)
            raise CaseError(f"--map: '{our}' is given in '{parts.group(3)}'; allowed: {fitting}")
        if parts.group(1) and unit != "-":
            raise CaseError(f"--map: '{their}' given for '{our}'; only of a share is there a rest of 1")
        found[our] = Source(parts.group(2), factor, bool(parts.group(1)))
    return found


@dataclass(frozen=True)
class Grid:
    """One uniform box of theirs."""
    cells: np.ndarray    # nx, ny, nz
    spacing: np.ndarray  # m
    origin: np.ndarray   # m

    def shape(self, width):
        """Of an array of a field: (z, y, x) or, for more than one component, (z, y, x, width)."""
        return tuple(self.cells[::-1]) + ((width,) if width > 1 else ())


def write(target, scene, grid, instants):
    """`instants` gives (time, {our field: array}) in order; a field that is not in it is zero, or all liquid."""
    with h5py.File(target, "w") as file:
        file.attrs["cells"], file.attrs["spacing"], file.attrs["origin"] = grid.cells.astype("i4"), grid.spacing, grid.origin
        file.attrs["scene"], file.attrs["contract_version"] = scene, 1
        for index, (time, fields) in enumerate(instants):
            group = file.create_group(f"t{index:04}")
            group.attrs["time"] = time
            group["phi"] = np.zeros(grid.shape(1))
            for name, (width, _) in FIELDS.items():
                missing = np.ones if name == "alpha" else np.zeros
                group[name] = fields[name] if name in fields else missing(grid.shape(width))
