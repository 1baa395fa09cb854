"""OpenFOAM cases from ours, without running OpenFOAM."""
import math
import subprocess
import sys
from pathlib import Path

import pytest

REFERENCE = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(REFERENCE), str(REFERENCE.parent / "solver/python")]
from peers import openfoam_case, parcels  # noqa: E402

POOL = """
[scene]
name = "pool"
dimensions = 2
[tank]
size = [0.1, 0.04]
gravity = 9.81
[grid]
dx = 0.01
dy = 0.01
[walls]
left.fluid = "no-slip"
right.fluid = "slip"
bottom.fluid = "no-slip"
top = "open"
[gas]
density = 1
viscosity = 1e-5
[liquid]
density = 1000
viscosity = 1e-3
level = 0.015
box.origin = [0.0, 0.0]
box.size = [0.02, 0.03]
[time]
end = 2
unit = "s"
[output]
series_interval = 0.1
"""
BED = POOL + """
[solid]
density = 2500
diameter = 1e-3
restitution = 0.9
friction = 0.4
[contact]
solid_fraction_max = 0.63
[bed]
x = 0.01
length = 0.03
height = 0.02
y = 0
solid_fraction = 0.57
"""


def test_every_cell_holds_its_exact_share_of_liquid():
    tank = openfoam_case.Tank(POOL)
    shares = tank.liquid_shares()
    assert len(shares) == 10 * 4
    assert shares[:3] == pytest.approx([1.0, 1.0, 1.0])
    assert shares[10:13] == pytest.approx([1.0, 1.0, 0.5])  # the box, then the level alone
    assert sum(shares) * 1e-4 == pytest.approx(0.1 * 0.015 + 0.02 * 0.015)


def test_walls_and_materials_are_the_scenes(tmp_path):
    openfoam_case.write_interfoam(tmp_path, openfoam_case.Tank(POOL))
    velocity = (tmp_path / "0/U").read_text()
    assert "right { type slip; }" in velocity and "left { type fixedValue;" in velocity and "front { type empty; }" in velocity
    assert "nu 1e-06; rho 1000;" in (tmp_path / "constant/transportProperties").read_text()
    assert "endTime 2;" in (tmp_path / "system/controlDict").read_text()


def test_grains_and_other_walls_are_refused(tmp_path):
    with pytest.raises(openfoam_case.CaseError, match="neither grains nor gates"):
        openfoam_case.write_interfoam(tmp_path, openfoam_case.Tank(BED))
    moving = openfoam_case.Tank(POOL.replace('"slip"', '"coulomb"'))
    with pytest.raises(openfoam_case.CaseError, match="the wall 'right' is coulomb"):
        openfoam_case.write_interfoam(tmp_path, moving)


def test_parcels_fill_the_bed_evenly_and_hold_all_its_beads(tmp_path):
    tank = openfoam_case.Tank(BED)
    facts = parcels.write_case(tmp_path, tank, 100)
    beads = 0.57 * 0.03 * 0.02 * tank.size[2] / (math.pi / 6 * 1e-9)
    assert facts["parcels"] * facts["beads_per_parcel"] == pytest.approx(beads)
    found = parcels.positions(parcels.bed_box(tank), tank.spacing, 100, True)
    assert len(found) == 600
    assert sum(x < 0.02 and y < 0.01 for x, y, _ in found) == 100 and all(0.01 <= x <= 0.04 and 0 <= y <= 0.02 for x, y, _ in found)


@pytest.mark.parametrize("scene", ["..", ".", "", "a/../..", "/nothing/there", "a b"])
def test_a_scene_that_is_no_name_is_refused_before_anything_is_replaced(tmp_path, scene):
    (tmp_path / "interFoam").mkdir()
    (tmp_path / "notes.txt").write_text("mine\n")
    done = subprocess.run([REFERENCE / "peers/run", "--out", tmp_path, "interFoam", scene], capture_output=True, text=True)
    assert done.returncode == 2 and "a name has letters" in done.stderr, done.stderr
    assert (tmp_path / "notes.txt").exists() and (tmp_path / "interFoam").exists()
