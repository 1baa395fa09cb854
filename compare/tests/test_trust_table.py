"""The tables of README.md, docs/results.md and docs/gallery.md, from made-up results; and those of the repository from what is kept."""

import json
import tomllib

import pytest
from PIL import Image
from report import kept_results, trust_table
from report.trust_table import LINES, PRESETS, WORST

RECORD = 2500  # core-seconds of the records of s1, to two digits
RUN = {"id": "s1", "version": "0.2.0", "commit": "abc", "date": "2026-01-02T03:04:05Z", "numbers": {"core_seconds": 2.25}}


def verified(rows, frequency="verify", runs=(RUN,)):
    return {"date": "2026-01-02", "frequency": frequency, "runs": list(runs), "results": rows}


@pytest.fixture
def rows(make_row):
    at = {2: (0.321, "agrees"), 5: (1.312, "within band"), 8: (1.98, "expected failure")}
    return [make_row(id=f"s1.run_out@{t}.DEM", metric=f"run_out@{t}", value=value, verdict=verdict, unexpected=False,
                     **({"expected_failure": {"reason": "runs on", "distance": 0.5}} if verdict == "expected failure" else {}))
            for t, (value, verdict) in at.items()]


@pytest.fixture
def root(tmp_path):
    """A repository that holds only the files with tables."""
    for file, tables in trust_table.TABLES.items():
        (tmp_path / file).parent.mkdir(exist_ok=True)
        markers = "\n".join(f"<!-- {name}: made by compare/report/trust_table.py -->\n<!-- end of {name} -->" for name in tables)
        (tmp_path / file).write_text(f"before\n{markers}\nafter\n")
    for name in ("compare", "cases"):
        (tmp_path / name).mkdir()
    (tmp_path / "compare/checks.toml").write_text('[[run]]\nid = "s1"\n[[run]]\nid = "s1-advised"\nbeside = "s1"\n')
    (tmp_path / "cases/s1.toml").write_text('[scene]\nname = "s1"\ntitle = "A low column"\n')
    return tmp_path


def keep(root, content):
    (root / "verify").mkdir(exist_ok=True)
    (root / "verify/results.json").write_text(json.dumps(content))
    return trust_table.main(["--root", str(root), "--verify", str(root / "verify")])


def test_the_table_says_value_reference_and_how_many_agree(root, rows):
    assert keep(root, verified(rows)) == 0
    text = (root / "README.md").read_text()
    assert text.startswith("before\n") and text.endswith("after\n")
    line = next(line for line in text.splitlines() if "run-out of S1" in line)
    assert f"| 0.321 / 1.31 / 1.98 (2 of 3) | 1.5 ± 0.05 | DEM | 2.2; {RECORD} |" in line
    assert "0.2.0 (abc), 2026-01-02" in text
    assert "No result is kept for: run-out of S2" in text


def test_presets_stand_beside_each_other(root, rows):
    advised = [row | {"id": f"advised {row['id']}", "scene": "s1-advised", "value": row["value"] - 0.3} for row in rows]
    advised[2] |= {"unexpected": True}
    cost = RUN | {"id": "s1-advised", "numbers": {"core_seconds": 3.1}}
    keep(root, verified([*rows, *advised], runs=[RUN, cost]))
    text = (root / "README.md").read_text()
    assert "| what | paper | advised | reference | kind | core-seconds: paper / advised; demvof |" in text
    assert f"| 0.321 / 1.31 / 1.98 (2 of 3) | 0.021 / 1.01 / 1.68 (2 of 3, unexpected) | 1.5 ± 0.05 | DEM | 2.2 / 3.1; {RECORD} |" in text


def test_what_does_not_agree_stands_with_its_reason(root, rows):
    keep(root, verified(rows))
    text = (root / "docs/results.md").read_text()
    assert "**s1**, run_out@8 (expected failure; off by 0.45 beyond the tolerance): runs on" in text
    assert "run_out@2 (" not in text
    assert "| s1 | 2.2 | 0.2.0 (abc), 2026-01-02 |" in text


def test_writing_twice_changes_nothing(root, rows):
    keep(root, verified(rows))
    before = (root / "README.md").read_text()
    assert trust_table.main(["--root", str(root)]) == 0
    assert (root / "README.md").read_text() == before
    assert trust_table.main(["--root", str(root), "--check"]) == 0


