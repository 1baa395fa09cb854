// The packing that shear drives a bed to, that model.critical_packing chooses from. Each has
//   depends_on_rate, packing(J, Contact) -> [-].
#pragma once

#include "solver/closures/critical_packing/by_rate.hpp"
#include "solver/closures/critical_packing/constant.hpp"
#include "solver/model/laws.hpp"

namespace granvof::closures {

struct CriticalPackings : Choices<CriticalPackingConstant, CriticalPackingByRate> {};

inline bool depends_on_rate(CriticalPacking chosen) {
  return chosen.with([](auto law) { return law.depends_on_rate; });
}

}  // namespace granvof::closures
