// Material of a case's beads: the element tests, their numbers and the material file, as a run directory.
#pragma once

#include "reference/demvof/program/record_scene.hpp"

namespace demvof {

// Writes series.csv (a row a window of the chute), material.toml (a piece of a case, see
// element/material.hpp) and run.json, whose monitors hold every number with its band. Only [solid],
// [contact] and [reference] of the scene matter. `gate_closed` is not used. Returns 0, or 1 where the tests
// fail: then nothing is written. Throws granvof::CaseError without a [reference] table or without gravity,
// granvof::OutputError where options.out holds anything but element tests of this scene.
int record_element(const granvof::Scene& scene, const RecordOptions& options);

}  // namespace demvof
