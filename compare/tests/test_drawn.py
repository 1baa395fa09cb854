"""What is drawn against the axes it is drawn in: a cell whose place is known lies where the numbers beside it say, in the model's
picture and in the beads' alike."""

import numpy as np
import pytest

from report import drawing, film, snapshots, states, style

TANK, CELLS = [0.12, 0.08, 0.01], (8, 12)  # 10 mm cells, 40 pixels each; ticks at every 20 mm of x
CELL = (4, 2)  # row and column of the one with grains: 20 to 30 mm of x, 40 to 50 mm of y
SCENE = {"tank": TANK, "time_unit": 1.0, "dimensions": 2}


@pytest.fixture
def fields():
    """f_s of the one cell, and water up to 30 mm."""
    f_s, alpha = np.zeros(CELLS), np.zeros(CELLS)
    f_s[CELL] = 0.63
    alpha[:3] = 1.0
    return f_s, alpha


def runs_of(found):
    """First and last place of a row of consecutive ones."""
    return int(found.min()), int(found.max())


def marks(picture, panel):
    """Rows of the marks of y and columns of those of x, as they stand in the picture; {mm: pixel}, the first on 0."""
    top = film.ABOVE if panel == 0 else picture.shape[0] - film.BELOW - 320
    black = (picture < 60).all(axis=2)
    rows = np.flatnonzero(black[top - 1:top + 321, film.LEFT - 4:film.LEFT].all(axis=1)) + top - 1
    columns = np.flatnonzero(black[picture.shape[0] - film.BELOW:picture.shape[0] - film.BELOW + 4].all(axis=0))
    return (dict(zip(film.ticks(80.0, 10), sorted(rows, reverse=True))), dict(zip(film.ticks(120.0, 6), sorted(columns))))


@pytest.mark.parametrize("panel", [0, 1], ids=["model", "beads"])
def test_a_cell_of_a_film_lies_where_its_axes_say(fields, panel):
    nothing = np.zeros(CELLS), np.zeros(CELLS)
    picture = np.asarray(film.frame([("", *(fields if panel == index else nothing)) for index in (0, 1)], SCENE)).astype(int)
    y, x = marks(picture, panel)
    assert len(y) > 3 and len(x) == 7
    brown = (picture[..., 0] > 1.5 * picture[..., 2]) & (picture[..., 0] > 80)
    columns, rows = runs_of(np.flatnonzero(brown.any(axis=0))), runs_of(np.flatnonzero(brown.any(axis=1)))
    per_mm = {"x": (x[120] - x[0]) / 120, "y": (y[0] - y[max(y)]) / max(y)}
    assert per_mm == pytest.approx({"x": 4.0, "y": 4.0})
    assert (columns[0], columns[1] + 1) == (x[0] + 20 * per_mm["x"], x[0] + 30 * per_mm["x"])
    assert (rows[1] + 1, rows[0]) == (y[0] - 40 * per_mm["y"], y[0] - 50 * per_mm["y"])
    assert all(pixel == x[0] + 4 * value for value, pixel in x.items()) and all(pixel == y[0] - 4 * value for value, pixel in y.items())


def test_the_surface_of_a_film_is_the_last_row_of_water(fields):
    picture = np.asarray(film.frame([("", 0 * fields[0], fields[1])], SCENE)).astype(int)
    y, _ = marks(picture, 0)
    dark = (picture[film.ABOVE:film.ABOVE + 320, film.LEFT:film.LEFT + 480].max(axis=2) < 60).all(axis=1)
    assert runs_of(np.flatnonzero(dark) + film.ABOVE) == (y[0] - 120, y[0] - 80 - 1)  # the cells from 20 to 30 mm


def place_of(axis, image, row, column):
    """Edges [left, right, bottom, top] of a cell in data coordinates, from where it is drawn on the axis."""
    rows, columns = image.get_array().shape
    to_data = axis.transData.inverted().transform
    box = image.get_window_extent()
    width, height = box.width / columns, box.height / rows
    left, bottom = to_data((box.x0 + column * width, box.y0 + row * height))
    right, top = to_data((box.x0 + (column + 1) * width, box.y0 + (row + 1) * height))
    return [left, right, bottom, top]


