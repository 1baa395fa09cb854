"""Results of `make verify` that are kept in the repository: what README and docs/results.md state, and nothing else does."""

import json

from granvof_files import json_of, write_whole
from report import results

ROW = ("id", "scene", "metric", "value", "unit", "reference", "reference_kind", "reference_source", "tolerance", "verdict",
       "unexpected", "asserted", "frequency", "note", "distance")
FREQUENCIES = ("short", "verify", "nightly", "weekly")
COST = "core-s"


def slim(found, run_facts):
    """What is kept of a row of results.json."""
    row = {key: found[key] for key in ROW}
    row["reason"] = found.get("expected_failure", {}).get("reason", "")
    return row | made_by(run_facts)


def made_by(run):
    return {"version": run.get("version", ""), "commit": run.get("commit", ""), "date": run.get("date", "")[:10]}


def kept_of(verified):
    """The kept form of what `granvof-compare check` wrote (its results.json, read). Rows that judge a cost are left out: a cost
    is that of a machine."""
    runs = {run["id"]: run for run in verified["runs"]}
    rows = [slim(row, runs.get(row["scene"], {})) for row in verified["results"] if row["unit"] != COST]
    costs = {name: {"core_seconds": run["numbers"]["core_seconds"]} | made_by(run) for name, run in runs.items()
             if run.get("numbers", {}).get("core_seconds") is not None}
    return {"rows": rows, "costs": costs}


def merged(kept, verified):
    """`kept` with the newer results in place of the older. What was not due this time stays as it was; a row that was due and
    is not there is gone. A row without a value gives way to nothing: what was measured before does not speak for it."""
    new = kept_of(verified)
    due = FREQUENCIES[:FREQUENCIES.index(verified["frequency"]) + 1]
    old = [row for row in kept["rows"] if row["frequency"] not in due]
    return {"rows": new["rows"] + old, "costs": kept["costs"] | new["costs"]}


def read(path):
    return json_of(path) if path.exists() else {"rows": [], "costs": {}}


def write(path, kept):
    """One row a line: a change of one result is a change of one line."""
    rows = ",\n".join(json.dumps(row, separators=(",", ":")) for row in kept["rows"])
    costs = ",\n".join(f"{json.dumps(name)}:{json.dumps(cost, separators=(',', ':'))}"
                       for name, cost in sorted(kept["costs"].items()))
    write_whole(path, f'{{"rows":[\n{rows}\n],\n"costs":{{\n{costs}\n}}}}\n')


def due(kept, frequency):
    """Rows that are kept and due at a frequency, by id; and the versions that made them."""
    rows = {row["id"]: row for row in kept["rows"] if row["frequency"] in FREQUENCIES[:FREQUENCIES.index(frequency) + 1]}
    made = sorted({(row["date"], f"{row['version']} ({row['commit']})") for row in rows.values() if row.get("commit")})
    return rows, made[-1] if made else ("", "")


def moved(kept, verified, relative=5e-3):
    """Rows of `verified` that no longer say what is kept of them, as (row, kept row): another verdict, or a value that moved by
    more than its last figure shown. Of what is not kept nothing is stated, so that nothing can be wrong; what was left out by
    name this time (the canary's record in a nightly run, which has a stage of its own for it) says nothing either."""
    before = {row["id"]: row for row in kept["rows"]}
    pairs = [(row, before[row["id"]]) for row in kept_of(verified)["rows"]
             if row["id"] in before and (row["verdict"] != "not run" or row["unexpected"])]
    return [(row, old) for row, old in pairs if old["verdict"] != row["verdict"] or
            (results.moved(old["value"], row["value"], relative) and results.matters(row))]
