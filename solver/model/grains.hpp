// The grains of a scene and their contacts.
// Equations: docs/theory/contact.md.
#pragma once

namespace granvof {

// A case without grains has no [solid]; the defaults then stand in, so that laws stay finite at f_s = 0.
struct Solid {
  double density = 1000.0;   // rho_s [kg/m3], > 0
  double diameter = 1e-3;    // d_s [m], > 0
  double restitution = 0.9;  // e0 [-], in [0, 1]
  double friction = 0.0;     // eta_s = tan(theta_s) [-], >= 0
  bool operator==(const Solid&) const = default;
};

// Parameters of the enduring contact, eqs (13)-(17); the defaults are the paper's.
struct Contact {
  double stiffness = 1e8;              // K [Pa]
  double exponent = 1.5;               // chi [-]
  double flow_law_factor = 0.28;       // a' of the flow law in (15) [-]
  double flow_law_exponent = 0.58;     // delta of it [-]
  double dense_solid_fraction = 0.60;  // f_s0 of (15) [-]
  double solid_fraction_min = 0.57;    // f_s,min, random loose packing [-]
  double solid_fraction_max = 0.63;    // f_s,max [-]
  double regularisation = 1e5;         // n of (17) [s]
  double fast_friction = 0.643;        // mu_2 of mu(I), tan(32.76 degrees): glass beads, Jop et al. 2006 [-]
  double inertial_number = 0.279;      // I_0 of mu(I), likewise [-]
  double stop_length = 1.65;           // L of h_stop in grain diameters, likewise [-]
  double critical_solid_fraction = 0.582;  // f_c, packing under slow shear: glass beads, Pailha 2009 [-]
  double dilatancy_slope = 4.09;           // K_psi = d tan(psi) / d f_p, likewise [-]
  double loosening_factor = 1.0;  // a of the critical packing by rate of shear: Boyer et al. 2011 [-]
  double viscous_number = 0.005;  // I_v at which mu(I_v) is half way to mu_2: Boyer et al. 2011 [-]
  bool operator==(const Contact&) const = default;
};

}  // namespace granvof
