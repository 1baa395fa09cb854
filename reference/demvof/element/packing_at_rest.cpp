#include "reference/demvof/element/packing_at_rest.hpp"

#include "reference/demvof/preparation/settle.hpp"

namespace demvof {

PackingAtRest packing_at_rest(LayerSettings settings, const ContactLaw& preparation, int repeats) {
  const ContactLaw law = settings.law;
  settings.law = preparation;
  settings.flows = false;
  std::vector<double> packings;
  PackingAtRest result;
  for (int repeat = 0; repeat < repeats; ++repeat, ++settings.seed) {
    PeriodicLayer layer(settings);
    settle(layer.engine(), nearly_still);
    layer.engine().set_contact_law(law);
    settle(layer.engine(), quite_still);
    const Profile profile = layer.window(samples_per_window);
    double sum = 0.0, load = 0.0, bins = 0.0;
    for (std::size_t edge = 1; edge + 1 < profile.solid.size(); ++edge) {
      if (!layer.counts(profile, edge)) continue;
      sum += 0.5 * (profile.solid[edge - 1] + profile.solid[edge]);
      load += layer.mass_above(profile, edge) * settings.gravity;
      bins += 1.0;
    }
    packings.push_back(sum / bins);
    result.load += load / bins / repeats;
  }
  result.solid_fraction = mean_of(packings);
  return result;
}

}  // namespace demvof
