"""Reads compare/stability.toml: scenes, methods, axes. Anything it does not know is an error that names it."""

from dataclasses import dataclass, field
from pathlib import Path

from granvof_files import toml_of


class TableError(Exception):
    """Bad input; its text is the one line for the user."""


@dataclass
class SceneEntry:
    name: str
    case: Path
    compare: dict  # column of series.csv -> largest difference from the run at half the step, in the column's unit
    set: list = field(default_factory=list)
    allow: list = field(default_factory=list)  # as of its axes and points, for all of them


@dataclass
class Axis:
    name: str
    scene: SceneEntry
    unit: str
    nominal: float
    assign: list  # overrides, "{}" stands for the value
    low: float | None = None
    high: float | None = None
    scale: str = "log"
    values: list | None = None  # the only values there are, in order
    set: list = field(default_factory=list)  # overrides that go with the axis
    allow: list = field(default_factory=list)  # monitors whose warning is what the point is about
    note: str = ""
    known: list = field(default_factory=list)  # methods whose answer depends on the step unseen, as is known

    def overrides(self, value):
        return self.scene.set + self.set + [text.replace("{}", f"{value:.6g}") for text in self.assign]


@dataclass
class Point:
    name: str
    scene: SceneEntry
    set: list
    allow: list = field(default_factory=list)
    note: str = ""
    known: list = field(default_factory=list)


@dataclass
class Table:
    methods: dict  # name -> overrides
    axes: list
    points: list
    bisections: int


def need(entry, key, where, kind):
    if key not in entry:
        raise TableError(f"{where}: {key} is missing")
    if not isinstance(entry[key], kind) or isinstance(entry[key], bool):
        raise TableError(f"{where}: {key} = {entry[key]!r} given")
    return entry[key]


def refuse_unknown(entry, known, where):
    for key in entry:
        if key not in known:
            raise TableError(f"{where}: unknown key {key}; known: {', '.join(known)}")


def read_axis(entry, scenes, path):
    where = f"{path}: axis {entry.get('name', '?')}"
    refuse_unknown(entry, ["name", "scene", "unit", "nominal", "assign", "low", "high", "scale", "values", "set", "allow",
                           "note", "known"], where)
    scene = need(entry, "scene", where, str)
    if scene not in scenes:
        raise TableError(f"{where}: scene {scene} given; there are {', '.join(scenes)}")
    axis = Axis(need(entry, "name", where, str), scenes[scene], entry.get("unit", "-"),
                float(need(entry, "nominal", where, (int, float))), need(entry, "assign", where, list), entry.get("low"),
                entry.get("high"), entry.get("scale", "log"), entry.get("values"), entry.get("set", []),
                scenes[scene].allow + entry.get("allow", []), entry.get("note", ""), entry.get("known", []))
    if axis.values is not None:
        if axis.nominal not in axis.values or sorted(axis.values) != axis.values:
            raise TableError(f"{where}: values must ascend and hold the nominal one")
        axis.low, axis.high = axis.values[0], axis.values[-1]
    if axis.low is None and axis.high is None:
        raise TableError(f"{where}: neither low nor high")
    if axis.scale not in ("log", "linear"):
        raise TableError(f"{where}: scale = {axis.scale!r} given; log or linear")
    for bound, wrong in ((axis.low, lambda b: b > axis.nominal), (axis.high, lambda b: b < axis.nominal)):
        if bound is not None and (wrong(bound) or (axis.scale == "log" and bound <= 0)):
            raise TableError(f"{where}: low, nominal and high must ascend (and be > 0 on a log scale)")
    return axis


def read(path):
    """The table of a file; TableError, one line, for whatever is wrong with it."""
    try:
        return read_data(toml_of(path), path)
    except (OSError, ValueError, TypeError, AttributeError) as error:  # a value of another kind than it is taken for
        raise TableError(f"{path}: {' '.join(str(error).split())}") from error


def read_data(data, path):
    refuse_unknown(data, ["bisections", "methods", "scene", "axis", "point"], path)
    scenes = {}
    for name, entry in data.get("scene", {}).items():
        refuse_unknown(entry, ["case", "compare", "set", "allow"], f"{path}: scene {name}")
        case = path.parent / need(entry, "case", f"{path}: scene {name}", str)
        if not case.exists():
            raise TableError(f"{path}: scene {name}: there is no {case}")
        scenes[name] = SceneEntry(name, case, need(entry, "compare", f"{path}: scene {name}", dict),
                                  entry.get("set", []), entry.get("allow", []))
    points = []
    for entry in data.get("point", []):
        where = f"{path}: point {entry.get('name', '?')}"
        refuse_unknown(entry, ["name", "scene", "set", "allow", "note", "known"], where)
        scene = need(entry, "scene", where, str)
        if scene not in scenes:
            raise TableError(f"{where}: scene {scene} given; there are {', '.join(scenes)}")
        points.append(Point(need(entry, "name", where, str), scenes[scene], need(entry, "set", where, list),
                            scenes[scene].allow + entry.get("allow", []), entry.get("note", ""), entry.get("known", [])))
    axes = [read_axis(entry, scenes, path) for entry in data.get("axis", [])]
    if not axes and not points:
        raise TableError(f"{path}: there is no [[axis]] and no [[point]]")
    return Table(data.get("methods", {}), axes, points,
                 int(data.get("bisections", 4)))
