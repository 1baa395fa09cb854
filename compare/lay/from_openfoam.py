"""An OpenFOAM case's own output (ASCII, one uniform block, x along the tank, y up) as fields.h5 of docs/output.md."""

import re

import numpy as np

from granvof_files import text_of
from lay.their_fields import FIELDS, CaseError, Grid, Source, sources, write

NUMBER = r"[-+0-9.eE]+"


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
    mapped = sources(names, FIELDS)
    grid = Grid(*read_grid(case))
    times = instants(case, mapped["u_c"].name if "u_c" in mapped else "U")
    said = [f"{len(times)} instants, {times[0][0]:g} to {times[-1][0]:g} s, on {' x '.join(map(str, grid.cells))} cells"]
    said += [f"{our} is {source}" for our, source in mapped.items()]
    if "alpha" not in mapped and liquid_field(times[0][1], named(mapped)) is None:
        said.append("no other alpha.*: all is liquid between the grains")
    write(target, case.name, grid, ((time, fields_at(directory, grid.cells, mapped)) for time, directory in times))
    return said


def named(mapped):
    return {source.name for source in mapped.values()}


def fields_at(directory, cells, mapped):
    """Our fields of an instant that the case has."""
    fields = {our: source.of(named_field(directory / source.name, cells, FIELDS[our][0])) for our, source in mapped.items()
              if our != "p_c"}
    if "alpha" not in mapped and (liquid := liquid_field(directory, named(mapped))) is not None:
        fields["alpha"] = named_field(liquid, cells, 1)
    if "u_c" not in mapped:
        fields["u_c"] = read_field(directory / "U", cells, 3)
    # At time 0 a case often holds p_rgh alone: no pressure yet.
    pressure = mapped.get("p_c", Source("p"))
    if (directory / pressure.name).exists():
        fields["p_c"] = pressure.of(read_field(directory / pressure.name, cells, 1))
    # MPPICInterFoam and DPMFoam write the share of the continuous phase.
    continuous = directory / "alphac"
    if "f_s" not in mapped and continuous.exists():
        fields["f_s"] = 1.0 - read_field(continuous, cells, 1)
    return fields


def named_field(path, cells, width):
    """A field that the user has named, or whose name was found."""
    if not path.exists():
        there = ", ".join(sorted(found.name for found in path.parent.iterdir() if found.is_file()))
        raise CaseError(f"{path} is missing; there are: {there}")
    return read_field(path, cells, width)
