"""What reference/README.md says of the records is what they hold."""
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
tables = runpy.run_path(str(ROOT / "tables"))
PAGE = (ROOT / "README.md").read_text(encoding="utf-8")


def present(text):
    return tables["page"](text, tables["records"](), tables["json_of"](tables["RESULTS"] / "bands.json"))


def test_the_tables_are_those_of_the_records():
    assert present(PAGE) == PAGE, "reference/tables writes them"


def test_a_figure_that_is_typed_over_is_seen():
    typed = PAGE.replace("| 2975, 2988 |", "| 2975, 2989 |")
    assert typed != PAGE and present(typed) == PAGE


def test_a_page_without_markers_is_refused():
    with pytest.raises(ValueError, match="markers of 'costs'"):
        present("no markers")


def measured(name):
    return next(record.monitors for record in tables["records"]() if record.name == name and record.facts["seed"] == 1)


def sentences():
    """What stands typed in the page, made of the records."""
    chute, glass, salt = measured("bulk-friction/s1"), measured("element/s1"), measured("element/sw-2d")
    law = "mu_s {mu_s:.3f} +- {mu_s_band:.3f}, mu_2 {mu_2:.3f} +- {mu_2_band:.3f}, I_0 {I_0:.3f} +- {I_0_band:.3f}; rest at {stopped_at_deg:.0f}"
    packings = "{loosest_packing:.3f} loosest, {densest_packing:.3f} densest"
    first = "in first strain mu_s {first_mu_s:.3f} +- {first_mu_s_band:.3f}, mu_2 {first_mu_2:.3f}, I_0 {first_I_0:.3f}"
    slow = "critical packing in slow flow is {critical_packing:.3f}"
    wall = "{plane_wall_friction:.3f} +- {plane_wall_friction_band:.3f} on a plane wall"
    cools = "cools as smooth spheres of e = {cooling_restitution:.3f} +- {cooling_restitution_band:.3f}"
    return [law.format(**chute), packings.format(**glass), first.format(**glass), slow.format(**glass),
            packings.format(**salt), "mu(I) {mu_s:.3f} +- {mu_s_band:.3f} at rest".format(**salt),
            "rests at {stopped_at_deg:.1f}, starts at {started_at_deg:.1f} degrees".format(**salt),
            *(text.format(**beads) for beads in (glass, salt) for text in (wall, cools))]


@pytest.mark.parametrize("sentence", sentences())
def test_what_is_typed_of_materials_is_what_was_measured(sentence):
    assert sentence in PAGE


def test_what_is_typed_of_floating_beds_is_what_rows_compare_with():
    rows = {row["id"]: row for row in tables["json_of"](ROOT.parent / "compare/kept/verify/results.json")["rows"]}
    scenes = [f"float-full-r{ratio}" for ratio in ("02", "04", "06", "08")]
    shares = ", ".join(f"{rows[f'{scene}.immersed_share.DEM']['reference']:.3f}" for scene in scenes)
    rates = ", ".join(f"{rows[f'{scene}.decay_rate.DEM']['reference']:.1f}" for scene in scenes)
    assert f"h/H at rest {shares} (density ratio 0.2, 0.4, 0.6, 0.8); decay rate {rates} 1/s" in " ".join(PAGE.split())
