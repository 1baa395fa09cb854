"""What was tried and held, as a section of the report (compare/report/sections.py)."""

import datetime
import subprocess

from granvof_files import write_json

LONGEST_LIST = 200  # tries that were not held, in the report


def section(counts, missed, commit, sample, to_come):
    """`counts`: (kind, what it is, tried, held, seconds, core-seconds); `missed`: (kind, try, why); `to_come`: kinds that were not tried yet."""
    tried, held = (sum(row[column] for row in counts) for column in (2, 3))
    rows = [list(row) for row in counts] + [["all", "", tried, held, *(sum(row[column] for row in counts) for column in (4, 5))]]
    text = [f"What can go wrong was tried against the built programs (ci/faults.toml{', a sample' if sample else ''}): "
            f"{held} of {tried} tries held."]
    if to_come:
        text.append(f"It was ended before these were tried: {', '.join(to_come)}.")
    tables = [{"caption": "Tried and held", "columns": ["kind", "what", "tried", "held", "s", "core-s"], "rows": rows}]
    if missed:
        tables.append({"caption": "Not held", "columns": ["kind", "try", "why"],
                       "rows": [list(row) for row in missed[:LONGEST_LIST]]})
    return {"title": "What goes wrong around a run", "text": text, "figures": [], "tables": tables, "commit": commit,
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")}


def write(directory, root, counts, missed, sample, to_come):
    commit = subprocess.run(["git", "rev-parse", "--short=12", "HEAD"], cwd=root, capture_output=True, text=True).stdout.strip()
    write_json(directory / "faults.json", section(counts, missed, commit, sample, to_come))
