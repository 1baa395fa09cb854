// GoogleTest's main with MPI around it: LIGGGHTS needs MPI, and OpenFOAM in serial does not start it.
#include <gtest/gtest.h>

#include "reference/demvof/beads/mpi_session.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const demvof::MpiSession session;
  return RUN_ALL_TESTS();
}
