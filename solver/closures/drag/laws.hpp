// The laws of drag that model.drag_law chooses from. The first is the paper's.
#pragma once

#include "solver/closures/drag/beetstra.hpp"
#include "solver/closures/drag/di_felice.hpp"
#include "solver/closures/drag/paper.hpp"
#include "solver/closures/drag/tenneti.hpp"
#include "solver/model/laws.hpp"

namespace granvof::closures {

struct DragLaws : Choices<DragPaper, DragDiFelice, DragBeetstra, DragTenneti> {};

}  // namespace granvof::closures
