// Dimensions of the units that keys and columns are stated in, and what other units make of a value.
#pragma once

#include <optional>
#include <string_view>

namespace granvof {

// Exponents of mass, length and time.
struct Dimension {
  int mass = 0, length = 0, time = 0;
  bool operator==(const Dimension&) const = default;
  bool none() const { return *this == Dimension{}; }
};

// Of a unit as keys and columns state it: factors kg, m, s, Pa, J with an exponent behind them, apart by
// blanks, those behind the slash divide ("kg/m3 s" is kg m^-3 s^-1). "", "-", angles ("deg", "degrees") and
// "wall-clock s" have none. Nothing for any other text.
std::optional<Dimension> dimension_of(std::string_view unit);

// How many times larger the numbers become that state a mass, a length, a time; all > 0.
struct UnitFactors {
  double mass = 1.0, length = 1.0, time = 1.0;
  double of(const Dimension& dimension) const;
};

}  // namespace granvof
