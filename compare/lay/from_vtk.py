"""VTK files of MFiX (or of ParaView's "Save Data" in the same form: one uniform box of cells, x along the tank, y up) as
fields.h5 of docs/output.md."""

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np

from granvof_files import OF_READING, bytes_of
from lay import vtu
from lay.their_fields import FIELDS, CaseError, Grid, Source, sources, write

# What can be named: our fields, and the unit of their coordinates.
NAMES = FIELDS | {"x": (3, "m")}
# MFiX's own names. What it has of each kind of grains ends with the number of the kind.
STOCK = {"x": Source("coordinates"), "f_s": Source("EP_G", rest=True), "u_c": Source("Gas_Velocity"), "p_c": Source("P_G")}
OF_EACH_KIND = {"u_s": "Solids_Velocity_", "theta": "Granular_temperature_"}
NEEDED = ("f_s", "u_c")
EVEN = 1e-2  # of a cell, as far as one may be from its place in an even box; coordinates are of single precision


@dataclass
class Box:
    grid: Grid
    places: np.ndarray  # of each cell of a file in the arrays of the grid, x fastest

    @classmethod
    def of(cls, path, cells, factor):
        lower, upper = factor * cells.lower, factor * cells.upper
        origin, size = lower.min(axis=0), upper.max(axis=0) - lower.min(axis=0)
        extent = np.median(upper - lower, axis=0)
        if extent[2] == 0.0 and size[2] == 0.0:  # MFiX's plane has no depth: one cell, as deep as it is long
            size[2] = extent[2] = extent[0]
            upper = upper + np.array([0.0, 0.0, extent[2]])
        if not (np.isfinite(size).all() and (extent > 0.0).all()):
            raise CaseError(f"{path}: its cells have no volume")
        count = np.rint(size / extent).astype(int)
        spacing = size / count
        place = np.rint((lower - origin) / spacing).astype(int)
        uneven = np.abs(np.stack([origin + place * spacing - lower, origin + (place + 1) * spacing - upper])).max(axis=(0, 1)) > EVEN * spacing
        if uneven.any() or count.prod() != len(lower):
            raise CaseError(f"{path}: cells that fill one box, all of one size, are needed (no cut cells, the whole region)")
        places = np.ravel_multi_index(tuple(place.T[::-1]), tuple(count[::-1]))
        if len(np.unique(places)) != len(places):
            raise CaseError(f"{path}: two cells lie in one place")
        return cls(Grid(count, spacing, origin), places)

    def same(self, other):
        return np.array_equal(self.places, other.places) and np.allclose(self.grid.spacing, other.grid.spacing, rtol=1e-5)

    def array(self, values, width):
        placed = np.empty((self.grid.cells.prod(), width))
        placed[self.places] = values.reshape(-1, width)
        return placed.reshape(self.grid.shape(width))


def convert(path, target, names=None):
    """Writes `target` (HDF5) from a .pvd, or a folder of .vtu files; gives back what was understood, as sentences. `names` maps
    our fields (NAMES) to theirs, {"f_s": "1-EP_G", "u_s": "Solids_Velocity_2 [cm/s]", "x": "coordinates [cm]"}."""
    try:
        return convert_files(path, target, sources(names or {}, NAMES))
    except (*OF_READING, ElementTree.ParseError) as error:  # a text that is no number, a file that is none
        raise CaseError(f"{path}: {' '.join(str(error).split())}") from error


def convert_files(path, target, mapped):
    timed = instants(path)
    first = timed[0][1]
    cells = vtu.read(first)
    fields = mapped | stock_fields(first, cells, mapped)
    factor = fields.pop("x").factor
    box = Box.of(first, cells, factor)

    def contents():
        for time, file in timed:
            there = vtu.read(file)
            if not box.same(Box.of(file, there, factor)):
                raise CaseError(f"{file}: its cells are not those of {first.name}")
            yield time, {our: source.of(box.array(field(file, there, source, FIELDS[our][0]), FIELDS[our][0])) for our, source in fields.items()}

    write(target, path.stem, box.grid, contents())
    said = [f"{len(timed)} instants, {timed[0][0]:g} to {timed[-1][0]:g} s, on {' x '.join(map(str, box.grid.cells))} cells"]
    said += [f"{our} is {source}" for our, source in fields.items()]
    if factor != 1.0:
        said.append(f"lengths are multiplied by {factor:g}")
    if "alpha" not in fields:
        said.append("alpha is not given: all is liquid between the grains")
    return said


def instants(path):
    """(time, file) in order, from a .pvd or from what the files of a folder say themselves."""
    if path.is_dir():
        files = sorted(path.glob("*.vtu"))
        timed = [(vtu.Document(file).time(), file) for file in files]
        if silent := [file.name for time, file in timed if time is None]:
            raise CaseError(f"{path / silent[0]}: it states no time; name the .pvd that lists the files")
    elif path.suffix == ".pvd":
        listed = ElementTree.fromstring(bytes_of(path)).iter("DataSet")
        timed = [(float(tag.get("timestep")), path.parent / tag.get("file")) for tag in listed]
    else:
        raise CaseError(f"{path}: a .pvd file, or a folder of .vtu files, is needed")
    timed.sort()
    if not timed:
        raise CaseError(f"{path}: there is no .vtu file")
    for (time, file), (after, other) in zip(timed, timed[1:]):
        if time == after:
            raise CaseError(f"{path}: {file.name} and {other.name} are of the same time {time:g}; name the .pvd of one region")
    if not np.isfinite([time for time, _ in timed]).all():
        raise CaseError(f"{path}: a time is not finite")
    return timed


def stock_fields(path, cells, mapped):
    """What MFiX calls its own, where a file has it and the user has named nothing else."""
    found = {our: source for our, source in STOCK.items() if our not in mapped and (source.name in cells.data or our in ("x", *NEEDED))}
    for our, begins in OF_EACH_KIND.items():
        kinds = sorted(name for name in cells.data if name.startswith(begins))
        if our in mapped or not kinds:
            continue
        if len(kinds) > 1:
            raise CaseError(f"{path}: there are {', '.join(kinds)}; --map {our}=NAME says which")
        found[our] = Source(kinds[0])
    return found


def field(path, cells, source, width):
    if source.name not in cells.data:
        raise CaseError(f"{path}: there is no {source.name}; there are: {', '.join(cells.data)}")
    values = cells.data[source.name]
    if values.size != width * len(cells.lower):
        raise CaseError(f"{path}: {source.name} has not {width} number{'s' if width > 1 else ''} a cell")
    if not np.isfinite(values).all():
        raise CaseError(f"{path}: {source.name} is not finite everywhere")
    return values
