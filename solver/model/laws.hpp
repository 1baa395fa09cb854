// What a scene chooses of each list of laws, closures/*/laws.hpp: a place in the list, and no law.
// Equations: docs/theory/contact.md, docs/theory/kinetic-theory.md.
#pragma once

#include "solver/model/choices.hpp"

namespace granvof::closures {

using CriticalPacking = Chosen<struct CriticalPackings>;        // the packing that shear drives a bed to
using DragLaw = Chosen<struct DragLaws>;                        // beta_c
using FrictionLaw = Chosen<struct FrictionLaws>;                // the friction coefficient of (17)
using KineticTransport = Chosen<struct KineticTransports>;      // what mu_s^K and kappa_s^K hold
using Packing = Chosen<struct Packings>;                        // the solid fraction at which grains touch
using RadialDistribution = Chosen<struct RadialDistributions>;  // g0 of (19)
using SlopeLimiter = Chosen<struct SlopeLimiters>;              // slopes of f_s within a cell
using TemperatureModel = Chosen<struct TemperatureModels>;      // what of (7) is solved

}  // namespace granvof::closures
