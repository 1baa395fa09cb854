#include "compare/checks/theory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compare/checks/homogeneous.hpp"
#include "compare/metrics/flow_section.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof::compare {
namespace {

// A floating bed rests at the loosest packing that carries a load, f_s,min; its solids fix its height.
struct RestingBed {
  double solid_fraction;
  double height;  // H [m]
};

std::optional<RestingBed> resting_bed(const Scene& scene) {
  if (!scene.bed) return std::nullopt;
  const double packing = std::max(scene.contact.solid_fraction_min, scene.bed->solid_fraction);
  const double dropped = scene.bed->box.upper[1] - scene.bed->box.lower[1];
  return RestingBed{packing, dropped * scene.bed->solid_fraction / packing};
}

std::optional<double> density_ratio(const Run& run, const Parameters&) {
  return run.scene.solid.density / run.scene.liquid.density;
}

std::optional<double> floating_period(const Run& run, const Parameters&) {
  const auto bed = resting_bed(run.scene);
  if (!bed) return std::nullopt;
  return 2.0 * std::numbers::pi *
         std::sqrt(run.scene.solid.density * bed->height / (run.scene.liquid.density * run.scene.gravity));
}

std::optional<double> floating_decay_rate(const Run& run, const Parameters&) {
  const auto bed = resting_bed(run.scene);
  if (!bed) return std::nullopt;
  const Scene& scene = run.scene;
  const double f_s = bed->solid_fraction;
  const double f_c = 1.0 - f_s;
  // The viscous part of (8): the rate is that of the last, slow part of the approach.
  const double drag =
      150.0 * f_s * f_s * scene.liquid.viscosity / (f_c * scene.solid.diameter * scene.solid.diameter);
  const double twice_gamma = drag / (f_s * f_c * scene.liquid.density);
  const double omega_squared = scene.liquid.density * scene.gravity / (scene.solid.density * bed->height);
  return omega_squared / twice_gamma;
}

std::optional<double> solid_fraction_max(const Run& run, const Parameters&) {
  return run.scene.contact.solid_fraction_max;
}

std::optional<double> triangle_flat_top(const Run&, const Parameters&) {
  return 0.05 / 0.95;
}

// Of a heap whose face leans back from its foot: a length l less its part of h / tan(slope).
std::optional<double> heap_flat_top(const Run& run, const Parameters&) {
  const auto& bed = run.scene.bed;
  if (!bed || bed->slope >= 90.0) return std::nullopt;
  const double length = bed->box.upper[0] - bed->box.lower[0], high = bed->box.upper[1] - bed->box.lower[1];
  const double face = high / std::tan(bed->slope * std::numbers::pi / 180.0);
  return (length - 0.95 * face) / (length - 0.05 * face);
}

std::optional<double> film_speed(const Run& run, const Parameters&) {
  const Scene& scene = run.scene;
  return speed_in_film(scene, scene.tank[1], scene.tank[1] - 0.5 * scene.grid.spacing[1]);
}

std::optional<double> film_depth(const Run& run, const Parameters&) {
  const Scene& scene = run.scene;
  const double volume = scene.sides[left].inflow.speed * scene.tank[1];
  return std::cbrt(3.0 * volume * scene.liquid.viscosity / (scene.liquid.density * gravity_of(scene)[0]));
}

std::optional<double> channel_speed(const Run& run, const Parameters&) {
  return 1.5 * run.scene.sides[left].inflow.speed;
}

// Of the first mode between two walls; mean depth from the two ends at the start.
std::optional<double> sloshing_period(const Run& run, const Parameters&) {
  const Curve left_end = run.curve("liquid_height_left"), right_end = run.curve("liquid_height_right");
  if (left_end.empty() || right_end.empty()) return std::nullopt;
  const Scene& scene = run.scene;
  const double liquid = scene.liquid.density, gas = scene.gas.density, k = std::numbers::pi / scene.tank[0];
  const double depth = 0.5 * (left_end.value.front() + right_end.value.front());
  const double omega_squared = scene.gravity * k * (liquid - gas) /
                               (liquid / std::tanh(k * depth) + gas / std::tanh(k * (scene.tank[1] - depth)));
  return 2.0 * std::numbers::pi / std::sqrt(omega_squared);
}

std::optional<double> settling_slip(const Run& run, const Parameters&) {
  return printed_settling_slip(run.scene);
}

std::optional<double> even_shear_temperature(const Run& run, const Parameters&) {
  const auto even = printed_even_shear(run.scene);
  return even ? std::optional(even->theta) : std::nullopt;
}

std::optional<double> even_shear_pressure(const Run& run, const Parameters&) {
  const auto even = printed_even_shear(run.scene);
  return even ? std::optional(even->pressure) : std::nullopt;
}

// Of a term of the energy: what the walls give is all that the others take, and Theta from nothing.
std::optional<double> even_shear_power(const Run& run, const Parameters& p) {
  const auto even = printed_even_shear(run.scene);
  if (!even || !p.term) return std::nullopt;
  const Box& bed = run.scene.bed->box;
  const double share =
      (bed.upper[1] - bed.lower[1]) / run.scene.tank[1];  // of the tank, the rest is obstacle
  if (*p.term == "contacts") return share * even->contacts;
  if (*p.term == "drag") return share * even->drag;
  if (*p.term == "agitation" && p.window) return share * even->energy / (p.window->end - p.window->begin);
  if (*p.term == "viscosity") return share * even->fluid;
  if (*p.term == "walls") return -share * (even->contacts + even->drag + even->fluid);
  return std::nullopt;
}

// Of a block on a Coulomb floor, from rest: down the slope, or taken along by a floor that moves.
std::optional<double> sliding_speed_after(const Run& run, double time) {
  const Side& floor = run.scene.sides[bottom];
  if (floor.solid.kind != WallKind::coulomb) return std::nullopt;
  const Vec3 g = gravity_of(run.scene);
  const double friction = floor.solid.friction * normal_gravity(run.scene);
  const double taken = floor.velocity[0] > 0.0 ? friction : -friction;
  return (g[0] + taken) * time;
}

std::optional<double> sliding_speed(const Run& run, const Parameters& p) {
  return p.window ? sliding_speed_after(run, p.window->end) : std::nullopt;
}

std::optional<double> sliding_energy(const Run& run, const Parameters& p) {
  const auto speed = p.at ? sliding_speed_after(run, *p.at) : std::nullopt;
  if (!speed || !run.scene.bed) return std::nullopt;
  const Box& bed = run.scene.bed->box;
  const double grains = run.scene.bed->solid_fraction * (bed.upper[0] - bed.lower[0]) *
                        (bed.upper[1] - bed.lower[1]) * run.scene.tank[2];
  return 0.5 * run.scene.solid.density * grains * *speed * *speed;
}

constexpr std::array<FormulaEntry, 16> table{{
    {"density_ratio", "-", "h/H = rho_s / rho_l (balance of weight and buoyancy; paper, section 4.3)",
     density_ratio},
    {"floating_period", "s",
     "T = 2 pi sqrt(rho_s H / (rho_l g)) (paper, section 4.3), H = dropped height * f_s / f_s,min",
     floating_period},
    {"sloshing_period", "s",
     "T = 2 pi / omega, omega^2 = g k (rho_l - rho_g) / (rho_l coth(k h_l) + rho_g coth(k h_g)), k = pi / L "
     "(Lamb, Hydrodynamics, art. 231)",
     sloshing_period},
    {"floating_decay_rate", "1/s",
     "k = omega^2 / (2 gamma), omega^2 = rho_l g / (rho_s H), 2 gamma = beta / (f_s f_c rho_l), beta of (8) "
     "for "
     "slow flow, at f_s,min",
     floating_decay_rate},
    {"triangle_flat_top", "-", "a triangle's share within 5 % of its tip of the length above 5 % of it",
     triangle_flat_top},
    {"heap_flat_top", "-",
     "the same of a heap as it is set up: (l - 0.95 b) / (l - 0.05 b), b = h / tan(slope) the length of its "
     "face",
     heap_flat_top},
    {"solid_fraction_max", "-", "f_s,max of (13)", solid_fraction_max},
    {"film_speed", "m/s",
     "u = rho g sin(theta) / mu (h y - y^2 / 2) at the uppermost cells' centres (Nusselt 1916)", film_speed},
    {"film_depth", "m", "h = (3 q mu / (rho g sin(theta)))^(1/3), q what comes in (Nusselt 1916)",
     film_depth},
    {"channel_speed", "m/s", "3/2 of the mean speed between plates (Poiseuille)", channel_speed},
    {"sliding_speed", "m/s",
     "(g sin(theta) - mu_w g cos(theta)) t, a block down a Coulomb floor; mu_w g t, on one that moves "
     "(Coulomb)",
     sliding_speed},
    {"sliding_energy", "J", "1/2 m v^2 of that block", sliding_energy},
    {"settling_slip", "m/s",
     "w of beta w = f_s f_c (rho_s - rho_c) g, beta of the scene's drag law as published", settling_slip},
    {"even_shear_temperature", "m2/s2", "Theta of steady even shear: production = collisions + drag, (7)",
     even_shear_temperature},
    {"even_shear_pressure", "Pa", "P_s of steady even shear, (11) to (15), and that of viscous contacts",
     even_shear_pressure},
    {"even_shear_power", "W/m3",
     "of steady even shear: (17), (20), (23), 3 beta Theta, and the fluid's viscosity", even_shear_power},
}};

}  // namespace

std::span<const FormulaEntry> formulas() {
  return table;
}

const FormulaEntry* find_formula(std::string_view name) {
  const auto* found =
      std::find_if(table.begin(), table.end(), [&](const FormulaEntry& e) { return e.name == name; });
  return found == table.end() ? nullptr : found;
}

}  // namespace granvof::compare
