"""An OpenFOAM case's own output (ASCII, one uniform block, x along the tank, y up) as fields.h5 of docs/output.md.

The fields then go through the same extraction as ours, so that fronts and levels mean the same on both sides.
"""

import re

import h5py
import numpy as np

from granvof_files import text_of

NUMBER = r"[-+0-9.eE]+"


class CaseError(Exception):
    """What is wrong with the case, in one line."""


def read_grid(case):
    """Cells (nx, ny, nz), spacing and origin [m] of the single block of system/blockMeshDict."""
    path = case / "system/blockMeshDict"
    if not path.exists():
        raise CaseError(f"{path} is missing: is {case} an OpenFOAM case?")
    text = re.sub(r"//.*", "", text_of(path))
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
    text = text_of(path)
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


# Our field -> the number of its components.
FIELDS = {"alpha": 1, "f_s": 1, "u_c": 3, "u_s": 3, "p_c": 1, "theta": 1}


def liquid_field(directory, others):
    """The volume fraction of the liquid: alpha.water, or the only alpha.* there is; None where the only ones are `others`."""
    found = sorted(path for path in directory.glob("alpha.*") if path.name not in others)
    if not found and others:
        return None
    named = [path for path in found if path.name == "alpha.water"] or found
    if len(named) != 1:
        raise CaseError(f"{directory}: one field alpha.* is needed, there are {len(found)}")
    return named[0]


def instants(case, velocity):
    """(time, directory) of every output time that holds the velocity, in order."""
    timed = [(float(path.name), path) for path in case.iterdir() if re.fullmatch(r"\d[-+0-9.eE]*", path.name) and (path / velocity).exists()]
    if not timed:
        raise CaseError(f"{case}: no output times with {velocity} (run reconstructPar after a parallel run)")
    return sorted(timed)


def convert(case, target, names=None):
    """Writes `target` (HDF5) from the case; gives back what was understood, as sentences. `names` maps our fields (FIELDS) to
    the files of the case, {"f_s": "alpha.a"}; what is not in it is found by the names that stock programs use."""
    try:
        return convert_case(case, target, names or {})
    except (OSError, ValueError, AttributeError) as error:  # a text that is no number, a file that is none
        raise CaseError(f"{case}: {' '.join(str(error).split())}") from error


def convert_case(case, target, names):
    for our in names:
        if our not in FIELDS:
            raise CaseError(f"--map: '{our}' given; allowed: {', '.join(FIELDS)}")
    cells, spacing, origin = read_grid(case)
    times = instants(case, names.get("u_c", "U"))
    said = [f"{len(times)} instants, {times[0][0]:g} to {times[-1][0]:g} s, on {' x '.join(map(str, cells))} cells"]
    said += [f"{our} is {their}" for our, their in names.items()]
    with h5py.File(target, "w") as file:
        file.attrs["cells"], file.attrs["spacing"], file.attrs["origin"] = cells.astype("i4"), spacing, origin
        file.attrs["scene"], file.attrs["contract_version"] = case.name, 1
        for index, (time, directory) in enumerate(times):
            group = file.create_group(f"t{index:04}")
            group.attrs["time"] = time
            liquid = directory / names["alpha"] if "alpha" in names else liquid_field(directory, names.values())
            if liquid is None and index == 0:
                said.append("no other alpha.*: all is liquid between the grains")
            alpha = np.ones(tuple(cells[::-1])) if liquid is None else named_field(liquid, cells, 1)
            pressure = directory / names.get("p_c", "p")
            group["alpha"] = alpha
            group["u_c"] = read_field(directory / names.get("u_c", "U"), cells, 3)
            # At time 0 a case often holds p_rgh alone: no pressure yet.
            group["p_c"] = read_field(pressure, cells, 1) if pressure.exists() else np.zeros_like(alpha)
            # MPPICInterFoam and DPMFoam write the share of the continuous phase.
            continuous = directory / "alphac"
            if "f_s" in names:
                group["f_s"] = named_field(directory / names["f_s"], cells, 1)
            else:
                group["f_s"] = 1.0 - read_field(continuous, cells, 1) if continuous.exists() else np.zeros_like(alpha)
            group["phi"] = np.zeros_like(alpha)
            for name in ("theta", "u_s"):
                shape = alpha.shape + ((3,) if FIELDS[name] > 1 else ())
                group[name] = named_field(directory / names[name], cells, FIELDS[name]) if name in names else np.zeros(shape)
    return said


def named_field(path, cells, width):
    """A field that the user has named, or whose name was found."""
    if not path.exists():
        there = ", ".join(sorted(found.name for found in path.parent.iterdir() if found.is_file()))
        raise CaseError(f"{path} is missing; there are: {there}")
    return read_field(path, cells, width)
