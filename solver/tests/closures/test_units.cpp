// Units of every closure: in other units of mass, length and time its value changes by its dimension alone.
//
// Laws that stand for each other are walked by their lists, so that a new one is tried by itself; a closure
// that is tried nowhere here is named.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "solver/closures/agitation_drag.hpp"
#include "solver/closures/bumpy_wall.hpp"
#include "solver/closures/contact_friction.hpp"
#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/drag/drag.hpp"
#include "solver/closures/elastic_energy.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/closures/packing/laws.hpp"
#include "solver/closures/point_on_law.hpp"
#include "solver/closures/restitution.hpp"
#include "solver/closures/shear_dilatancy.hpp"
#include "solver/closures/slope_limiter/laws.hpp"
#include "solver/closures/smagorinsky.hpp"
#include "solver/closures/solid_pressure.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::closures {
namespace {

// How many new units one SI unit is.
struct Units {
  double kg;
  double m;
  double s;

  double number() const { return 1.0; }
  double mass_per_time() const { return kg / s; }
  double density() const { return kg / (m * m * m); }
  double drag() const { return density() / s; }
  double viscosity() const { return kg / (m * s); }
  double pressure() const { return kg / (m * s * s); }
  double power() const { return pressure() / s; }
  double speed() const { return m / s; }
  double theta() const { return speed() * speed(); }
  double per_theta() const { return density() / s; }  // of a power, as beta is of drag
  double per_theta_to_3_2() const { return power() / (theta() * speed()); }
};
using Unit = double (Units::*)() const;

constexpr Units si{1.0, 1.0, 1.0};
constexpr Units other{3.0, 7.0, 0.2};

// What closures take, in the given units: glass beads in water, sheared at 10 1/s under 100 Pa.
struct Given {
  explicit Given(const Units& u)
      : gas{.density = 1.0 * u.density(), .viscosity = 1e-5 * u.viscosity()},
        liquid{.density = 1000.0 * u.density(), .viscosity = 1e-3 * u.viscosity()},
        solid{.density = 2500.0 * u.density(), .diameter = 8e-4 * u.m, .restitution = 0.9, .friction = 0.4},
        theta(0.04 * u.theta()),
        slip(0.3 * u.speed()),
        pressure(100.0 * u.pressure()),
        shear(10.0 / u.s),
        length(2e-3 * u.m) {
    contact.stiffness *= u.pressure();
    contact.regularisation *= u.s;
    e = effective_restitution(solid.restitution, theta, solid.density, solid.diameter, liquid.viscosity);
    scene.gas = gas;
    scene.liquid = liquid;
    scene.solid = solid;
    scene.contact = contact;
  }
  Collisions collisions(bool correlated = false) const {
    Collisions laws(scene);
    laws.correlated = correlated;
    return laws;
  }
  SolidLaw law(bool correlated = false) const {
    SolidLaw law(scene);
    law.collisions = collisions(correlated);
    return law;
  }
  GrainsOfCell cell() const { return {theta, e, 0.0, 0.575, liquid.viscosity * shear}; }
  double g0() const { return collisions().g0(f_s); }

