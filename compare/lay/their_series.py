"""A CSV of others, in whatever form spreadsheets, plotting programs and laboratories write it, as the CSV that
`granvof-compare lay` reads; what was understood of it is said.

Understood: commas, semicolons or tabs, with blanks around them; decimal commas between semicolons or tabs; LF, CRLF or CR;
a byte order mark; quotes; lines that begin with '#'; columns "name [unit]" or "name (unit)" in the units below; rows in any
order. Refused, with the line: a time that is given twice, a row of another length, text where a number belongs.
"""

import csv
import io
import math
import re
from dataclasses import dataclass, field

from granvof_files import bytes_of, required, write_whole

# Unit -> the SI unit, and what to multiply by.
UNITS = {
    "s": ("s", 1.0), "ms": ("s", 1e-3), "us": ("s", 1e-6), "min": ("s", 60.0),
    "m": ("m", 1.0), "dm": ("m", 1e-1), "cm": ("m", 1e-2), "mm": ("m", 1e-3), "um": ("m", 1e-6), "km": ("m", 1e3),
    "Pa": ("Pa", 1.0), "hPa": ("Pa", 1e2), "mbar": ("Pa", 1e2), "kPa": ("Pa", 1e3), "bar": ("Pa", 1e5), "MPa": ("Pa", 1e6), "dyn/cm2": ("Pa", 1e-1),
    "m/s": ("m/s", 1.0), "cm/s": ("m/s", 1e-2), "mm/s": ("m/s", 1e-3),
    "m2/s2": ("m2/s2", 1.0), "cm2/s2": ("m2/s2", 1e-4), "mm2/s2": ("m2/s2", 1e-6),
    "m3": ("m3", 1.0), "l": ("m3", 1e-3), "cm3": ("m3", 1e-6), "ml": ("m3", 1e-6), "mm3": ("m3", 1e-9),
    "J": ("J", 1.0), "mJ": ("J", 1e-3), "kJ": ("J", 1e3),
    "deg": ("deg", 1.0), "°": ("deg", 1.0), "rad": ("deg", 180.0 / math.pi),
    "-": ("-", 1.0), "1": ("-", 1.0), "%": ("-", 1e-2),
}
MOST_BYTES = 1 << 28  # a series in one dimension is not longer


class SeriesError(Exception):
    """What is wrong with the file, in one line."""


@dataclass
class Understood:
    header: list  # "name [SI unit]"
    rows: list    # texts, "" where a value is not known
    said: list = field(default_factory=list)  # one sentence each


def read(path, names=None):
    """The series of a file. `names` maps our name of a column to theirs, {"front_dense": "x front"}; other columns of theirs
    keep their names. SeriesError, one line, for whatever is wrong."""
    text = text_of(path)
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip() and not line.lstrip().startswith("#")]
    if len(lines) < 2:
        raise SeriesError(f"{path}: a header and at least one row are needed")
    separator = separator_of(path, lines)
    table = [(number, split(line, separator, path, number)) for number, line in lines]
    header, said = columns_of(path, table[0][1], names or {})
    decimal_comma = separator != "," and any("," in value for _, row in table[1:] for value in row)
    rows = [numbers_of(path, number, row, header, decimal_comma) for number, row in table[1:]]
    times = [at for at, (name, _, _) in enumerate(header) if name in ("time", "T")]
    if len(times) != 1:
        raise SeriesError(f"{path}: one column 'time [s]' or 'T [-]' is needed, there are {len(times)}")
    rows, in_order = ordered(path, rows, times[0])
    shown = {",": "commas", ";": "semicolons", "\t": "tabs"}[separator]
    said.insert(0, f"{len(rows)} rows of {len(header)} columns, separated by {shown}{', decimal commas' if decimal_comma else ''}")
    if not in_order:
        said.append("the rows were not in the order of time, and were sorted")
    return Understood([f"{name} [{unit}]" for name, unit, _ in header],
                      [["" if value is None else repr(value) for value in row] for _, row in rows], said)