@pytest.fixture
def saved(monkeypatch):
    figures = []
    monkeypatch.setattr(style, "save", lambda figure, directory, name, **_: figures.append(figure) or name)
    yield figures
    for figure in figures:
        style.plt.close(figure)


class Shown:
    """What pictures ask of results: one run with its record, whose fields are the same."""

    def __init__(self):
        entry = {"scene": SCENE}
        self.curves, self.runs, self.records = {"s1": entry}, {}, {"s1": {"seed1": dict(entry)}}

    def facts(self, *_):
        return []

    def record_of(self, run):
        return run


def test_snapshots_of_model_and_beads_lie_upon_each_other_and_on_their_axes(fields, saved, monkeypatch, tmp_path):
    monkeypatch.setattr(snapshots, "snapshots", lambda entry: [(time, *fields, None) for time in (0.0, 1.0)])
    assert snapshots.snapshot_plot(Shown(), "s1", tmp_path) == ["snapshots-s1"]
    figure, = saved
    figure.canvas.draw()
    with_pictures = [axis for axis in figure.axes if axis.get_images()]
    assert len(with_pictures) == 2 * 2  # two instants, and the beads beside
    for axis in with_pictures:
        image, = axis.get_images()
        assert image.get_array()[CELL] == 0.63 and image.origin == "lower"
        assert place_of(axis, image, *CELL) == pytest.approx([20, 30, 40, 50])
        assert (axis.get_xlim(), axis.get_ylim()) == ((0, 120), (0, 80))
        surface = np.concatenate([path.vertices for line in axis.collections for path in line.get_paths()])
        assert surface[:, 1] == pytest.approx(30.0) and surface[:, 0].min() == pytest.approx(5.0)  # between centres of cells


def test_states_lie_on_their_axes(fields, saved, monkeypatch, tmp_path):
    f_s, alpha = (field[None] for field in fields)
    velocity = np.stack([f_s, 0 * f_s, 0 * f_s], axis=-1)
    monkeypatch.setattr(states, "instants", lambda *_: [(time, (f_s, alpha, velocity, velocity, f_s, f_s)) for time in (0.0, 1.0)])
    assert states.state_plot(Shown(), "s1", tmp_path) == ["states-s1"]
    figure, = saved
    figure.canvas.draw()
    with_pictures = [axis for axis in figure.axes if axis.get_images()]
    assert len(with_pictures) == 4
    for axis in with_pictures:
        image, = axis.get_images()
        assert image.get_array()[CELL] == 0.63
        assert place_of(axis, image, *CELL) == pytest.approx([20, 30, 40, 50])


def test_a_curve_of_the_model_and_the_same_of_the_beads_are_one_line():
    class Curves:
        records = {"s1": {"seed1": {"curves": {"run_out": {"x": [0.0, 1.0, 2.0], "y": [0.0, 1.0, 3.0]}}}}}

        def curve(self, *_):
            return np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 3.0])

    figure, axis = style.plt.subplots()
    assert drawing.draw_run(axis, Curves(), "s1", "run_out", style.BLUE, "S1", scale=2.0)
    assert drawing.draw_records(axis, Curves(), "s1", "run_out", style.BLUE, "S1", scale=2.0)
    ours, beads = axis.get_lines()
    style.plt.close(figure)
    assert list(ours.get_xdata()) == [0.0, 1.0, 2.0] and list(ours.get_ydata()) == [0.0, 2.0, 6.0]
    assert (beads.get_xdata()[0], beads.get_xdata()[-1]) == (0.0, 2.0)
    assert beads.get_ydata() == pytest.approx(np.interp(beads.get_xdata(), ours.get_xdata(), ours.get_ydata()), abs=0.02)
