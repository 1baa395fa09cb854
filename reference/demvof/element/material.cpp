#include "reference/demvof/element/material.hpp"

#include <fmt/format.h>

#include "solver/closures/contact_pressure.hpp"
#include "solver/closures/restitution.hpp"

namespace demvof {

namespace {

std::string row(const char* key, double value, int digits, const Measured& measured,
                const std::string& note) {
  return fmt::format("{} = {:.{}f}  # {}+- {:.{}f}\n", key, value, digits, note, measured.band, digits);
}

std::string friction_rows(const FrictionFit& fit) {
  return "\n[solid]\n" + row("friction", fit.law.at_rest, 3, {0.0, fit.band.at_rest}, "mu_s, ") +
         "\n[contact]\n" + row("fast_friction", fit.law.limit, 3, {0.0, fit.band.limit}, "mu_2, ") +
         row("inertial_number", fit.law.scale, 3, {0.0, fit.band.scale}, "I_0, ");
}

std::string angles_of(const std::vector<FirstFlow>& first) {
  std::string text;
  for (const FirstFlow& flow : first)
    text +=
        (text.empty() ? "" : " and ") + (flow.started_at ? fmt::format("{:g}", *flow.started_at) : "none");
  return text;
}

std::string number(const Measured& measured) {
  return fmt::format("{:.3f} +- {:.3f}", measured.value, measured.band);
}

}  // namespace

double touching_fraction(const granvof::Contact& contact, double solid_fraction, double load) {
  double none = solid_fraction, too_much = 0.0;  // of the pressure at `solid_fraction`
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (none + too_much);
    (granvof::closures::elastic_pressure(solid_fraction, contact, middle).value < load ? none : too_much) =
        middle;
  }
  return none;
}

FrictionFit fit_of_first(const std::vector<FirstFlow>& first, const ChuteResult& chute) {
  std::vector<FrictionPoint> points;
  for (const FirstFlow& flow : first)
    for (std::size_t p = 0; p < flow.points.size(); ++p)
      if ((flow.strain[p] >= least_strain && flow.strain[p] <= largest_strain) ||
          flow.points[p].friction.inertial_number > slow_flow)
        points.push_back(flow.points[p].friction);
  for (const ChutePoint& point : chute.points)
    if (point.friction.inertial_number > slow_flow) points.push_back(point.friction);
  return fit_friction(points);
}

Measured critical_packing(const ChuteResult& chute, double& load) {
  std::vector<double> inertia, packing;
  double sum = 0.0;
  for (const ChutePoint& point : chute.points) {
    if (point.friction.inertial_number > slow_flow) continue;
    inertia.push_back(point.friction.inertial_number);
    packing.push_back(point.solid_fraction);
    sum += point.load;
  }
  const Measured critical = intercept_of(inertia, packing);
  load = sum / static_cast<double>(packing.size());
  return critical;
}

std::string material_text(const granvof::Scene& scene, const ElementTests& t) {
  const granvof::Contact& c = scene.contact;
  const granvof::ReferenceSettings& r = *scene.reference;
  const double loosest = touching_fraction(c, t.loosest.solid_fraction.value, t.loosest.load);
  const double critical = touching_fraction(c, t.critical.value, t.critical_load);
  std::string text = fmt::format(
      "# Beads of {} ({:g} mm, {:g} kg/m3, contacts of friction {:g} and restitution {:g}), measured by "
      "`demvof "
      "element`\n"
      "# in dry tests of their own. Not a case: one takes it over with `base`, beside its own file. Bands "
      "are twice the\n"
      "# standard error.\n"
      "#\n"
      "# mu(I): layers at rest tilted until they flow, at {} degrees, and their windows at strains of {:g} "
      "to {:g}; above\n"
      "# I = {:g} those of a rough chute, rms {:.3f}. In long slow flow the chute has mu_s {:.3f}, mu_2 "
      "{:.3f}, I_0 {:.3f},\n"
      "# and rests at {} degrees: where beads of one size have slid into layers it is less, and no collapse "
      "gets there.\n"
      "# Packings: at rest {} at the loosest, {} without friction; {} in slow flow. The law takes the\n"
      "# packing at which grains touch: what (13) gives under the load of each test is taken off. What flow "
      "dilates to,\n"
      "# (15), and the packing that is never passed keep the case's distances: not measured.\n"
      "# Not keys: restitution of smooth spheres that cool alike {} (model.frictional_restitution has "
      "{:.3f}),\n"
      "# friction on a plane wall {}.\n",
      scene.name, 1e3 * scene.solid.diameter * r.coarse_graining, scene.solid.density, r.bead_friction,
      r.bead_restitution, angles_of(t.first), least_strain, largest_strain, slow_flow, t.first_friction.rms,
      t.friction.law.at_rest, t.friction.law.limit, t.friction.law.scale,
      t.chute.stopped_at ? fmt::format("{:g}", *t.chute.stopped_at) : "no", number(t.loosest.solid_fraction),
      number(t.densest.solid_fraction), number(t.critical), number(t.restitution),
      granvof::closures::frictional_restitution(r.bead_restitution, r.bead_friction),
      t.wall ? number(*t.wall) : "none");
  text += friction_rows(t.first_friction);
  text += row("solid_fraction_min", loosest, 4, t.loosest.solid_fraction, "");
  text += row("critical_solid_fraction", critical, 4, t.critical, "");
  text +=
      fmt::format("dense_solid_fraction = {:.4f}\n", loosest + c.dense_solid_fraction - c.solid_fraction_min);
  text += fmt::format("solid_fraction_max = {:.4f}\n", loosest + c.solid_fraction_max - c.solid_fraction_min);
  return text;
}

}  // namespace demvof
