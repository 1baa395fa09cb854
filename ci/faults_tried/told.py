"""What was tried and held, as a section of the report (compare/report/sections.py)."""

import datetime
import json
import subprocess

LONGEST_LIST = 200  # tries that were not held, in the report


def section(counts, missed, commit, sample):
    """`counts`: (kind, what it is, tried, held); `missed`: (kind, try, why)."""
    tried, held = (sum(row[column] for row in counts) for column in (2, 3))
    rows = [list(row) for row in counts] + [["all", "", tried, held]]
    text = [f"What can go wrong was tried against the built programs (ci/faults.toml{', a sample' if sample else ''}): "
            f"{held} of {tried} tries held."]
    tables = [{"caption": "Tried and held", "columns": ["kind", "what", "tried", "held"], "rows": rows}]
    if missed:
        tables.append({"caption": "Not held", "columns": ["kind", "try", "why"],
                       "rows": [list(row) for row in missed[:LONGEST_LIST]]})
    return {"title": "What goes wrong around a run", "text": text, "figures": [], "tables": tables, "commit": commit,
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")}


def write(directory, root, counts, missed, sample):
    commit = subprocess.run(["git", "rev-parse", "--short=12", "HEAD"], cwd=root, capture_output=True, text=True).stdout.strip()
    directory.mkdir(parents=True, exist_ok=True)
    draft = directory / "faults.json.tmp"
    draft.write_text(json.dumps(section(counts, missed, commit, sample), indent=1) + "\n", encoding="utf-8")
    draft.rename(directory / "faults.json")
