// MPI, which LIGGGHTS needs, from its start to the end of the scope, however that is left.
#pragma once

#include <mpi.h>

namespace demvof {

class MpiSession {
 public:
  MpiSession() { MPI_Init(nullptr, nullptr); }
  ~MpiSession() { MPI_Finalize(); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  MpiSession(MpiSession&&) = delete;
  MpiSession& operator=(MpiSession&&) = delete;
};

}  // namespace demvof
