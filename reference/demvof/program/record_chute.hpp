// Bulk friction of a case's beads: the chute, its points and the law fitted to them, as a run directory.
#pragma once

#include "reference/demvof/program/record_scene.hpp"

namespace demvof {

// Writes series.csv (a row a window of flow) and run.json, whose monitors hold the fit of mu(I) with its
// bands and the angles of the last flow and of rest. Only [solid] and [reference] of the scene matter.
// `gate_closed` is not used. Returns 0. Throws granvof::CaseError without a [reference] table,
// granvof::OutputError where options.out holds anything but a chute of this scene, std::runtime_error when a
// bead is lost or the flow gives too few points.
int record_chute(const granvof::Scene& scene, const RecordOptions& options);

}  // namespace demvof
