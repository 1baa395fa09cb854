"""Plots on a disk that is full end as every other file there does: with what the system says, and nothing in part."""

import resource
from contextlib import contextmanager

import matplotlib.pyplot as plt
import pytest
from report import style


@contextmanager
def no_more_than(size):
    """In a file, by this process: pytest too, which writes of the test as soon as it is over, into a file perhaps."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("room", [100, 3000])  # of the picture, of the one in vectors
def test_a_plot_that_finds_no_room(tmp_path, room):
    figure, axis = plt.subplots(figsize=(0.4, 0.4))
    axis.set_axis_off()
    figure.text(0.1, 0.5, "S")
    with no_more_than(room), pytest.raises(OSError, match="File too large"):
        style.save(figure, tmp_path, "plot")
    assert [path.name for path in tmp_path.iterdir() if path.stat().st_size == room] == []
