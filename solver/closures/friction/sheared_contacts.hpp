// What a friction coefficient may depend on beside the grains themselves.
#pragma once

namespace granvof::closures {

struct ShearedContacts {
  double pressure = 0.0;        // P_s^E >= 0 [Pa]
  double strain_norm = 0.0;     // ||S|| = sqrt(S:S / 2) >= 0 [1/s], half the rate of shear gamma
  double pore_viscosity = 0.0;  // mu_c of the fluid between the grains >= 0 [Pa s]; 0 for a law that does not
                                // depend on it
};

// mu_s + (mu_2 - mu_s) / (1 + slow / fast) [-], fast, slow >= 0 in one unit. Limits: mu_s for fast = 0, mu_2
// for slow = 0.
inline double friction_between(double mu_s, double mu_2, double fast, double slow) {
  return fast > 0.0 ? mu_s + (mu_2 - mu_s) * fast / (fast + slow) : mu_s;
}

}  // namespace granvof::closures
