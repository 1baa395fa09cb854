#include "reference/demvof/fluid/case_folder.hpp"

#include <fstream>
#include <stdexcept>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

namespace demvof {

namespace {

const char* const dictionary_names[] = {"controlDict", "fvSchemes", "fvSolution"};

std::string header(const std::string& object) {
  return "FoamFile { version 2.0; format ascii; class dictionary; object " + object + "; }\n";
}

// Linear everywhere but for what is advected: van Leer for alpha, the settings' scheme for momentum, which
// does not ask here.
const char* const schemes = R"(
ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default none;
    div(phi,alpha) Gauss vanLeer;
    div(phirb,alpha) Gauss linear;
    div(viscous) Gauss linear;
}
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
fluxRequired { default no; p_rgh; pPredicted; alpha; }
)";

const char* const solution = R"(
solvers
{
    alpha { nAlphaCorr 1; nAlphaSubCycles 1; cAlpha 1; MULESCorr no; nLimiterIter 5; }
    p_rgh { solver PCG; preconditioner DIC; tolerance 1e-8; relTol 1e-3; maxIter 2000; }
    pPredicted { solver PCG; preconditioner DIC; tolerance 1e-8; relTol 1e-4; maxIter 2000; }
    p_rghFinal { solver PCG; preconditioner DIC; tolerance 1e-9; relTol 1e-6; maxIter 2000; }
}
PISO { }
)";

const char* const control = R"(
startFrom startTime; startTime 0; stopAt endTime; endTime 1e9; deltaT 1e-4;
writeControl none; writeInterval 1; runTimeModifiable false;
)";

void make_folder(const std::string& path) {
  if (::mkdir(path.c_str(), 0755) != 0 && ::access(path.c_str(), W_OK) != 0) {
    throw std::runtime_error("cannot create the folder " + path);
  }
}

}  // namespace

CaseFolder::CaseFolder(std::string parent) : parent_(std::move(parent)) {
  static int instances = 0;  // several fluids may live in one process (tests)
  name_ = "fluid-" + std::to_string(::getpid()) + "-" + std::to_string(instances++);
  const char* etc = "/usr/share/openfoam";
  if (::access(etc, R_OK) != 0) {
    throw std::runtime_error("OpenFOAM's etc folder /usr/share/openfoam is missing; run ci/setup-reference");
  }
  const std::string folder = parent_ + "/" + name_;
  make_folder(parent_);
  make_folder(folder);
  make_folder(folder + "/system");
  const char* const texts[] = {control, schemes, solution};
  for (int i = 0; i < 3; ++i) {
    std::ofstream file(folder + "/system/" + dictionary_names[i]);
    file << header(dictionary_names[i]) << texts[i];
    if (!file) throw std::runtime_error("cannot write to the folder " + folder);
  }
}

CaseFolder::~CaseFolder() {
  const std::string folder = parent_ + "/" + name_;
  for (const char* name : dictionary_names) ::unlink((folder + "/system/" + name).c_str());
  ::rmdir((folder + "/system").c_str());
  ::rmdir(folder.c_str());
}

}  // namespace demvof