def test_a_figure_typed_by_hand_is_seen(root, rows, capsys):
    keep(root, verified(rows))
    readme = root / "README.md"
    readme.write_text(readme.read_text().replace("1.31", "1.21"))
    assert trust_table.main(["--root", str(root), "--check"]) == 1
    assert "README.md" in capsys.readouterr().out
    assert "1.21" in readme.read_text(), "a check writes nothing"


@pytest.mark.parametrize("change, code", [({}, 0), ({"value": 1.3125}, 0), ({"value": 1.34}, 1), ({"verdict": "differs"}, 1)])
def test_results_that_moved_are_named(root, rows, capsys, change, code):
    keep(root, verified(rows))
    moved = [row | (change if row["metric"] == "run_out@5" else {}) for row in rows]
    (root / "verify/results.json").write_text(json.dumps(verified(moved)))
    assert trust_table.main(["--root", str(root), "--check", "--verify", str(root / "verify")]) == code
    assert ("s1.run_out@5.DEM: kept 1.31" in capsys.readouterr().out) == bool(code)


@pytest.mark.parametrize("unexpected, moved", [(False, 0), (True, 1)])
def test_what_was_left_out_by_name_has_not_moved(make_row, unexpected, moved):
    kept = kept_results.kept_of(verified([make_row(id="canary", verdict="agrees", value=0.0)]))
    now = verified([make_row(id="canary", verdict="not run", value=None, unexpected=unexpected)])
    assert len(kept_results.moved(kept, now)) == moved


def test_a_shorter_comparison_leaves_what_was_not_due(root, rows):
    night = rows[0] | {"id": "night", "scene": "s2", "frequency": "nightly"}
    keep(root, verified([*rows, night], "nightly"))
    keep(root, verified(rows[:2]))
    kept = kept_results.read(root / "compare/kept/verify/results.json")
    assert [row["id"] for row in kept["rows"]] == ["s1.run_out@2.DEM", "s1.run_out@5.DEM", "night"]


def test_cost_rows_are_not_kept(root, rows):
    keep(root, verified([*rows, rows[0] | {"id": "cost", "metric": "core_seconds", "unit": "core-s"}]))
    assert "cost" not in [row["id"] for row in kept_results.read(root / "compare/kept/verify/results.json")["rows"]]


def test_the_picture_is_that_of_the_results(root, rows):
    (root / "compare/report").mkdir(parents=True)
    (root / "verify/plots").mkdir(parents=True)
    Image.new("RGB", (1800, 600), "red").save(root / "verify/plots/run-out.png")
    keep(root, verified(rows))
    assert Image.open(root / "compare/report/picture.png").size == (900, 300)


def test_bad_input_is_two(root, capsys):
    assert trust_table.main(["--root", str(root), "--verify", str(root / "nowhere")]) == 2
    (root / "README.md").write_text("no markers\n")
    assert trust_table.main(["--root", str(root)]) == 2
    assert "README.md: there are no markers" in capsys.readouterr().err


def test_every_line_is_a_row_of_the_table_of_checks(label):
    """A run or a metric that is renamed must not drop out of the README unseen."""
    checks = tomllib.loads((trust_table.ROOT / "compare/checks.toml").read_text())
    table, runs = checks["check"], checks["run"]
    there = set()
    for check in table:
        references = check["reference"] if isinstance(check["reference"], list) else [check["reference"]]
        at = check.get("at", [None])
        for run in [check["run"]] if isinstance(check["run"], str) else check["run"]:
            for t in at if isinstance(at, list) else [at]:
                there |= {(run, label(check, t), reference["kind"]) for reference in references}
    wanted = {(scene, metric, line.kind) for line in LINES for scene in line.scenes for metric in line.metrics}
    assert not sorted(wanted - there)
    beside = {run["id"]: run["beside"] + preset for run in runs if "beside" in run for preset in PRESETS.values()
              if preset and run["id"].endswith(preset)}
    assert [run["id"] for run in runs if "beside" in run] == list(beside) == list(beside.values()), "named as PRESETS has it"
    assert {metric for _, metric in WORST} <= {metric for _, metric, _ in there}


def test_the_tables_of_this_repository_are_those_of_the_kept_results():
    kept = kept_results.read(trust_table.ROOT / "compare/kept/verify/results.json")
    assert kept["rows"] and kept["costs"]
    assert not trust_table.check(trust_table.ROOT, kept, None)
