"""What was noticed by whom: the kept results, and a section of the report made of them (compare/report/sections.py)."""

import datetime
import subprocess
from collections import Counter

from granvof_files import json_of, write_json
from mutation import listed

COLUMNS = {"unit": "unit tests", "ladder": "verification ladder", "rows": "rows of make verify"}
LONGEST_LIST = 100  # survivors in the report


def read(path):
    """{number of a fault: entry}; nothing where there is no such file. No row reaches a fault of Python, whatever an older call noted."""
    if not path.exists():
        return {}
    entries = {entry["number"]: entry for entry in json_of(path)["mutants"]}
    for entry in entries.values():
        if "rows" in entry and not listed.is_compiled(entry["file"]):
            entry["rows"] |= {"verdict": "not reached", "by": ""}
    return entries


def write(path, entries):
    write_json(path, {"mutants": list(entries)})


def commit_of(root):
    return subprocess.run(["git", "rev-parse", "--short=12", "HEAD"], cwd=root, capture_output=True, text=True).stdout.strip()


def noticed(entry, by=None):
    return any(entry[key]["verdict"] == "noticed" for key in ([by] if by else COLUMNS) if key in entry)


def survived(entry):
    """Noticed by none of those it was tried against, and both kinds of tests are among these."""
    return "unit" in entry and ("ladder" in entry) and not noticed(entry)


def answered(entries, by):
    """Those that were tried against these. Rows that do not pass the place were not tried: they are a part of all that there are."""
    return [entry for entry in entries if by in entry and (by != "rows" or entry[by]["verdict"] != "not reached")]


def share(entries, by):
    known = answered(entries, by)
    return f"{sum(noticed(entry, by) for entry in known)} of {len(known)}"


def per_cent(part, of, digits=0):
    return f" ({100 * part / of:.{digits}f} %)" if of else ""


def state(entry):
    if noticed(entry):
        return "noticed"
    if entry.get("why"):
        return "cannot be noticed"
    return "survived" if survived(entry) else "not yet tried against all"


def section(mutants, results, commit):
    """`mutants`: the list as it is now; results of faults that are no longer in it so are left out, and counted."""
    entries = [{**results[mutant.number], "why": mutant.why} for mutant in mutants if mutant.number in results]
    by_folder = {}
    for entry in entries:
        by_folder.setdefault(folder_of(entry), []).append(entry)
    states = [state(entry) for entry in entries]
    done, nobody, unseen = (states.count(kind) for kind in ("noticed", "survived", "cannot be noticed"))
    by_rows = answered(entries, "rows")
    text = [f"{len(mutants)} small faults (ci/mutants) are put into the code one at a time; {len(entries)} of them have been tried, "
            f"{len(mutants) - len(entries)} have no result{of_former_faults(mutants, results)}: "
            f"{done} were noticed{per_cent(done, len(entries) - unseen, 1)}, {nobody} by nobody, and {unanswered(entries)}, "
            f"{unseen} cannot be noticed.",
            "Each is tried against the unit tests, what survives these against the verification ladder; apart from that, "
            f"a share against the rows of make verify alone, on the runs that cost little: {share(entries, 'rows')} noticed"
            f"{per_cent(sum(noticed(entry, 'rows') for entry in by_rows), len(by_rows))}{out_of_reach(entries)}. "
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


def of_former_faults(mutants, results):
    """How many results are of a fault whose text has changed since, or that was dropped."""
    former = len(results.keys() - {mutant.number for mutant in mutants})
    return f" ({former} results are of faults whose text has changed since)" if former else ""


def unanswered(entries):
    """How many were noticed by nobody that was asked, while somebody was not asked; and who."""
    left = [entry for entry in entries if state(entry) == "not yet tried against all"]
    no_ladder = sum("unit" in entry for entry in left)
    parts = [f"{no_ladder} survived the unit tests and the ladder was not asked"] if no_ladder else []
    parts += [f"{len(left) - no_ladder} were noticed by no row and no unit test was asked"] if len(left) > no_ladder else []
    return f"{len(left)} are unanswered" + (f" ({', '.join(parts)})" if parts else "")


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
