#include "solver/parallel/launched.hpp"
#include "solver/parallel/processes.hpp"
#include "solver/scene/case_error.hpp"

namespace granvof {

std::unique_ptr<Communicator> launched_processes() {
  for (const char* size : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* processes = std::getenv(size); processes != nullptr && std::atoi(processes) > 1)
      throw CaseError(
          "granvof: started as one of several processes, and built without MPI: they would all do "
          "the same. Build it where MPI is installed (libopenmpi-dev), or start it without mpirun");
  return nullptr;
}

}  // namespace granvof
