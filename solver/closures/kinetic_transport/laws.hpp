// What mu_s^K and kappa_s^K hold, that model.kinetic_transport chooses from. The first is the paper's. Each
// has
//   viscosity(f_s, e, g0), conductivity(f_s, e, g0) -> [-].
#pragma once

#include "solver/closures/kinetic_transport/collisional.hpp"
#include "solver/closures/kinetic_transport/streaming.hpp"
#include "solver/model/choices.hpp"

namespace granvof::closures {

using KineticTransports = Choices<TransportCollisional, TransportWithStreaming>;
using KineticTransport = Chosen<KineticTransports>;

}  // namespace granvof::closures
