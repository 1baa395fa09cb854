#include "compare/checks/homogeneous.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace granvof::compare {
namespace {

using std::numbers::pi;

// The root of a function that rises from below zero, in (0, most).
template <typename Rising>
double root_of(Rising rising, double most) {
  double low = 0.0, high = most;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < 0.0 ? low : high) = middle;
  }
  return low;
}

// Drag on a grain over Stokes' 3 pi mu d U, U = f_c w, less the mean pressure gradient's part.
double force_on_grain(std::string_view law, double f_s, double re) {
  const double f_c = 1.0 - f_s;
  if (law == "di-felice") {
    const double c_d_re = std::pow(4.8 + 0.63 * std::sqrt(re), 2);  // Dallavalle
    const double chi = 3.7 - (re > 0.0 ? 0.65 * std::exp(-std::pow(1.5 - std::log10(re), 2) / 2.0) : 0.0);
    return c_d_re / 24.0 / std::pow(f_c, chi);
  }
  if (law == "beetstra") {
    const double at_rest = 10.0 * f_s / std::pow(f_c, 2) + std::pow(f_c, 2) * (1.0 + 1.5 * std::sqrt(f_s));
    if (re == 0.0) return at_rest;
    return at_rest + 0.413 * re / (24.0 * std::pow(f_c, 2)) *
                         (1.0 / f_c + 3.0 * f_s * f_c + 8.4 * std::pow(re, -0.343)) /
                         (1.0 + std::pow(10.0, 3.0 * f_s) * std::pow(re, -(1.0 + 4.0 * f_s) / 2.0));
  }
  // Tenneti et al.: their F times f_c
  return (1.0 + 0.15 * std::pow(re, 0.687)) / std::pow(f_c, 2) + 5.81 * f_s / std::pow(f_c, 2) +
         0.48 * std::cbrt(f_s) / std::pow(f_c, 3) +
         f_c * std::pow(f_s, 3) * re * (0.95 + 0.61 * std::pow(f_s, 3) / std::pow(f_c, 2));
}

double ergun_and_wen_yu(double f_s, double w, const Fluid& fluid, double d) {
  const double f_c = 1.0 - f_s, mu = fluid.viscosity, rho = fluid.density, re = rho * w * d / mu;
  const double c_d_re = 24.0 + 6.0 * re / (1.0 + std::sqrt(re)) + 0.4 * re;  // (9)
  const double wen_yu = 0.75 * c_d_re * mu * f_s / (d * d) * std::pow(f_c, -1.65);
  const double ergun = 150.0 * f_s * f_s * mu / (f_c * d * d) + 1.75 * rho * f_s * w / d;
  return std::lerp(ergun, wen_yu, std::clamp((f_c - 0.78) / 0.04, 0.0, 1.0));
}

// g0 at contact: (19), or of spheres that jam (Chialvo and Sundaresan 2013).
double contacts_to_be(const Scene& scene, double f) {
  const double most = scene.contact.solid_fraction_max;
  if (word_of(scene.model.radial_distribution) == "paper")
    return (1.0 - 7.0 * f / 16.0) / std::pow(1.0 - f / most, 2);
  return (1.0 - f / 2.0) / std::pow(1.0 - f, 3) +
         (0.58 + 3.12 * std::tanh(scene.solid.friction / 0.54)) * f * f / std::pow(most - f, 1.5);
}

// e of (18), grains that rub as in Chialvo and Sundaresan (2013).
double restitution(const Scene& scene, double theta) {
  const Solid& solid = scene.solid;
  const double e0 =
      solid.restitution -
      (scene.model.frictional_restitution ? 1.5 * solid.friction * std::exp(-3.0 * solid.friction) : 0.0);
  const double stokes = solid.density * solid.diameter * std::sqrt(theta) / (18.0 * scene.liquid.viscosity);
  return std::clamp(e0 - 2.85 / std::sqrt(stokes), 0.0, std::max(e0, 0.0));
}

// f_s mu_s^K of (16) and (20) [Pa s], with what grains carry as they fly where the scene has that.
double collisional_viscosity(const Scene& scene, double f, double theta, double e) {
  const double g0 = contacts_to_be(scene, f),
               unit = scene.solid.density * scene.solid.diameter * std::sqrt(theta),
               collided = 0.8 * f * f * g0 * (1.0 + e) / std::sqrt(pi);
  if (word_of(scene.model.kinetic_transport) == "collisional") return unit * collided;
  const double flown = f * f * g0 * (1.0 + e) * (3.0 * e - 1.0) / 15.0 + f / 6.0;
  return unit * (collided + std::max(flown, 0.0) * std::sqrt(pi) / (3.0 - e));
}

// eta_s of (17), or mu(I), mu(I_v). pressure > 0 [Pa].
double friction_coefficient(const Scene& scene, double pressure, double shear) {
  const Solid& solid = scene.solid;
  const Contact& contact = scene.contact;
  const auto between = [&](double number, double half) {
    return solid.friction + (contact.fast_friction - solid.friction) / (1.0 + half / number);
  };
  const std::string_view law = word_of(scene.model.friction_law);
  if (law == "inertial")
    return between(shear * solid.diameter / std::sqrt(pressure / solid.density), contact.inertial_number);
  if (law == "viscous") return between(scene.liquid.viscosity * shear / pressure, contact.viscous_number);
  return solid.friction;
}

// What drag on agitation adds to it: c^2 beta gamma d^2 / ((I + I_q) P), c = 1/3, I_q = 1e-3 (da Cruz et al.
// 2005), beta at most f_s sqrt(rho_s P) / d.
double friction_of_agitation(const Scene& scene, double f, double pressure, double shear) {
  const double d = scene.solid.diameter, free = std::sqrt(pressure / scene.solid.density);
  const double beta = std::min(printed_drag(scene, f, 0.0), f * pressure / (free * d));
  return beta * shear * d * d / (9.0 * (shear * d / free + 1e-3) * pressure);
}

