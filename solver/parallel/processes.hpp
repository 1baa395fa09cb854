// The processes that mpirun, or another launcher of MPI, started: the only part that knows MPI.
#pragma once

#include <functional>
#include <memory>

#include "solver/grid/communicator.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// Those that this one was started with, one slab each; null where it is alone. Without a launcher MPI is not
// touched. Throws CaseError where there are several and the program is built without MPI.
std::unique_ptr<Communicator> launched_processes();

// What `load` gives in every process, where it gives the same in all. Throws what it throws here; CaseError
// where it throws in another, or gives another scene there.
Scene load_alike(const Communicator& processes, const std::function<Scene()>& load);

// Messages of this process go nowhere from here on.
void keep_silent();

}  // namespace granvof
