// What launchers of MPI tell the processes that they start, by their environment.
#pragma once

#include <array>
#include <cstdlib>

namespace granvof {

// Set by mpirun of Open MPI; by launchers that speak PMIx or PMI (srun); by mpirun of MPICH.
inline constexpr std::array<const char*, 4> marks_of_launchers{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK",
                                                               "PMI_RANK", "PMI_SIZE"};

inline bool has_launcher() {
  for (const char* mark : marks_of_launchers)
    if (std::getenv(mark) != nullptr) return true;
  return false;
}

}  // namespace granvof
