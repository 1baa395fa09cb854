// Kinetic theory of the grains, eqs (11), (20)-(23).
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/kinetic_transport/laws.hpp"

namespace granvof::closures {
namespace {

constexpr double f_s = 0.5;
constexpr double theta = 0.01;  // [m2/s2]
constexpr double e = 0.9;
constexpr double g0 = 2.0;
constexpr double rho_s = 2500.0;  // [kg/m3]
constexpr double d_s = 1e-3;      // [m]

// Colliding pairs of spheres of a gas: means over the normal approach speed v, whose distribution among
// collisions is v exp(-v^2 / (4 Theta)), by quadrature.
struct Collisions {
  double rate;               // collisions in a unit volume and time [1/m3 s]
  double mean_speed;         // mean v [m/s]
  double mean_speed_square;  // mean v^2 [m2/s2]
  double mass;               // of a grain [kg]
};

Collisions collisions_of_hard_spheres() {
  std::array<double, 3> moment{};
  const double step = 1e-4 * std::sqrt(theta);
  for (double v = 0.5 * step; v < 20.0 * std::sqrt(theta); v += step) {
    const double weight = v * std::exp(-v * v / (4.0 * theta)) * step;
    moment[0] += weight;
    moment[1] += weight * v;
    moment[2] += weight * v * v;
  }
  // n^2 g0 / 2 pairs at contact, 4 pi d^2 of sphere each, times the flux of those that approach; one
  // component of the relative velocity has the variance 2 Theta.
  const double volume = std::numbers::pi / 6.0 * d_s * d_s * d_s;
  const double n = f_s / volume;
  const double approach = moment[0] / std::sqrt(4.0 * std::numbers::pi * theta);
  const double rate = 0.5 * n * n * g0 * 4.0 * std::numbers::pi * d_s * d_s * approach;
  return {rate, moment[1] / moment[0], moment[2] / moment[0], rho_s * volume};
}

// (21), (22) and (23) of grains of e.
double bulk_viscosity(double f, double t) {
  return bulk_to_shear_viscosity * kinetic_viscosity(f, t, e, g0, rho_s, d_s);
}
double conductivity(double f, double t) {
  return conductivity_to_viscosity * kinetic_viscosity(f, t, e, g0, rho_s, d_s);
}
double dissipation(double f, double t, double restitution, double div_u_s) {
  return collisional_dissipation_rate(f, restitution, g0, rho_s, d_s) * t * std::sqrt(t) +
         expansion_dissipation_rate(f, restitution, g0, rho_s, div_u_s) * t;
}

TEST(KineticTheory, Values) {
  EXPECT_NEAR(kinetic_pressure(f_s, theta, e, g0, rho_s), 60.0, 1e-12);
  EXPECT_NEAR(kinetic_viscosity(f_s, theta, e, g0, rho_s, d_s), 0.21439204174814744, 1e-14);
  EXPECT_NEAR(conductivity(f_s, theta), 0.5359801043703686, 1e-14);
  EXPECT_NEAR(dissipation(f_s, theta, e, 30.0), 1394.1903131111053, 1e-9);
}

TEST(KineticTheory, PressureIsMomentumFluxPlusTheVirialOfCollisions) {
  // A collision hands over m (1 + e) / 2 v across the distance d; isotropy gives one third of it to each
  // direction.
  const Collisions c = collisions_of_hard_spheres();
  const double streaming = rho_s * f_s * theta;
  const double virial = c.rate * d_s * 0.5 * c.mass * (1.0 + e) * c.mean_speed / 3.0;
  EXPECT_NEAR(kinetic_pressure(f_s, theta, e, g0, rho_s), streaming + virial, 1e-6 * (streaming + virial));
}

TEST(KineticTheory, DissipationIsTheEnergyLostInCollisions) {
  // A collision of equal grains loses m (1 - e^2) v^2 / 4.
  const Collisions c = collisions_of_hard_spheres();
  const double lost = c.rate * 0.25 * c.mass * (1.0 - e * e) * c.mean_speed_square;
  EXPECT_NEAR(dissipation(f_s, theta, e, 0.0), lost, 1e-6 * lost);
}

TEST(KineticTheory, DilutePressureIsThatOfAnIdealGas) {
  EXPECT_NEAR(kinetic_pressure(1e-9, theta, e, 1.0, rho_s) / (rho_s * 1e-9 * theta), 1.0, 1e-8);
}

TEST(KineticTheory, EverythingVanishesWithThetaAndWithTheGrains) {
  for (const auto& [f, t] : {std::pair{f_s, 0.0}, std::pair{0.0, theta}}) {
    EXPECT_EQ(kinetic_pressure(f, t, e, g0, rho_s), 0.0);
    EXPECT_EQ(kinetic_viscosity(f, t, e, g0, rho_s, d_s), 0.0);
    EXPECT_EQ(bulk_viscosity(f, t), 0.0);
    EXPECT_EQ(conductivity(f, t), 0.0);
    EXPECT_EQ(dissipation(f, t, e, 7.0), 0.0);
  }
}

TEST(KineticTheory, ElasticGrainsLoseNothing) {
  EXPECT_EQ(dissipation(f_s, theta, 1.0, 5.0), 0.0);
  EXPECT_GT(dissipation(f_s, theta, 0.0, 0.0), dissipation(f_s, theta, e, 0.0));
}

TEST(KineticTheory, BulkViscosityOfTheStressIsThatOfLun) {
  // (16) uses f_s zeta; Lun et al. (1984): 4/3 f_s^2 rho d g0 (1 + e) sqrt(Theta / pi).
  const double lun =
      4.0 / 3.0 * f_s * f_s * rho_s * d_s * g0 * (1.0 + e) * std::sqrt(theta / std::numbers::pi);
  EXPECT_NEAR(f_s * bulk_viscosity(f_s, theta), lun, 1e-14);
}

TEST(KineticTheory, ExpansionReducesTheDissipation) {
  const double at_rest = dissipation(f_s, theta, e, 0.0);
  const double expanding = dissipation(f_s, theta, e, 10.0);
  const double compressed = dissipation(f_s, theta, e, -10.0);
  EXPECT_LT(expanding, at_rest);
  EXPECT_NEAR(compressed - at_rest, at_rest - expanding, 1e-9);
  EXPECT_NEAR(at_rest, collisional_dissipation_rate(f_s, e, g0, rho_s, d_s) * std::pow(theta, 1.5), 1e-9);
}

TEST(KineticTheory, PositiveRootSolvesItsQuadratic) {
  for (const auto& [a, b, c] :
       {std::array{2.0, 3.0, 5.0}, std::array{2.0, -3.0, 5.0}, std::array{1e-12, 1.0, 1.0},
        std::array{1.0, 1e8, 1e-8}, std::array{1.0, 0.0, 4.0}, std::array{4.0, -2.0, 0.0}}) {
    const double w = positive_root(a, b, c);
    EXPECT_GT(w, 0.0);
    EXPECT_NEAR(a * w * w + b * w, c, 1e-12 * (a * w * w + std::abs(b) * w + c)) << a << ' ' << b << ' ' << c;
  }
  EXPECT_EQ(positive_root(0.0, 4.0, 2.0), 0.5);
  EXPECT_EQ(positive_root(3.0, 1.0, 0.0), 0.0);
  EXPECT_EQ(positive_root(3.0, 0.0, 0.0), 0.0);
}

TEST(KineticTheory, CubicRootSolvesItsCubic) {
  for (const auto& [a, b, c] :
       {std::array{2.0, 3.0, 5.0}, std::array{0.0, 3.0, 5.0}, std::array{2.0, 0.0, 5.0},
        std::array{1e-12, 1.0, 1.0}, std::array{1e8, 1.0, 1e-9}, std::array{1.0, 1e8, 1e-8}}) {
    const double w = cubic_root(a, b, c);
    EXPECT_GT(w, 0.0);
    EXPECT_NEAR(w * w * (a * w + b), c, 1e-13 * c) << a << ' ' << b << ' ' << c;
  }
  EXPECT_EQ(cubic_root(1.0, 1.0, 0.0), 0.0);
}

}  // namespace
}  // namespace granvof::closures
