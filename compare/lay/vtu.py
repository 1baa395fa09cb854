"""One .vtu file of cells, as MFiX (and ParaView, in ASCII or appended raw data) writes it.

A reader of its own: Debian's python3-vtk9 brings Qt and MPI with it, and these files need no more than this.
"""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np

from granvof_files import bytes_of
from lay.their_fields import CaseError

TYPES = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2", "Int32": "i4", "UInt32": "u4",
         "Int64": "i8", "UInt64": "u8"}
# MFiX says the time in a comment, ParaView in a field of the file.
TIME = re.compile(rb"<!--\s*Time\s*=\s*([-+0-9.eE]+)\s*sec")


@dataclass
class Cells:
    time: float | None
    lower: np.ndarray  # corners of the box around each cell
    upper: np.ndarray
    data: dict         # name -> an array, a row a cell


class Document:
    """The tags, and the bytes after them: raw data are no XML."""

    def __init__(self, path):
        head, found, self.appended = bytes_of(path).partition(b"<AppendedData")
        if b"<!DOCTYPE" in head:
            raise CaseError(f"{path}: it has a DOCTYPE, which no .vtu file has")
        self.path = path
        self.head = head
        self.root = ElementTree.fromstring(head + (b"</VTKFile>" if found else b""))
        if self.root.tag != "VTKFile" or self.root.get("type") != "UnstructuredGrid":
            raise CaseError(f"{path}: a .vtu file of cells is needed, it is of {self.root.get('type', self.root.tag)!r:.60}")
        if self.root.get("compressor"):
            raise CaseError(f"{path}: its data are compressed; save them uncompressed")
        self.order = "<" if self.root.get("byte_order", "LittleEndian") == "LittleEndian" else ">"
        self.length = "u8" if self.root.get("header_type") == "UInt64" else "u4"

    def array(self, tag):
        kind, form = TYPES.get(tag.get("type")), tag.get("format")
        if kind is None:
            raise CaseError(f"{self.path}: {tag.get('Name')}: numbers are needed, not {tag.get('type')!r:.60}")
        if form == "ascii":
            values = np.array((tag.text or "").split(), dtype=kind)
        elif form == "appended" and self.appended.partition(b">")[0].replace(b" ", b"") == b'encoding="raw"':
            values = self.raw(int(tag.get("offset")), kind, tag.get("Name"))
        else:
            raise CaseError(f"{self.path}: {tag.get('Name')}: ascii or appended raw data are needed; save it so")
        width = int(tag.get("NumberOfComponents", 1))
        return values.reshape(-1, width) if width > 1 else values

    def raw(self, offset, kind, name):
        """Each array is preceded by the number of its bytes."""
        data = memoryview(self.appended)[self.appended.index(b"_") + 1:]
        length = np.dtype(self.order + self.length)
        begins = offset + length.itemsize
        if offset < 0 or begins > len(data) or (size := int(np.frombuffer(data[offset:begins], length)[0])) > len(data) - begins:
            raise CaseError(f"{self.path}: {name}: the file ends before its data")
        return np.frombuffer(data[begins:begins + size], np.dtype(kind).newbyteorder(self.order))

    def time(self):
        for tag in self.root.iterfind("./UnstructuredGrid/FieldData/DataArray"):
            if tag.get("Name") == "TimeValue":
                return float(self.array(tag).ravel()[0])
        found = TIME.search(self.head)
        return float(found.group(1)) if found else None


def read(path):
    """The cells of a file; CaseError, one line, or what parsing raises."""
    file = Document(path)
    pieces = file.root.findall("./UnstructuredGrid/Piece")
    if len(pieces) != 1:
        raise CaseError(f"{path}: one piece is needed, there are {len(pieces)}")
    points, *further = [file.array(tag) for tag in pieces[0].iterfind("./Points/DataArray")]
    cells = {tag.get("Name"): file.array(tag) for tag in pieces[0].iterfind("./Cells/DataArray")}
    count = int(pieces[0].get("NumberOfCells"))
    ends = cells["offsets"].astype(int)
    corners = points[cells["connectivity"]]
    if further or len(ends) != count or not count or ends[-1] != len(corners) or (np.diff(ends, prepend=0) <= 0).any():
        raise CaseError(f"{path}: its cells are not what it says of them")
    starts = np.concatenate([[0], ends[:-1]])
    data = {tag.get("Name"): file.array(tag) for tag in pieces[0].iterfind("./CellData/DataArray")}
    for name, values in data.items():
        if len(values) != count:
            raise CaseError(f"{path}: {name}: {len(values)} values for {count} cells")
    return Cells(file.time(), np.minimum.reduceat(corners, starts).astype(float), np.maximum.reduceat(corners, starts).astype(float), data)
