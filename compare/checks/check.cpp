#include "compare/checks/check.hpp"

namespace granvof::compare {

std::string_view name_of(Frequency frequency) {
  switch (frequency) {
    case Frequency::verify:
      return "verify";
    case Frequency::short_:
      return "short";
    case Frequency::nightly:
      return "nightly";
    case Frequency::weekly:
      return "weekly";
  }
  return "weekly";
}

std::string_view name_of(ReferenceKind kind) {
  switch (kind) {
    case ReferenceKind::theory:
      return "theory";
    case ReferenceKind::published:
      return "published";
    case ReferenceKind::dem:
      return "DEM";
    case ReferenceKind::aim:
      return "aim";
    case ReferenceKind::regression:
      return "regression";
  }
  return "regression";
}

std::string_view name_of(Relation relation) {
  switch (relation) {
    case Relation::equal:
      return "equal";
    case Relation::at_most:
      return "at most";
    case Relation::at_least:
      return "at least";
  }
  return "equal";
}

}  // namespace granvof::compare
