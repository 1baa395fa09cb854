"""An OpenFOAM case's own output (ASCII, one uniform block, x along the tank, y up) as fields.h5 of docs/output.md.

The fields then go through the same extraction as ours, so that fronts and levels mean the same on both sides.
"""

import re

import h5py
import numpy as np

NUMBER = r"[-+0-9.eE]+"


class CaseError(Exception):
    """What is wrong with the case, in one line."""


def read_grid(case):
    """Cells (nx, ny, nz), spacing and origin [m] of the single block of system/blockMeshDict."""
    path = case / "system/blockMeshDict"
    if not path.exists():
        raise CaseError(f"{path} is missing: is {case} an OpenFOAM case?")
    text = re.sub(r"//.*", "", path.read_text())
    blocks = re.findall(r"hex\s*\([\d\s]+\)\s*\((\d+)\s+(\d+)\s+(\d+)\)\s*simpleGrading\s*\(\s*1\s+1\s+1\s*\)", text)
    if len(blocks) != 1 or text.count("hex") != 1:
        raise CaseError(f"{path}: one block with simpleGrading (1 1 1) is needed")
    scale = re.search(rf"(?:scale|convertToMeters)\s+({NUMBER})", text)
    listed = re.search(r"vertices\s*\((.*?)\)\s*;", text, re.S)
    corners = np.array(re.findall(rf"\(\s*({NUMBER})\s+({NUMBER})\s+({NUMBER})\s*\)", listed.group(1) + ")"), dtype=float)
    corners *= float(scale.group(1)) if scale else 1.0
    cells = np.array(blocks[0], dtype=int)
    return cells, (corners.max(axis=0) - corners.min(axis=0)) / cells, corners.min(axis=0)


def read_field(path, cells, width):
    """Internal field as an array (z, y, x) or, for `width` 3, (z, y, x, 3)."""
    text = path.read_text()
    shape = tuple(cells[::-1]) + ((width,) if width > 1 else ())
    listed = re.search(r"internalField\s+nonuniform\s+List<\w+>\s+(\d+)\s*\((.*?)\n\)\s*;", text, re.S)
    if listed:
        values = np.array(listed.group(2).replace("(", " ").replace(")", " ").split(), dtype=float)
        if values.size != np.prod(shape):
            raise CaseError(f"{path}: {values.size} numbers for {np.prod(cells)} cells")
        return values.reshape(shape)
    uniform = re.search(r"internalField\s+uniform\s+\(?([^;)]*)\)?\s*;", text)
    if not uniform:
        raise CaseError(f"{path}: no internalField in ASCII (writeFormat ascii, writeCompression off)")
    return np.broadcast_to(np.array(uniform.group(1).split(), dtype=float), shape if width > 1 else shape + (1,)).reshape(shape)


def liquid_field(directory):
    """The volume fraction of the liquid: alpha.water, or the only alpha.* there is."""
    found = sorted(path for path in directory.glob("alpha.*"))
    named = [path for path in found if path.name == "alpha.water"] or found
    if len(named) != 1:
        raise CaseError(f"{directory}: one field alpha.* is needed, there are {len(found)}")
    return named[0]


def instants(case):
    """(time, directory) of every output time that holds U, in order."""
    timed = [(float(path.name), path) for path in case.iterdir() if re.fullmatch(NUMBER, path.name) and (path / "U").exists()]
    if not timed:
        raise CaseError(f"{case}: no output times (run reconstructPar after a parallel run)")
    return sorted(timed)


def convert(case, target):
    """Writes `target` (HDF5) from the case; gives back the number of instants."""
    cells, spacing, origin = read_grid(case)
    times = instants(case)
    with h5py.File(target, "w") as file:
        file.attrs["cells"], file.attrs["spacing"], file.attrs["origin"] = cells.astype("i4"), spacing, origin
        file.attrs["scene"], file.attrs["contract_version"] = case.name, 1
        for index, (time, directory) in enumerate(times):
            group = file.create_group(f"t{index:04}")
            group.attrs["time"] = time
            alpha = read_field(liquid_field(directory), cells, 1)
            pressure = directory / "p"
            group["alpha"] = alpha
            group["u_c"] = read_field(directory / "U", cells, 3)
            # At time 0 a case often holds p_rgh alone: no pressure yet.
            group["p_c"] = read_field(pressure, cells, 1) if pressure.exists() else np.zeros_like(alpha)
            # MPPICInterFoam and DPMFoam write the share of the continuous phase.
            continuous = directory / "alphac"
            group["f_s"] = 1.0 - read_field(continuous, cells, 1) if continuous.exists() else np.zeros_like(alpha)
            for name in ("theta", "phi"):
                group[name] = np.zeros_like(alpha)
            group["u_s"] = np.zeros_like(group["u_c"])
    return len(times)
