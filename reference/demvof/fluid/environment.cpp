// OpenFOAM reads its etc/controlDict while its libraries are loaded, before main(): the variable that leads
// to it must be set earlier still. This is a shared library of its own, linked last, whose constructor the
// loader therefore runs before those of OpenFOAM.
#include <cstdlib>

namespace {

__attribute__((constructor)) void lead_to_etc() {
  ::setenv("WM_PROJECT_DIR", "/usr/share/openfoam", 0);
}

}  // namespace
