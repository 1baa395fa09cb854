// Included first in every source of the fluid. clang, and so clang-tidy, rejects [[deprecated]] where
// OpenFOAM's headers put it (between type and name of a function); GCC takes no notice.
#pragma once

#ifdef __clang__
#include "stdFoam.H"
#undef FOAM_DEPRECATED
#undef FOAM_DEPRECATED_FOR
#define FOAM_DEPRECATED(since)
#define FOAM_DEPRECATED_FOR(since, replacement)
#endif
