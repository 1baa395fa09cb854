"""What the page says first: one line a scene and quantity, what fails by its cause, and the rest by scene."""

from pathlib import Path

from granvof_files import json_of
from report import figures

# The worst first.
ORDER = ["error", "differs", "stale", "not run", "expected failure", "within band", "reported only", "agrees"]
GOOD = ("agrees", "within band", "reported only")
AGAINST = ("DEM", "published", "theory")
CURVE = "_curve"  # how the metric of a whole curve is called, beside that of its instants
DETAILS = ("solid_volume", "energy_share", "power")  # judged against DEM too, but nobody decides on a scene by them
IN_HEIGHTS = ("run_out", "run_out_dense", "run_out_quantile")  # lengths over h0


def of_interest(row):
    """Whether a row tells how right a quantity is: not whether something is conserved, bounded, or as it was before."""
    if row["reference_kind"] in ("DEM", "published"):
        return True
    bounded = row["tolerance"].startswith(("at most", "at least"))
    return row["reference_kind"] == "theory" and not bounded and bool(row["reference"])


def quantity_of(row):
    return row.get("quantity") or row["metric"].split("@")[0]


def unit_of(row):
    return "h0" if quantity_of(row).removesuffix(CURVE) in IN_HEIGHTS and row["unit"] == "-" else row["unit"]


def tolerance_of(rows):
    """What rows may be off by: the tolerances stated, and the largest band of their references."""
    found = {row["tolerance"].replace(f" [{row['unit']}]", f" {unit_of(row)}").removesuffix(" -") for row in rows}
    bands = [row["band"] for row in rows if row.get("band")]
    return ", ".join(sorted(found) + ([f"band {short(max(bands))} {unit_of(rows[0])}".removesuffix(" -")] if bands else []))


def agreeing(rows):
    return sum(row["verdict"] in ("agrees", "within band") for row in rows)


def error_of(rows):
    """The range of the errors of rows, relative in %, or in the unit where a reference is 0; nothing where none was judged."""
    judged = [row for row in rows if row["value"] is not None and row["reference"] is not None]
    if not judged:
        return None
    if any(row["reference"] == 0 for row in judged):
        return f"{short(max(abs(row['value'] - row['reference']) for row in judged))} {unit_of(judged[0])}".removesuffix(" -")
    errors = [100 * abs(row["value"] / row["reference"] - 1) for row in judged]
    low, high = short(min(errors)), short(max(errors))
    return f"{high} %" if low == high else f"{low} to {high} %"


def short(value):
    """Two figures, without an exponent."""
    return f"{float(f'{value:.2g}'):.6g}"


def worst(rows):
    return min((row["verdict"] for row in rows), key=ORDER.index)


def at_a_glance(results, plots):
    """One entry a run and quantity that something else than this code is a reference of; a curve stands for its instants."""
    groups = {}
    for row in results.rows:
        if of_interest(row):
            groups.setdefault((row["scene"], quantity_of(row).removesuffix(CURVE)), []).append(row)
    lines = []
    for (run, quantity), of_all in groups.items():
        case = results.runs.get(run, {}).get("case", run)
        curves = [row for row in of_all if quantity_of(row).endswith(CURVE) and row["value"] is not None]
        rows = curves or of_all
        instants = [row for row in of_all if not quantity_of(row).endswith(CURVE)] if curves else []
        lines.append({
            "run": run, "case": case, "quantity": quantity, "errors": {}, "verdict": worst(rows), "tolerance": tolerance_of(rows),
            "agree": agreeing(rows), "rows": len(rows),
            "instants": f"{agreeing(instants)} of {len(instants)} instants agree" if instants else "",
            "unexpected": any(row["unexpected"] for row in of_all), "cost_ratio": cost_ratio(results, run),
            "plot": figures.plot_of(run, case, quantity, plots),
            "causes": sorted({cause_of(row) for row in rows if row["verdict"] == "expected failure"})})
        for kind in AGAINST:
            lines[-1]["errors"][kind] = error_of([row for row in rows if row["reference_kind"] == kind])
        lines[-1]["decides"] = decides(lines[-1], rows)
    first, quantities = {}, {}
    for place, row in enumerate(results.rows):
        first.setdefault(results.runs.get(row["scene"], {}).get("case", row["scene"]), place)
        quantities.setdefault(quantity_of(row).removesuffix(CURVE), place)
    # Cases in the order of the table; of a case first what DEM judges, and of a quantity all presets.
    return sorted(lines, key=lambda line: (first[line["case"]], line["errors"]["DEM"] is None, quantities[line["quantity"]],
                                           line["run"] != line["case"], line["run"]))


def decides(line, rows):
    """Whether a line belongs to what is seen first: judged, by beads or a published series, in what a scene is asked for."""
    return (any(row["reference_kind"] in ("DEM", "published") and row["asserted"] for row in rows)
            and line["quantity"].split("-")[0] not in DETAILS)


def cost_ratio(results, run):
    """Core-seconds of the DEM-VOF record of a run over its own; nothing where one is not known."""
    ours = results.runs.get(run, {}).get("numbers", {}).get("core_seconds")
    theirs = []
    for record in results.records.get(results.record_of(run), {}).values():
        try:
            theirs.append(json_of(Path(record["directory"]) / "record.json")["core_seconds"])
        except (OSError, ValueError, KeyError, TypeError):
            continue
    return sum(theirs) / len(theirs) / ours if ours and theirs else None


def cause_of(row):
    return row.get("expected_failure", {}).get("cause") or "not-stated"


def by_cause(results):
    """Expected failures under what they have in common: [{"key", "text", "rows"}], the most first."""
    groups = {}
    for row in results.rows:
        if row["verdict"] == "expected failure":
            groups.setdefault(cause_of(row), []).append(row)
    found = [{"key": key, "text": results.causes.get(key, "No cause is stated."), "rows": rows} for key, rows in groups.items()]
    return sorted(found, key=lambda group: -len(group["rows"]))


def by_scene(results):
    """All rows under their case: [{"case", "rows", "counts", "open"}]; open where something does not agree."""
    groups = {}
    for row in results.rows:
        groups.setdefault(results.runs.get(row["scene"], {}).get("case", row["scene"]), []).append(row)
    found = []
    for case, rows in groups.items():
        counts = [(verdict, sum(row["verdict"] == verdict for row in rows)) for verdict in ORDER]
        found.append({"case": case, "counts": [(verdict, count) for verdict, count in counts if count],
                      "rows": sorted(rows, key=lambda row: (not row["unexpected"], ORDER.index(row["verdict"]))),
                      "open": any(row["verdict"] not in GOOD for row in rows)})
    return found
