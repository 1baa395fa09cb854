"""fields.xdmf in ParaView's own Python, where it is installed (Debian's python3-paraview, and Xvfb where there is no display):
times, the tank, the bed where it should be, and a picture of it."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent.parent
SOLVER = ROOT / "build/release/solver/granvof"
PVPYTHON, XVFB = shutil.which("pvpython"), shutil.which("Xvfb")
TANK, BED = (0.4, 0.12), (0.0975, 0.049)  # m, of cases/s1.toml
CELL = 0.005
WIDTH = 800  # pixels of the picture, which is the tank and nothing else

pytestmark = pytest.mark.skipif(PVPYTHON is None or not (XVFB or os.environ.get("DISPLAY")),
                                reason="there is no ParaView with Python, or nowhere to draw")

SCRIPT = """
import json, sys
from paraview.simple import *
file, picture, width = sys.argv[1], sys.argv[2], int(sys.argv[3])
reader = XDMFReader(FileNames=[file])
reader.UpdatePipelineInformation()
times = list(reader.TimestepValues)
reader.UpdatePipeline(times[0])
information = reader.GetDataInformation()
left, right, bottom, top, near, far = information.GetBounds()
grains = Threshold(Input=reader, Scalars=["CELLS", "f_s"], LowerThreshold=0.3, UpperThreshold=1.0)
grains.UpdatePipeline(times[0])
view = CreateView("RenderView")
view.UseColorPaletteForBackground, view.Background, view.OrientationAxesVisibility = 0, [1, 0, 0], 0
view.ViewSize = [width, round(width * (top - bottom) / (right - left))]
shown = Show(reader, view)
shown.Representation = "Surface"
shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0
ColorBy(shown, ("CELLS", "f_s"))
GetColorTransferFunction("f_s").RGBPoints = [0.0, 1, 1, 1, 0.5, 0, 0, 0]
shown.SetScalarBarVisibility(view, False)
view.ViewTime = times[0]
Render(view)  # the first one places the camera
view.CameraParallelProjection, view.CameraParallelScale = 1, 0.5 * (top - bottom)
view.CameraFocalPoint = [0.5 * (left + right), 0.5 * (bottom + top), far]
view.CameraPosition = [0.5 * (left + right), 0.5 * (bottom + top), far + 1]
view.CameraViewUp = [0, 1, 0]
SaveScreenshot(picture, view, ImageResolution=view.ViewSize)
names = [reader.CellData.GetArray(i).Name for i in range(reader.CellData.GetNumberOfArrays())]
print(json.dumps({"times": times, "cells": information.GetNumberOfCells(), "bounds": [left, right, bottom, top],
                  "grains": grains.GetDataInformation().GetBounds()[:4], "names": names}))
"""


@pytest.fixture(scope="module")
def display():
    """The environment of a program that draws."""
    if os.environ.get("DISPLAY"):
        yield dict(os.environ)
        return
    ready, write = os.pipe()
    with subprocess.Popen([XVFB, "-noreset", "-displayfd", str(write), "-screen", "0", "1024x768x24"], pass_fds=[write],
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as server:
        os.close(write)
        with os.fdopen(ready) as number:
            chosen = number.readline().strip()  # when it is ready, or nothing as it ends
        assert chosen, "Xvfb does not start"
        yield {**os.environ, "DISPLAY": f":{chosen}", "LIBGL_ALWAYS_SOFTWARE": "1"}
        server.terminate()


@pytest.fixture(scope="module")
def opened(display, tmp_path_factory):
    """What ParaView says of a run, and the picture it draws of its start."""
    directory = tmp_path_factory.mktemp("run")
    subprocess.run([SOLVER, "run", ROOT / "cases/s1.toml", "--out", directory / "s1", "--set", f"grid.dx={CELL}", "--set", "time.end=0.2",
                    "--set", "output.field_times=[0, 0.1, 0.2]"], check=True, stdout=subprocess.DEVNULL)
    (directory / "open.py").write_text(SCRIPT)
    ended = subprocess.run([PVPYTHON, "--force-offscreen-rendering", directory / "open.py", directory / "s1/fields.xdmf",
                            directory / "bed.png", str(WIDTH)], env=display, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                           timeout=300)
    assert ended.returncode == 0, ended.stderr[-2000:]
    with Image.open(directory / "bed.png") as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    return json.loads(ended.stdout.splitlines()[-1]), pixels


def test_times_tank_and_fields(opened):
    said, _ = opened
    assert len(said["times"]) == 3 and said["times"][0] == 0.0
    assert said["bounds"] == pytest.approx([0.0, TANK[0], 0.0, TANK[1]])
    assert said["cells"] == 80 * 24
    assert {"f_s", "alpha", "p_c", "theta", "u_s", "u_c"} <= set(said["names"])


def test_the_bed_is_where_the_case_has_it(opened):
    said, _ = opened
    assert said["grains"] == pytest.approx([0.0, BED[0], 0.0, BED[1]], abs=CELL)


def test_the_picture_shows_the_bed_in_its_tank(opened):
    _, pixels = opened
    height, width, _ = pixels.shape
    assert width == WIDTH and not (pixels[..., 0] > pixels[..., 1] + 50).mean() > 0.02  # the tank fills it
    dark = pixels.max(axis=2) < 100
    columns, rows = np.flatnonzero(dark.any(axis=0)), np.flatnonzero(dark.any(axis=1))
    per_metre = WIDTH / TANK[0]
    assert columns.min() <= 2 and columns.max() == pytest.approx(BED[0] * per_metre, abs=CELL * per_metre)
    assert rows.max() >= height - 3 and rows.min() == pytest.approx(height - BED[1] * per_metre, abs=CELL * per_metre)
    assert dark.mean() == pytest.approx(BED[0] * BED[1] / (TANK[0] * TANK[1]), rel=0.15)
