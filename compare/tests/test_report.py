"""The report from made-up results: what it shows, and that it needs nothing but itself."""

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser

import h5py
import numpy as np
import pytest

from PIL import Image
from report import drawing, figures, film, page, report, results, sections, snapshots, states, style


def test_report_writes_every_plot_as_png_and_those_of_the_whole_as_pdf(reported):
    plots = {path.stem for path in (reported / "plots").glob("*.png")}
    assert plots == {"run-out", "base-pressure", "floating-run-out", "centre-height", "floating-theory", "dam-break", "sedimentation",
                     "viscous-collapse", "snapshots-s1", "snapshots-float-full-r02"}
    of_every_run = ("snapshots-", "energy-", "ledger-", "plan-")
    assert {name for name in plots if not name.startswith(of_every_run)} == {path.stem for path in (reported / "plots").glob("*.pdf")}
    text = (reported / "report.html").read_text()
    films = list((reported / "plots").glob("*.apng"))
    assert text.count("data:image/png;base64,") == len(plots) + len(films)


def test_a_film_has_every_instant_with_the_beads_below(reported):
    with Image.open(reported / "plots/film-s1.apng") as moving:
        assert moving.n_frames == 5
        assert moving.size[0] == film.LEFT + 480 + 8
        assert moving.size[1] == 2 * (320 + film.ABOVE) + 6 + film.BELOW  # of a record: two tanks below each other
    assert "beads of DEM-VOF below" in (reported / "report.html").read_text()
    with Image.open(reported / "plots/film-float-full-r02.apng") as moving:
        assert moving.size[1] == 320 + film.ABOVE + film.BELOW


def test_each_instant_of_a_film_has_its_own_colours(reported):
    entry = results.load(reported).curves["s1"]
    scene = entry["scene"]
    with Image.open(reported / "plots/film-s1.apng") as moving:
        for index, (time, f_s, alpha, _) in enumerate(results.snapshots(entry)):
            moving.seek(index)
            shown = np.asarray(moving.convert("RGB")).astype(int)
            label = snapshots.label_of_time(time, scene)  # the record's fields are those of the run
            expected = film.frame([(label, f_s, alpha), (f"DEM-VOF (seed1), {label}", f_s, alpha)], scene)
            assert (shown == np.asarray(expected)).all(), index
            bottom = film.ABOVE + 320 - 1
            grains, water = shown[bottom, film.LEFT], shown[bottom, film.LEFT + 479]
            assert grains[0] > 2 * grains[2]  # brown
            assert water[2] > water[0] > 200  # light blue


def test_a_film_is_shown_at_one_pace_whatever_the_instants():
    held = film.held_for([0.0, 0.1, 0.2, 1.0])
    assert held == [600, 600, 4800, film.HOLDS_END]
    assert film.held_for([0.5, 0.5])[0] == film.LASTS  # of no time at all


def test_beads_are_shown_until_their_next_instant():
    recorded = [(0.0, "a", None), (1.0, "b", None)]
    shown = [film.until(recorded, time, {"time_unit": 1.0})[1] for time in (-1.0, 0.0, 0.9, 1.0 - 1e-9, 2.0)]
    assert shown == ["a", "a", "a", "b", "b"]


def test_the_axes_of_a_film_are_those_of_its_tank():
    assert film.ticks(120.0, 6) == [0, 20, 40, 60, 80, 100, 120]
    tank, liquid = [0.12, 0.08, 0.01], np.ones((8, 12))
    pictures = [np.asarray(film.frame([("t", 0 * liquid, liquid)], {"tank": [factor * side for side in tank]})) for factor in (1.0, 2.0)]
    inside = np.s_[film.ABOVE:film.ABOVE + 320, film.LEFT:film.LEFT + 480]
    assert (pictures[0][inside] == pictures[1][inside]).all()
    assert (pictures[0] != pictures[1]).any()  # other numbers beside the same picture


@pytest.mark.skipif(shutil.which("ffmpeg") is None or shutil.which("ffprobe") is None, reason="there is no ffmpeg")
def test_a_film_is_an_mp4_too_where_there_is_ffmpeg(reported):
    said = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=codec_name,width,height,duration", "-of", "json",
                           reported / "plots/film-s1.mp4"], stdout=subprocess.PIPE, check=True).stdout
    stream, = json.loads(said)["streams"]
    moving = film.film(results.load(reported).curves["s1"])
    assert stream["codec_name"] == "h264" and stream["width"] == moving.frames[0].size[0]
    assert float(stream["duration"]) == pytest.approx(sum(moving.held) / 1000, abs=0.1)


