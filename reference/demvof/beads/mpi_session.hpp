// MPI, which LIGGGHTS needs, from its start to the end of the scope, however that is left.
#pragma once

#include <cstdlib>

#include <mpi.h>

namespace demvof {

class MpiSession {
 public:
  // Alone it starts no daemon (OpenMPI's orted): nothing here asks for further processes, and one that
  // outlives a run that was killed would hold what the run had open.
  MpiSession() {
    ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    MPI_Init(nullptr, nullptr);
  }
  ~MpiSession() { MPI_Finalize(); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  MpiSession(MpiSession&&) = delete;
  MpiSession& operator=(MpiSession&&) = delete;
};

}  // namespace demvof
