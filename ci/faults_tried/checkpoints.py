"""Checkpoints that another program might have written, whole and sealed: of another format, with other fields; and cut at a border."""

import h5py
import numpy as np

from faults_tried.runs import SmallRun, crashed, not_refused, tree_of

SEAL = "granvof checkpoint {:016x}\n"
WORD = (1 << 64) - 1


def fnv1a(content):
    """64-bit FNV-1a (http://www.isthe.com/chongo/tech/comp/fnv/)."""
    value = 0xcbf29ce484222325
    for byte in content:
        value = ((value ^ byte) * 0x100000001b3) & WORD
    return value


def sealed_anew(path):
    """Whatever was changed within, the seal is right again."""
    content = path.read_bytes()
    at = content.rfind(b"granvof checkpoint ")
    content = content[:at] if at >= 0 and at >= len(content) - len(SEAL.format(0)) else content
    path.write_bytes(content + SEAL.format(fnv1a(content)).encode())


def replaced(group, name, value):
    del group[name]
    group[name] = value


def members(file):
    """(group, name) of every array, scalar and counter."""
    for name in file["arrays"]:
        yield "arrays", name
    for kind in ("scalars", "counters"):
        for name in file[kind].attrs:
            yield kind, name


def array_changes(name):
    yield f"array {name} missing", lambda file: file["arrays"].pop(name)
    yield f"array {name} a value shorter", lambda file: replaced(file["arrays"], name, file["arrays"][name][:-1])
    yield f"array {name} a value longer", lambda file: replaced(file["arrays"], name, np.append(file["arrays"][name], 0.0))
    # these two a run starts from, and ends at once: the alarm of its own is asked in test_run_case
    yield f"array {name} not a number", lambda file: replaced(file["arrays"], name, np.full(file["arrays"][name].shape, np.nan))
    yield f"array {name} infinite", lambda file: replaced(file["arrays"], name, np.full(file["arrays"][name].shape, np.inf))
    yield f"array {name} of words", lambda file: replaced(file["arrays"], name, "words")
    yield f"array {name} a group", lambda file: replaced_by_group(file["arrays"], name)


def replaced_by_group(group, name):
    del group[name]
    group.create_group(name)


def attribute_changes(kind, name):
    yield f"{kind} {name} missing", lambda file: file[kind].attrs.pop(name)
    yield f"{kind} {name} a word", lambda file: file[kind].attrs.__setitem__(name, "word")
    yield f"{kind} {name} a list", lambda file: file[kind].attrs.__setitem__(name, [1.0, 2.0])
    if kind == "scalars":
        yield f"{kind} {name} not a number", lambda file: file[kind].attrs.__setitem__(name, float("nan"))


def file_changes(file):
    """Of what stands above all of them."""
    for value in (0, 1, 2, 4, 99, -1, 2**62):
        yield f"format {value}", lambda file, value=value: file.attrs.__setitem__("format_version", value)
    yield "format a word", lambda file: file.attrs.__setitem__("format_version", "3")
    for name in file.attrs:
        yield f"no {name}", lambda file, name=name: file.attrs.pop(name)
    yield "another number of cells", lambda file: file.attrs.__setitem__("cells", np.array(file.attrs["cells"]) + 1)
    yield "cells of two directions", lambda file: file.attrs.__setitem__("cells", np.array(file.attrs["cells"])[:2])
    for value in (float("nan"), -1.0, 1e300):
        yield f"time {value}", lambda file, value=value: file.attrs.__setitem__("time", value)
    for value in (-1, 0, 10**9):
        yield f"rows {value}", lambda file, value=value: file.attrs.__setitem__("rows", value)
    for group in ("arrays", "scalars", "counters"):
        yield f"no {group}", lambda file, group=group: file.pop(group)
    yield "one array more", lambda file: file["arrays"].__setitem__("of_another_program", np.zeros(8))
    yield "one scalar more", lambda file: file["scalars"].attrs.__setitem__("of_another_program", 1.0)
    yield "one counter more", lambda file: file["counters"].attrs.__setitem__("of_another_program", 1)


def changes_of(path):
    with h5py.File(path, "r") as file:
        yield from list(file_changes(file))
        for kind, name in members(file):
            yield from array_changes(name) if kind == "arrays" else attribute_changes(kind, name)


def borders_of(path):
    """Where something ends in the file: each array, and what comes before the first and after the last."""
    with h5py.File(path, "r") as file:
        ends = {0, 8, 96}
        for values in file["arrays"].values():
            at = values.id.get_offset()
            if at is not None:
                ends |= {at, at + values.id.get_storage_size()}
    size = path.stat().st_size
    return sorted(end for end in ends | {size - len(SEAL.format(0)), size - 1} if end < size)


def ended_at_once(ended):
    """Why a state that is not finite is not named; values that nobody reads again (what a field holds where it has no meaning) may go on."""
    if why := crashed(ended):
        return why
    return "" if ended.returncode == 0 or (ended.returncode in (1, 2) and b"finite" in ended.stderr) else f"exit code {ended.returncode}: {ended.stderr[-150:]!r}"


def odd_checkpoints(bench, entry):
    """A checkpoint of another program, or cut between two of its parts: `--resume` refuses it, and the run stays as it was."""
    run = SmallRun(bench, entry)
    original = run.partial(bench.place()) / "checkpoint.h5"
    tries = [(name, change, None) for name, change in changes_of(original)]
    tries += [(f"cut at byte {end}{', and sealed' if seal else ''}", None, (end, seal)) for end in borders_of(original) for seal in (False, True)
              if not seal or end < original.stat().st_size - len(SEAL.format(0))]
    for name, change, cut in bench.some(tries, entry["sample"]):
        out = run.partial(bench.place())
        path = out / "checkpoint.h5"
        if change:
            with h5py.File(path, "r+") as file:
                change(file)
        else:
            path.write_bytes(path.read_bytes()[:cut[0]])
        if change or cut[1]:
            sealed_anew(path)
        before = tree_of(out)
        ended = run.go(out, "--resume", patience=60.0)
        if name.startswith("array") and name.endswith(("not a number", "infinite")):
            why = ended_at_once(ended)
        elif ended is not None and ended.returncode == 0 and not name.endswith("more"):
            why = run.same_bytes(out)  # what it says is nowhere used
        else:
            why = not_refused(ended, before, out)
        yield name, why
        bench.drop(out)