def test_without_ffmpeg_there_is_no_mp4_and_no_error(verify_directory, tmp_path, monkeypatch):
    moving = film.film(results.load(verify_directory).curves["s1"])
    monkeypatch.setenv("PATH", str(tmp_path))
    moving.write(tmp_path / "film")
    assert [path.name for path in tmp_path.glob("film*")] == ["film.apng"]


def test_a_narrow_tank_or_few_instants_have_no_film(verify_directory):
    entry = results.load(verify_directory).curves["s1"]
    assert film.film(entry) is not None
    assert film.film(entry | {"scene": entry["scene"] | {"tank": [0.01, 0.4, 1.0]}}) is None
    assert film.film(entry | {"directory": "nowhere"}) is None


def test_speeds_pressure_and_temperature_of_a_run_are_pictures(verify_directory, tmp_path, monkeypatch):
    loaded = results.load(verify_directory)
    assert states.state_plot(loaded, "s1", tmp_path) == []  # its fields were not written
    with h5py.File(tmp_path / "fields.h5", "w") as file:
        for index in range(3):
            group = file.create_group(f"t{index:04}")
            group.attrs["time"] = 0.1 * index
            solid = np.zeros((1, 8, 12))
            solid[0, :4, :6] = 0.57
            group["f_s"], group["alpha"], group["p_c"], group["theta"] = solid, 1 + 0 * solid, 100.0 + solid, index * solid
            group["u_s"], group["u_c"] = np.stack([3 * index + 0 * solid, 4 * index + 0 * solid, 0 * solid], axis=-1), np.zeros((1, 8, 12, 3))
    loaded.curves["s1"]["directory"] = str(tmp_path)
    drawn = []
    monkeypatch.setattr(states.style, "save", lambda figure, *_, **__: drawn.append(figure) or "drawn")
    assert states.state_plot(loaded, "s1", tmp_path) == ["drawn"]
    images = [axis.get_images()[0].get_array() for axis in drawn[0].axes if axis.get_images()]
    assert len(images) == 2 * 4  # all but the first instant
    assert images[4].max() == pytest.approx(10.0) and images[4].count() == 24  # the speed, where there are grains
    assert images[6].max() == pytest.approx(100.57) and images[6].count() == 96
    assert "temperature" in figures.caption("states-s1")