def text_of(path):
    try:
        if required(path).stat().st_size > MOST_BYTES:
            raise SeriesError(f"{path}: larger than {MOST_BYTES >> 20} MB")
        data = bytes_of(path)
    except OSError as error:
        raise SeriesError(f"{path}: {error.strerror}") from error
    marks = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}
    try:
        text = data.decode(marks.get(data[:2], "utf-8-sig"))
    except UnicodeDecodeError as error:
        raise SeriesError(f"{path}: neither UTF-8 nor UTF-16 text (byte {error.start})") from error
    if "\0" in text:
        raise SeriesError(f"{path}: it holds a zero byte, it is no text")
    return text


def separator_of(path, lines):
    """By the header alone: in the rows a comma may be decimal."""
    number, header = lines[0]
    for separator in (";", ",", "\t"):
        if separator in header:
            return separator
    raise SeriesError(f"{path}: line {number}: '{header[:60]}' names one column; commas, semicolons or tabs separate columns")


def split(line, separator, path, number):
    try:
        return [value.strip() for value in next(csv.reader(io.StringIO(line), delimiter=separator, skipinitialspace=True, strict=True))]
    except csv.Error as error:
        raise SeriesError(f"{path}: line {number}: {error}") from error


def columns_of(path, fields, names):
    """(name, SI unit, factor) of each column, and what is to be said of them."""
    theirs = {their: our for our, their in names.items()}
    if len(theirs) != len(names):
        raise SeriesError("--map: one column of theirs is given for two of ours")
    columns, said = [], []
    for title in fields:
        found = re.fullmatch(r"(.*?)\s*[\[(]\s*(.*?)\s*[\])]", title)
        their = found.group(1) if found else title
        unit = (found.group(2) or "-") if found else None
        name = theirs.pop(title, None) or theirs.pop(their, None) or their
        if unit is None:
            raise SeriesError(f"{path}: the column '{title}' states no unit; write '{title} [m]', or what it is in")
        if unit not in UNITS:
            raise SeriesError(f"{path}: the column '{title}' is in '{unit}'; known: {', '.join(UNITS)}")
        si, factor = UNITS[unit]
        if any(name == other for other, _, _ in columns):
            raise SeriesError(f"{path}: the column '{name}' is given twice")
        if name != their or factor != 1.0:
            said.append(f"'{title}' is taken as {name} [{si}]" + (f", times {factor:g}" if factor != 1.0 else ""))
        columns.append((name, si, factor))
    if theirs:
        raise SeriesError(f"{path}: --map: there is no column {', '.join(repr(their) for their in theirs)}; there are: {', '.join(fields)}")
    return columns, said


def numbers_of(path, number, row, header, decimal_comma):
    if len(row) != len(header):
        raise SeriesError(f"{path}: line {number} has {len(row)} fields, the header {len(header)}")
    values = []
    for text, (name, _, factor) in zip(row, header):
        if not text:
            values.append(None)
            continue
        try:
            value = float(text.replace(",", ".") if decimal_comma else text) * factor
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or "_" in text:
            raise SeriesError(f"{path}: line {number}, {name}: '{text}' is not a finite number")
        values.append(value)
    return number, values


def ordered(path, rows, at):
    """The rows by ascending time, and whether they were so."""
    for number, row in rows:
        if row[at] is None:
            raise SeriesError(f"{path}: line {number} has no time")
    by_time = sorted(rows, key=lambda entry: entry[1][at])
    for (first, row), (second, after) in zip(by_time, by_time[1:]):
        if row[at] == after[at]:
            raise SeriesError(f"{path}: lines {min(first, second)} and {max(first, second)} are of the same time {row[at]:g}; "
                              "which of them counts, or their mean, is for you to say")
    return by_time, by_time == rows


def write(understood, path):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([understood.header, *understood.rows])
    write_whole(path, text.getvalue())


def names_of_map(text):
    """{"f_s": "alpha.a", ...} of "f_s=alpha.a,u_s=U.a". SeriesError for anything else."""
    names = {}
    for part in filter(None, (part.strip() for part in text.split(","))):
        our, found, their = (word.strip() for word in part.partition("="))
        if not found or not our or not their:
            raise SeriesError(f"--map: '{part}' given; expected OURS=THEIRS")
        if our in names:
            raise SeriesError(f"--map: '{our}' is given twice")
        names[our] = their
    return names
