#include "solver/scene/scene.hpp"

#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/drag/laws.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/closures/kinetic_transport/laws.hpp"
#include "solver/closures/packing/laws.hpp"
#include "solver/closures/radial_distribution/laws.hpp"

namespace granvof {

bool Model::carries_packing() const {
  return closures::is_carried(packing_at_start());
}

Packing Model::packing_at_start() const {
  return shear_dilatancy ? Packing::of<closures::PackingCarried>() : packing;
}

bool Model::bounds_collisions() const {
  return whole_stress_friction && contact_friction && kinetic_viscosity &&
         closures::agitates(granular_temperature);
}

bool Model::has_viscous_contacts() const {
  return viscous_contact_pressure || closures::depends_on_pore_viscosity(friction_law) ||
         (shear_dilatancy && closures::depends_on_rate(critical_packing));
}

template <typename List>
std::string_view word_of(closures::Chosen<List> law) {
  return law.facts().word;
}

template std::string_view word_of(CriticalPacking);
template std::string_view word_of(DragLaw);
template std::string_view word_of(FrictionLaw);
template std::string_view word_of(KineticTransport);
template std::string_view word_of(Packing);
template std::string_view word_of(RadialDistribution);
template std::string_view word_of(TemperatureModel);

}  // namespace granvof