class Outside(HTMLParser):
    """Collects what a page would fetch."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        self.found += [value for name, value in attributes
                       if name in ("src", "href", "srcset") and not value.startswith(("data:", "#"))]


def test_page_fetches_nothing(reported):
    text = (reported / "report.html").read_text()
    parser = Outside()
    parser.feed(text)
    assert parser.found == []
    assert not re.search(r"url\(|@import|fetch\(", text)


def test_page_names_failures_first_and_escapes_text(reported):
    text = (reported / "report.html").read_text()
    places = [text.index(part) for part in ("<strong>1 unexpected", 'id="glance"', 'id="changed"', 'id="fails"', 'id="checks"')]
    assert places == sorted(places)
    assert "late &lt;creep&gt;" in text and "late <creep>" not in text
    assert "no arrest &amp; thin layers" in text
    assert "no record of" in text


def test_nothing_unexpected_is_said(verify_directory):
    loaded = results.load(verify_directory)
    loaded.rows = [row for row in loaded.rows if not row["unexpected"]]
    assert "Nothing unexpected." in page.render(loaded, [])


def test_a_plot_without_its_runs_is_left_out(verify_directory, tmp_path):
    loaded = results.load(verify_directory)
    loaded.curves, loaded.records, loaded.rows = {}, {}, []
    assert figures.draw_all(loaded, tmp_path / "plots") == []


@pytest.fixture
def axis():
    figure, drawn = style.plt.subplots()
    yield drawn
    style.plt.close(figure)


def record(shift):
    return {"curves": {"run_out": {"x": [0.0, 1.0, 2.0], "y": [shift, 1.0 + shift, 2.0 + shift]}}}


def draw_seeds(axis, verify_directory, shifts):
    loaded = results.load(verify_directory)
    loaded.records = {"s1": {f"seed{index}": record(shift) for index, shift in enumerate(shifts, 1)}}
    return drawing.draw_records(axis, loaded, "s1", "run_out", style.BLUE, "S1")


def test_one_seed_is_a_line_that_states_no_band(axis, verify_directory):
    assert draw_seeds(axis, verify_directory, [0.5])
    assert [line.get_label() for line in axis.lines] == ["DEM-VOF, S1 (one seed, no band)"]
    assert axis.lines[0].get_ydata()[-1] == 2.5
    assert not axis.collections


def test_two_seeds_are_their_mean_with_their_range(axis, verify_directory):
    assert draw_seeds(axis, verify_directory, [0.0, 0.5])
    assert axis.lines[0].get_label() == "DEM-VOF, S1 (mean and range of 2 seeds)"
    assert axis.lines[0].get_ydata()[-1] == 2.25
    band = axis.collections[0].get_paths()[0].vertices
    assert {y for x, y in band if x == 2.0} == {2.0, 2.5}


def test_without_a_record_nothing_is_drawn(axis, verify_directory):
    assert not draw_seeds(axis, verify_directory, [])
    assert not axis.lines


def test_a_record_alone_makes_a_figure(verify_directory, tmp_path):
    loaded = results.load(verify_directory)
    loaded.curves = {}
    assert figures.run_out_plot(loaded, tmp_path) == ["run-out"]


def test_recorded_fields_stand_beside_ours_at_the_same_times(verify_directory):
    loaded = results.load(verify_directory)
    scene = loaded.curves["s1"]["scene"]
    variant, shots = snapshots.recorded_shots(loaded, "s1", [0.0, 0.35, 0.5], scene)
    assert variant == "seed1"
    assert [shot and shot[0] for shot in shots] == [0.0, 0.35, None]
    assert snapshots.recorded_shots(loaded, "float-full-r02", [0.0], scene) == (None, [])


def test_published_series_are_read_by_column(verify_directory):
    loaded = results.load(verify_directory, report.ROOT / "cases")
    x, y = loaded.published("pham_van_bang_fronts.tsv", "packed_front")
    assert (x[0], y[0]) == (172.0, 0.0054688)
    assert loaded.published("none.tsv", "packed_front") is None


def write_section(directory, name="charts", **content):
    (directory / name).mkdir(parents=True)
    Image.new("RGB", (120, 120)).save(directory / name / "a-b.png")
    (directory / name / f"{name}.json").write_text(json.dumps(content))


def test_sections_of_others_are_shown(tmp_path, verify_directory):
    write_section(tmp_path, "stability", title="Where it <holds>", text="One line.", commit="abc1234",
                  tables=[{"columns": ["method", "cost"], "rows": [["PLIC", 1.23456]]}])
    write_section(tmp_path, "charts", title="Charts", figures=[{"file": "a-b.png", "caption": "s1 & s2"}])
    found = sections.read_all(tmp_path)
    assert [section.name for section in found] == ["charts", "stability"]
    text = page.render(results.load(verify_directory), [], found)
    assert "Where it &lt;holds&gt;" in text and "s1 &amp; s2" in text and 'data-value="1.23456">1.235<' in text
    assert 'alt="a b"' in text and "One line." in text and "abc1234" in text


def test_what_was_kept_of_the_faults_is_shown_until_there_is_more(tmp_path, verify_directory):
    kept = tmp_path / "kept"
    write_section(kept, "mutate", title="Kept faults")
    arguments = ["--verify", str(verify_directory), "--kept", str(kept)]
    report.main(arguments)
    assert "Kept faults" in (verify_directory / "report.html").read_text()
    write_section(verify_directory.parent, "mutate", title="New faults")
    report.main(arguments)
    page_text = (verify_directory / "report.html").read_text()
    assert "New faults" in page_text and "Kept faults" not in page_text


@pytest.mark.parametrize("content", [{}, {"title": "t", "figures": [{"file": "gone.png", "caption": "c"}]}, {"title": "t", "tables": [{}]}])
def test_a_damaged_section_is_refused_by_name(tmp_path, content):
    write_section(tmp_path, **content)
    with pytest.raises(ValueError, match="charts.json cannot be shown"):
        sections.read_all(tmp_path)


def test_a_damaged_section_ends_the_report(verify_directory, capsys):
    write_section(verify_directory.parent)
    assert report.main(["--verify", str(verify_directory)]) == 2
    assert "charts.json" in capsys.readouterr().err


@pytest.mark.parametrize("value, text", [(None, "–"), ("text", "text"), (1.23456, "1.235"), (1e-12, "1e-12")])
def test_numbers(value, text):
    assert page.number(value) == text


def report_of(directory):
    return report.main(["--verify", str(directory), "--kept", str(directory / "nothing")])


def test_a_truncated_fields_file_is_a_sentence_of_the_report(verify_directory, capsys):
    path = verify_directory.parent / "runs/s1/fields.h5"
    path.write_bytes(path.read_bytes()[:1000])
    assert report_of(verify_directory) == 1  # what could not be shown is no success
    text = (verify_directory / "report.html").read_text()
    assert "1 file could not be shown" in text and "runs/s1/fields.h5 cannot be shown" in text
    assert "snapshots-float-full-r02" in text  # the others are
    said = capsys.readouterr().err
    assert "fields.h5 cannot be shown" in said and "Traceback" not in said


@pytest.mark.parametrize("name", ["results.json", "curves.json"])
@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"{}", b'{"date": 1, "results": []}', b"\xff\x00"])
def test_damaged_results_are_one_line(verify_directory, capsys, name, content):
    (verify_directory / name).write_bytes(content)
    assert report_of(verify_directory) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and name in said and "Traceback" not in said


def test_a_damaged_earlier_comparison_is_a_sentence(verify_directory):
    (verify_directory / "results.previous.json").write_text('{"date": "2026')
    assert report_of(verify_directory) == 1
    assert "results.previous.json cannot be shown" in (verify_directory / "report.html").read_text()


def test_a_damaged_published_series_is_a_sentence(verify_directory, tmp_path):
    (tmp_path / "cases/published").mkdir(parents=True)
    (tmp_path / "cases/published/martin_moyce_1952.tsv").write_text("tau\tdelta\n1\n")
    arguments = ["--verify", str(verify_directory), "--kept", str(tmp_path / "nothing"), "--cases", str(tmp_path / "cases")]
    assert report.main(arguments) == 1
    assert "martin_moyce_1952.tsv cannot be shown" in (verify_directory / "report.html").read_text()


def test_an_error_is_shown_as_one(verify_directory, make_row):
    content = json.loads((verify_directory / "results.json").read_text())
    content["results"].append(make_row(id="e", verdict="error", value=None, reference=None, deviation=None, distance=None,
                                       note="it has 60 whole rows, written were 178"))
    (verify_directory / "results.json").write_text(json.dumps(content))
    assert report_of(verify_directory) == 0
    text = (verify_directory / "report.html").read_text()
    assert 'class="verdict error"' in text and "60 whole rows" in text


def in_three_dimensions(verify_directory, tmp_path):
    """Results whose s1 is 3D: a bed that is as deep as z, in cells 0.01 m high."""
    loaded = results.load(verify_directory)
    loaded.curves = {"s1": loaded.curves["s1"]}
    entry = loaded.curves["s1"]
    entry["directory"] = str(tmp_path / "threed")
    entry["scene"] |= {"dimensions": 3, "tank": [0.12, 0.08, 0.05], "cells": [12, 8, 5]}
    solid = np.zeros((5, 8, 12))
    for z in range(5):
        solid[z, :z + 1, :6] = 0.1 * (z + 1)
    (tmp_path / "threed").mkdir()
    with h5py.File(tmp_path / "threed/fields.h5", "w") as file:
        group = file.create_group("t0000")
        group.attrs["time"] = 0.0
        group["f_s"], group["alpha"] = solid, np.ones_like(solid)
    return loaded, solid


def test_a_3d_scene_is_shown_in_its_mid_plane_and_from_above(verify_directory, tmp_path):
    loaded, solid = in_three_dimensions(verify_directory, tmp_path)
    (_, f_s, _, _), = results.snapshots(loaded.curves["s1"])
    assert np.array_equal(f_s, solid[2])
    assert snapshots.plan_plot(loaded, "s1", tmp_path / "plots") == ["plan-s1"]
    assert "from above" in figures.caption("plan-s1") and "mid-plane" in figures.caption("snapshots-s1")
    loaded.curves["s1"]["scene"]["dimensions"] = 2
    (_, f_s, _, _), = results.snapshots(loaded.curves["s1"])
    assert np.allclose(f_s, solid.mean(axis=0))
    assert snapshots.plan_plot(loaded, "s1", tmp_path / "plots") == []


def test_a_run_with_another_preset_has_the_record_of_its_case_beside_it(verify_directory):
    loaded = results.load(verify_directory)
    loaded.runs["s1-other"]["case"] = "s1"
    assert loaded.records["s1"] and "s1-other" not in loaded.records
    drawn = []
    keep, snapshots.draw = snapshots.draw, lambda columns, *_: drawn.extend(label for label, _, _ in columns)
    try:
        loaded.curves["s1-other"] = loaded.curves["s1"]
        snapshots.snapshot_plot(loaded, "s1-other", verify_directory)
    finally:
        snapshots.draw = keep
    assert any("DEM-VOF (seed1)" in label for label in drawn)
