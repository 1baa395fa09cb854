"""What was noticed by whom: the kept results, and a section of the report made of them (compare/report/sections.py)."""

import datetime
import subprocess
from collections import Counter

from granvof_files import json_of, write_json

COLUMNS = {"unit": "unit tests", "ladder": "verification ladder", "rows": "rows of make verify"}
LONGEST_LIST = 100  # survivors in the report


def read(path):
    """{number of a fault: entry}; nothing where there is no such file."""
    if not path.exists():
        return {}
    return {entry["number"]: entry for entry in json_of(path)["mutants"]}


def write(path, entries):
    write_json(path, {"mutants": list(entries)})


def commit_of(root):
    return subprocess.run(["git", "rev-parse", "--short=12", "HEAD"], cwd=root, capture_output=True, text=True).stdout.strip()


def tried(entry, by=None):
    return any(key in entry for key in ([by] if by else COLUMNS))


def noticed(entry, by=None):
    return any(entry[key]["verdict"] == "noticed" for key in ([by] if by else COLUMNS) if key in entry)


def survived(entry):
    """Noticed by none of those it was tried against, and both kinds of tests are among these."""
    return "unit" in entry and ("ladder" in entry) and not noticed(entry)


def share(entries, by=None):
    known = [entry for entry in entries if tried(entry, by)]
    return f"{sum(noticed(entry, by) for entry in known)} of {len(known)}"


def state(entry):
    if noticed(entry):
        return "noticed"
    if entry.get("why"):
        return "cannot be noticed"
    return "survived" if survived(entry) else "not yet tried against all"


def section(mutants, results, commit):
    """`mutants`: the list as it is now; results of faults that are no longer in it are left out."""
    entries = [{**results[mutant.number], "why": mutant.why} for mutant in mutants if mutant.number in results]
    by_folder = {}
    for entry in entries:
        by_folder.setdefault(folder_of(entry), []).append(entry)
    states = [state(entry) for entry in entries]
    done, nobody, unseen = (states.count(kind) for kind in ("noticed", "survived", "cannot be noticed"))
    of = len(entries) - unseen
    text = [f"{len(mutants)} small faults (ci/mutants) are put into the code one at a time; {len(entries)} of them have been tried: "
            f"{done} were noticed" + (f" ({100 * done / of:.1f} %)" if of else "")
            + f", {nobody} by nobody, {of - done - nobody} are not yet tried against all, {unseen} cannot be noticed.",
            "Each is tried against the unit tests, what survives these against the verification ladder; apart from that, "
            f"a share against the rows of make verify alone, on the runs that cost little: {share(entries, 'rows')} noticed"
            f"{out_of_reach(entries)}. "
            "Where a fault was noticed, those that come after it in the order were not asked." + of_other_commits(entries, commit)]
    columns = ["folder", "faults", *COLUMNS.values(), "noticed", "survived", "cannot be noticed"]
    rows = []
    for folder, members in sorted(by_folder.items()) + [("all", entries)]:
        states = [state(entry) for entry in members]
        rows.append([folder, len(members), *(share(members, by) for by in COLUMNS), states.count("noticed"),
                     states.count("survived"), states.count("cannot be noticed")])
    tables = [{"caption": "Faults noticed, of those tried, by whom", "columns": columns, "rows": rows}]
    left = [[entry["file"], entry["name"], f"{entry['was']} → {entry['now']}", entry.get("why", "") or state(entry)]
            for entry in entries if state(entry) != "noticed"]
    if left:
        tables.append({"caption": "Not noticed", "columns": ["file", "fault", "change", "why"], "rows": left[:LONGEST_LIST]})
    found = [[entry["file"], entry["name"], f"{entry['was']} → {entry['now']}", *(by_whom(entry, key) for key in COLUMNS)]
             for entry in entries if noticed(entry)]
    if found:
        tables.append({"caption": "Noticed by whom", "columns": ["file", "fault", "change", *COLUMNS.values()], "rows": found})
    return {"title": "Faults that would be noticed", "text": text, "figures": [], "tables": tables, "commit": commit,
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")}


def out_of_reach(entries):
    """Of the rows: how many faults stand where none of them passes, and in which folders, of those that none reaches at all."""
    missed = [folder_of(entry) for entry in entries if entry.get("rows", {}).get("verdict") == "not reached"]
    met = {folder_of(entry) for entry in entries if entry.get("rows", {}).get("verdict", "not reached") != "not reached"}
    if not missed:
        return ""
    never = sorted(set(missed) - met)
    return f"; {len(missed)} more stand where no row of these runs passes" + (f" (none passes {', '.join(never)})" if never else "")


def folder_of(entry):
    return "/".join(entry["file"].split("/")[:2])


def of_other_commits(entries, commit):
    """A sentence, where not all was tried on one commit."""
    others = Counter(entry[by].get("commit", entry.get("commit", "")) for entry in entries for by in COLUMNS if by in entry)
    others.pop(commit, None)
    return f" Not all on this commit: {', '.join(f'{n} of the trials on {name}' for name, n in others.most_common())}." if others else ""


def by_whom(entry, key):
    if key not in entry:
        return "–"
    return entry[key]["by"] if entry[key]["verdict"] == "noticed" else entry[key]["verdict"]


def score_lines(mutants, results):
    """For the terminal."""
    shown = section(mutants, results, "")
    table = shown["tables"][0]
    widths = [max(len(str(row[i])) for row in [table["columns"], *table["rows"]]) for i in range(len(table["columns"]))]
    lines = ["  ".join(f"{str(cell):<{width}}" for cell, width in zip(row, widths)).rstrip()
             for row in [table["columns"], *table["rows"]]]
    return lines + shown["text"][:1]