// Where grains touch: at f_s,min; with a packing of their own where they are set down without weight, and
// where shear drives it in the end, to the critical one.
double touching(const Scene& scene, double f) {
  const Contact& c = scene.contact;
  if (scene.model.shear_dilatancy) return c.critical_solid_fraction;
  return word_of(scene.model.packing) == "carried" ? std::max(f, c.solid_fraction_min) : c.solid_fraction_min;
}

// P_s^ES of (13).
double elastic(const Contact& c, double f, double touch) {
  const double excess = f - touch, width = c.solid_fraction_max - c.solid_fraction_min;
  if (excess <= 0.0) return 0.0;
  return c.stiffness * f * std::pow(excess, c.exponent) * (1.0 + std::sin(pi * (excess / width - 0.5)));
}

// P_s^D of (15), with (1 - e) and the exponent 2 / delta; f_s0 where grains touch at f_s,min, no nearer than
// 0.005.
double dense(const Scene& scene, double f, double theta, double e) {
  const Contact& c = scene.contact;
  const double f_s0 = c.dense_solid_fraction + touching(scene, f) - c.solid_fraction_min;
  const double bracket = c.flow_law_factor * f * f_s0 / std::max(f_s0 - f, 0.005);
  return 15.0 * scene.solid.density * theta * (1.0 - e) * std::pow(bracket, 2.0 / c.flow_law_exponent);
}

}  // namespace

double printed_drag(const Scene& scene, double f_s, double slip) {
  const Fluid& fluid = scene.liquid;
  const double d = scene.solid.diameter, f_c = 1.0 - f_s;
  const std::string_view law = word_of(scene.model.drag_law);
  if (law == "paper") return ergun_and_wen_yu(f_s, slip, fluid, d);
  const double force = force_on_grain(law, f_s, fluid.density * f_c * slip * d / fluid.viscosity);
  const double grains = 6.0 * f_s / (pi * d * d * d);  // in a volume
  return grains * 3.0 * pi * fluid.viscosity * d * f_c * force;
}

std::optional<double> printed_settling_slip(const Scene& scene) {
  if (!scene.bed || !scene.model.drag) return std::nullopt;
  const double f = scene.bed->solid_fraction;
  const double weight = f * (1.0 - f) * (scene.solid.density - scene.liquid.density) * scene.gravity;
  const double free_fall = std::sqrt(2.0 * scene.gravity * scene.tank[1]);
  return root_of([&](double w) { return printed_drag(scene, f, w) * w - weight; }, free_fall);
}

std::optional<EvenShear> printed_even_shear(const Scene& scene) {
  const Model& model = scene.model;
  const double speed = scene.sides[top].velocity[0] - scene.sides[bottom].velocity[0];
  if (!scene.bed || speed <= 0.0 || word_of(model.granular_temperature) != "transported" ||
      model.correlated_collisions || model.bounds_collisions() ||
      word_of(model.critical_packing) == "by-rate")
    return std::nullopt;
  const Solid& solid = scene.solid;
  const double high = scene.bed->box.upper[1] - scene.bed->box.lower[1];
  const double f = scene.bed->solid_fraction, shear = speed / high, g0 = contacts_to_be(scene, f);
  const double beta = model.drag ? printed_drag(scene, f, 0.0) : 0.0;
  const auto collisions = [&](double theta, double e) {  // (23)
    return 12.0 * (1.0 - e * e) * f * f * solid.density * g0 / (solid.diameter * std::sqrt(pi)) *
           std::pow(theta, 1.5);
  };
  // Over sqrt(Theta), so that it rises.
  const auto taken = [&](double w) {
    const double theta = w * w, e = restitution(scene, theta);
    return (collisions(theta, e) + 3.0 * beta * theta -
            collisional_viscosity(scene, f, theta, e) * shear * shear) /
           w;
  };
  EvenShear even;
  const double w = root_of(taken, 10.0 * speed), e = restitution(scene, w * w);
  even.theta = w * w;
  even.energy = 1.5 * f * solid.density * even.theta;
  even.drag = 3.0 * beta * even.theta;
  const double kinetic = solid.density * f * even.theta * (1.0 + 2.0 * (1.0 + e) * f * g0);  // (11)
  double borne = elastic(scene.contact, f, touching(scene, f));
  if (model.dense_excess) borne += std::max(dense(scene, f, even.theta, e) - kinetic, 0.0);  // (14)
  if (model.viscous_contact_pressure)
    borne += std::pow(f / (scene.contact.solid_fraction_max - f), 2) * scene.liquid.viscosity * shear;
  even.pressure = kinetic + borne;
  double coefficient = borne > 0.0 ? friction_coefficient(scene, borne, shear) : 0.0;
  if (borne > 0.0 && model.agitation_drag) coefficient += friction_of_agitation(scene, f, borne, shear);
  even.contacts = borne * coefficient * shear + collisions(even.theta, e);
  double viscosity = scene.liquid.viscosity;
  if (model.suspension_viscosity)
    viscosity *= (1.0 + 2.5 * f / (1.0 - f / scene.contact.solid_fraction_max)) / (1.0 - f);
  if (model.les)  // (10)
    viscosity +=
        scene.liquid.density * std::pow(0.18, 2) * scene.grid.spacing[0] * scene.grid.spacing[1] * shear;
  even.fluid = (1.0 - f) * viscosity * shear * shear;
  return even;
}

}  // namespace granvof::compare
