"""Fields that another code has written, and that mean nothing: each of their scalars would be a number all the same."""

import shutil

import h5py
import numpy as np

from faults_tried.bench import TableError, listed, refused
from faults_tried.runs import SmallRun


def value(name, of_all):
    def way(file):
        file["t0001"][name][...] = of_all
    return way


def time(at):
    def way(file):
        file["t0001"].attrs["time"] = at
    return way


def attribute(name, given):
    def way(file):
        file.attrs[name] = given
    return way


def dataset(name, make):
    """The dataset in another form."""
    def way(file):
        group = file["t0001"]
        values = group[name][...]
        del group[name]
        made = make(values)
        if made is not None:
            group[name] = made
    return way


def a_later_time_first(file):
    file["t0000"].attrs["time"] = 9e9


def no_instants(file):
    for name in list(file):
        del file[name]


def a_gap(file):
    file.move("t0001", "t0007")


def another_group(file):
    file.create_group("mine")


def a_dataset_for_an_instant(file):
    del file["t0001"]
    file["t0001"] = np.zeros(3)


def without_end(file):
    """A size that no memory holds, and that takes no room on the disk."""
    del file["t0001/f_s"]
    file["t0001"].create_dataset("f_s", shape=(1 << 20, 1 << 20, 4), chunks=(1, 1024, 4), dtype="f4")


def values_elsewhere(file):
    shape = file["t0001/f_s"].shape
    del file["t0001/f_s"]
    file["t0001"].create_dataset("f_s", shape=shape, dtype="f4", external=[("/etc/hostname", 0, h5py.h5f.UNLIMITED)])


WAYS = {"more solid than there is room": value("f_s", 2.0), "less solid than none": value("f_s", -0.2), "more liquid than there is room": value("alpha", 5.0),
        "less liquid than none": value("alpha", -1.0), "no numbers": value("u_c", np.nan), "no numbers of the solid": value("f_s", np.nan), "a speed without end": value("u_s", np.inf),
        "a time that is none": time(np.nan), "a time before the start": time(-1.0), "a time twice": time(0.0), "a later time first": a_later_time_first,
        "a time in words": time("soon"), "two times": time([0.1, 0.2]), "no cells": attribute("cells", [0, 0, 0]), "cells below none": attribute("cells", [-1, 1, 1]),
        "cells without end": attribute("cells", [2**31 - 1] * 3), "cells of two directions": attribute("cells", [40, 16]), "cells in words": attribute("cells", "many"),
        "half a cell": attribute("cells", [40.5, 16.0, 1.0]), "no spacing": attribute("spacing", [0.0] * 3), "a spacing that is none": attribute("spacing", [np.nan] * 3),
        "another box": attribute("spacing", [1.0] * 3), "cells in another order": dataset("f_s", np.transpose), "liquid in another order": dataset("alpha", np.transpose),
        "cells in a row": dataset("f_s", np.ravel), "no values": dataset("f_s", lambda values: values[:0]), "one value": dataset("f_s", lambda values: 0.5),
        "no dataset": dataset("f_s", lambda values: None), "words": dataset("f_s", lambda values: np.full(values.shape, b"x")),
        "complex numbers": dataset("f_s", lambda values: values.astype("c8")), "two components": dataset("u_s", lambda values: values[..., :2]),
        "a link to itself": dataset("f_s", lambda values: h5py.SoftLink("/t0001/f_s")), "a link to a device": dataset("f_s", lambda values: h5py.ExternalLink("/dev/zero", "/x")),
        "no instants": no_instants, "a gap": a_gap, "another group": another_group, "a dataset for an instant": a_dataset_for_an_instant, "without end": without_end,
        "values elsewhere": values_elsewhere}


def fields_of_others(bench, entry):
    """Fields without a meaning, laid beside a run or made a series: refused."""
    run = SmallRun(bench, entry)
    sets = [word for given in entry["set"] for word in ("--set", given)]
    tries = [(command, *way) for command in entry["commands"] for way in listed(entry, "ways", WAYS)]
    plain = bench.call(commanded(bench, entry["commands"][0], run.whole / "fields.h5", bench.place(), run, sets))
    if plain is None or plain.returncode != 0:
        raise TableError(f"fields that are sound are refused: {plain and plain.stderr[-200:]!r}")
    for command, name, way in bench.some(tries, entry["sample"]):
        place = bench.place()
        shutil.copy(run.whole / "fields.h5", place / "theirs.h5")
        with h5py.File(place / "theirs.h5", "r+") as file:
            way(file)
        why = refused(bench.call(commanded(bench, command, place / "theirs.h5", place, run, sets)))
        yield f"{' '.join(command[:2])}: {name}", why or ("something was written" if (place / "out").exists() else "")
        bench.drop(place / "any")


def commanded(bench, command, fields, place, run, sets):
    return [word for part in bench.filled(command, fields=fields, out=place / "out", run=run.whole) for word in (sets if part == "SETS" else [part])]