  Fluid gas, liquid;
  Solid solid;
  Contact contact;
  Scene scene;
  double theta, slip, pressure, shear, length;
  double f_s = 0.58, e = 0.0;
};

struct Law {
  std::string name;
  Unit unit;
  std::function<double(const Given&)> value;
  double tolerance = 1e-12;  // of what is solved for
};

// value(law, given) of each law of a list.
template <typename List, typename Value>
void add_each(std::vector<Law>& laws, const std::string& name, Unit unit, Value value) {
  for (std::size_t place = 0; place < List::facts.size(); ++place)
    laws.push_back({name + ", " + std::string(List::facts[place].word), unit, [=](const Given& g) {
                      return List::with(place, [&](auto law) { return static_cast<double>(value(law, g)); });
                    }});
}

// Theta of a cell that shear feeds, as the model has it: after a step, in balance, or none.
template <typename Model>
double theta_of(Model model, const Given& g) {
  if (!model.agitates) return 0.0;
  const double collisions = g.collisions().dissipation_rate(g.f_s, g.e, g.solid.density, g.solid.diameter);
  const double inertia = model.is_transported ? 1.5 * g.f_s * g.solid.density * g.shear : 0.0;
  const double decay =
      3.0 * drag_coefficient(DragPaper{}, g.f_s, 1.0, g.slip, g.gas, g.liquid, g.solid.diameter);
  const double fed = g.liquid.viscosity * g.shear * g.shear + inertia * g.theta;
  const double w = cubic_root(collisions, inertia + decay, fed);
  return w * w;
}

std::vector<Law> of_lists() {
  std::vector<Law> laws;
  for (const double f_s : {0.1, 0.2, 0.55}) {  // of (8) both branches, and between them
    add_each<DragLaws>(laws, "drag", &Units::drag, [=](auto law, const Given& g) {
      return drag_coefficient(law, f_s, 0.6, g.slip, g.gas, g.liquid, g.solid.diameter);
    });
  }
  add_each<DragLaws>(laws, "drag on a grain", &Units::mass_per_time, [](auto law, const Given& g) {
    return drag_on_grain(law, 0.3, 0.6, g.slip, g.gas, g.liquid, g.solid.diameter);
  });
  add_each<FrictionLaws>(laws, "friction", &Units::number, [](auto law, const Given& g) {
    return law.coefficient({g.pressure, 0.5 * g.shear, g.liquid.viscosity}, g.solid, g.contact);
  });
  add_each<Packings>(laws, "packing", &Units::number, [](auto law, const Given& g) {
    return law.at_start([&] { return packing_that_bears(g.pressure, g.f_s, g.contact); }, g.contact);
  });
  add_each<TemperatureModels>(laws, "granular temperature", &Units::theta,
                              [](auto model, const Given& g) { return theta_of(model, g); });
  add_each<KineticTransports>(laws, "kinetic viscosity", &Units::viscosity, [](auto law, const Given& g) {
    return law.viscosity(g.f_s, g.e, g.g0()) *
           kinetic_viscosity(g.f_s, g.theta, g.e, g.g0(), g.solid.density, g.solid.diameter);
  });
  add_each<KineticTransports>(laws, "conductivity", &Units::viscosity, [](auto law, const Given& g) {
    return law.conductivity(g.f_s, g.e, g.g0()) *
           kinetic_viscosity(g.f_s, g.theta, g.e, g.g0(), g.solid.density, g.solid.diameter);
  });
  add_each<SlopeLimiters>(laws, "slope", &Units::pressure,
                          [](auto law, const Given& g) { return law.slope(g.pressure, 3.0 * g.pressure); });
  add_each<CriticalPackings>(laws, "critical packing", &Units::number, [](auto law, const Given& g) {
    return law.packing(
        mixed_inertial_number(g.shear, g.pressure, g.solid.density, g.solid.diameter, g.liquid.viscosity),
        g.contact);
  });
  add_each<RadialDistributions>(laws, "kinetic pressure", &Units::pressure, [](auto law, const Given& g) {
    return kinetic_pressure(g.f_s, g.theta, g.e, law.value(g.f_s, g.collisions().of_g0), g.solid.density);
  });
  add_each<RadialDistributions>(laws, "slope of g0", &Units::number, [](auto law, const Given& g) {
    return law.slope(g.f_s, g.collisions().of_g0);
  });
  return laws;
}

std::vector<Law> of_fluids() {
  return {
      {"eddy viscosity", &Units::viscosity,
       [](const Given& g) { return eddy_viscosity(g.liquid.density, g.length, 0.5 * g.shear * g.shear); }},
      {"viscosity of a suspension", &Units::viscosity,
       [](const Given& g) {
         return g.liquid.viscosity * suspension_viscosity(g.f_s, g.contact.solid_fraction_max);
       }},
      {"C_D Re", &Units::number,
       [](const Given& g) {
         return drag_times_reynolds(g.liquid.density * g.slip * g.solid.diameter / g.liquid.viscosity);
       }},
      {"drag of a bed", &Units::drag,
       [](const Given& g) { return drag_ergun(0.5, g.slip, g.liquid, g.solid.diameter); }},
      {"drag of dispersed grains", &Units::drag,
       [](const Given& g) { return drag_wen_yu(0.1, g.slip, g.liquid, g.solid.diameter); }},
      {"drag of the paper", &Units::drag,
       [](const Given& g) { return drag_paper(0.2, g.slip, g.liquid, g.solid.diameter); }},
      {"drag by a force", &Units::drag,
       [](const Given& g) {
         return drag_of_force([](double f, double re) { return 1.0 + f + re; }, 0.2, g.slip, g.liquid,
                              g.solid.diameter);
       }},
  };
}

std::vector<Law> of_collisions() {
  return {
      {"restitution", &Units::number, [](const Given& g) { return g.e; }},
      {"frictional restitution", &Units::number,
       [](const Given& g) { return frictional_restitution(g.e, g.solid.friction); }},
      {"g0 near jamming", &Units::number, [](const Given& g) { return jamming_amplitude(g.solid.friction); }},
      {"correlation length", &Units::number,
       [](const Given& g) { return correlation_length(g.f_s, g.e, g.g0()); }},
      {"viscosity of a scene", &Units::viscosity,
       [](const Given& g) {
         return g.collisions().viscosity(g.f_s, g.theta, g.e, g.solid.density, g.solid.diameter);
       }},
      {"dissipation", &Units::power,
       [](const Given& g) {
         return collisional_dissipation_rate(g.f_s, g.e, g.g0(), g.solid.density, g.solid.diameter) *
                g.theta * std::sqrt(g.theta);
       }},
      {"dissipation, correlated", &Units::per_theta_to_3_2,
       [](const Given& g) {
         return g.collisions(true).dissipation_rate(g.f_s, g.e, g.solid.density, g.solid.diameter);
       }},
      {"dissipation of an expansion", &Units::per_theta,
       [](const Given& g) {
         return expansion_dissipation_rate(g.f_s, g.e, g.g0(), g.solid.density, -0.3 * g.shear);
       }},
      {"Theta in balance", &Units::theta,
       [](const Given& g) {
         const double a = collisional_dissipation_rate(g.f_s, g.e, g.g0(), g.solid.density, g.solid.diameter);
         return std::pow(positive_root(a, g.solid.density * g.shear, g.solid.density * g.shear * g.slip), 2);
       }},
      {"slip on bumps", &Units::speed,
       [](const Given& g) { return bumpy_wall_slip(1.0) * std::sqrt(g.theta); }},
      {"loss to bumps", &Units::pressure,
       [](const Given& g) { return bumpy_wall_loss(0.7) * g.solid.density * g.theta; }},
      {"drag on agitation", &Units::drag,
       [](const Given& g) {
         return agitated_drag(g.solid.density * g.slip / g.solid.diameter, g.f_s, g.pressure, g.solid.density,
                              g.solid.diameter);
       }},
      {"friction by agitation", &Units::number,
       [](const Given& g) {
         return agitation_friction(g.liquid.viscosity / (g.solid.diameter * g.solid.diameter), g.pressure,
                                   0.5 * g.shear, g.solid.density, g.solid.diameter);
       }},
  };
}

std::vector<Law> of_contacts() {
  return {
      {"elastic pressure", &Units::pressure,
       [](const Given& g) { return elastic_pressure(g.f_s, g.contact).value; }},
      {"its slope", &Units::pressure,
       [](const Given& g) { return elastic_pressure(g.f_s, g.contact).slope; }},
      {"elastic energy", &Units::pressure,
       [](const Given& g) { return ElasticEnergy(g.contact)(g.f_s, 0.572); }},
      {"dense pressure", &Units::pressure,
       [](const Given& g) { return dense_pressure(g.f_s, g.theta, g.e, g.solid.density, g.contact).value; }},
      {"dense pressure, correlated", &Units::pressure,
       [](const Given& g) { return dense_pressure(g.f_s, g.cell(), g.law(true)).slope; }},
      {"pressure of a flow", &Units::pressure,
       [](const Given& g) { return flow_pressure(g.f_s, g.cell(), g.law()).value; }},
      {"pressure of viscous contacts", &Units::pressure,
       [](const Given& g) { return viscous_pressure(g.f_s, g.cell(), g.law()).value; }},
      {"its law", &Units::pressure,
       [](const Given& g) {
         return viscous_contact_pressure(g.f_s, g.contact.solid_fraction_max, g.liquid.viscosity * g.shear)
             .slope;
       }},
      {"solid pressure", &Units::pressure,
       [](const Given& g) { return solid_pressure(g.f_s, g.cell(), g.law()).value; }},
      {"slope of the solid pressure", &Units::pressure,
       [](const Given& g) { return solid_pressure(g.f_s, g.cell(), g.law()).slope; }},
      {"enduring pressure", &Units::pressure,
       [](const Given& g) { return enduring_pressure(g.f_s, g.cell(), g.law()); }},
      {"friction viscosity", &Units::viscosity,
       [](const Given& g) {
         return friction_viscosity(g.pressure, 0.4, g.contact.regularisation, 2e-6 * g.shear);
       }},
      {"viscosity of collisions, bounded", &Units::viscosity,
       [](const Given& g) {
         return bounded_kinetic_viscosity(g.liquid.viscosity, g.pressure, 0.4, g.contact.regularisation,
                                          g.shear);
       }},
      {"friction that arrests", &Units::number,
       [](const Given& g) { return arrest_friction(g.length, 0.4, 0.6, 1.65, g.solid.diameter); }},
      {"friction between", &Units::number,
       [](const Given& g) { return friction_between(0.4, 0.6, g.slip, g.shear * g.length); }},
      {"mixed inertial number", &Units::number,
       [](const Given& g) {
         return mixed_inertial_number(g.shear, g.pressure, g.solid.density, g.solid.diameter,
                                      g.liquid.viscosity);
       }},
      {"bounded critical packing", &Units::number,
       [](const Given& g) { return bounded_critical_packing(0.2, g.f_s, g.contact); }},
      {"tangent of dilatancy", &Units::number,
       [](const Given& g) { return dilatancy_tangent(0.6, g.contact); }},
      {"sheared packing", &Units::number,
       [](const Given& g) { return sheared_packing(0.6, 0.1, g.contact); }},
      {"packing that bears", &Units::number,
       [](const Given& g) { return packing_that_bears(g.pressure, g.f_s, g.contact); }},
      {"point on the law", &Units::number,
       [](const Given& g) {
         const auto law = [&](double f) { return elastic_pressure(f, g.contact); };
         return point_on_law(law, 0.56, 3.0 * g.pressure, 1e-4 / g.pressure);
       },
       1e-8},
  };
}

TEST(Units, EveryClosureIsDimensionallyConsistent) {
  const Given in_si(si), in_other(other);
  std::set<std::string> none;
  for (const auto& laws : {of_lists(), of_fluids(), of_collisions(), of_contacts()}) {
    for (const Law& law : laws) {
      const double a = law.value(in_si), b = law.value(in_other), factor = (other.*law.unit)();
      if (a == 0.0) {
        EXPECT_EQ(b, 0.0) << law.name;
        none.insert(law.name);
        continue;
      }
      EXPECT_GT(a, 0.0) << law.name;
      EXPECT_NEAR(b / a / factor, 1.0, law.tolerance) << law.name;
    }
  }
  EXPECT_EQ(none, (std::set<std::string>{"granular temperature, off", "slope, upwind"}));
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

TEST(Units, AreAskedOfEveryClosure) {
  const auto root = cases_directory().parent_path();
  const std::string here = text_of(root / "solver/tests/closures/test_units.cpp");
  // a closure is a function that gives a number, or a number and its slope; a list is of laws
  const std::regex declared(R"((?:double|PressureAndSlope) (\w+)\(|struct (\w+) : Choices<)");
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "solver/closures")) {
    if (entry.path().extension() != ".hpp") continue;
    std::istringstream lines(text_of(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      std::smatch name;
      const bool indented =
          line.starts_with(' ') || line.starts_with('/');  // a member: of a law or an object
      if (!indented && std::regex_search(line, name, declared))
        found.insert(name[1].matched ? name[1] : name[2]);
    }
  }
  EXPECT_GT(found.size(), 40U);
  for (const std::string& name : found)
    EXPECT_TRUE(std::regex_search(here, std::regex("\\b" + name + "\\b"))) << name << " is tried in no units";
}

}  // namespace
}  // namespace granvof::closures
