// What mu_s^K and kappa_s^K hold, that model.kinetic_transport chooses from. The first is the paper's. Each
// has
//   viscosity(f_s, e, g0), conductivity(f_s, e, g0) -> [-].
#pragma once

#include "solver/closures/kinetic_transport/collisional.hpp"
#include "solver/closures/kinetic_transport/streaming.hpp"
#include "solver/model/laws.hpp"

namespace granvof::closures {

struct KineticTransports : Choices<TransportCollisional, TransportWithStreaming> {};

}  // namespace granvof::closures
