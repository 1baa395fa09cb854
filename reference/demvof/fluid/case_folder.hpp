// The dictionaries that OpenFOAM reads from files: written to a scratch folder, removed with the object.
#pragma once

#include <string>

namespace demvof {

class CaseFolder {
 public:
  // Creates <parent>/fluid-<process id> with system/controlDict, fvSchemes and fvSolution. Throws
  // std::runtime_error if the folder cannot be written or OpenFOAM's own etc folder is missing.
  explicit CaseFolder(std::string parent);
  ~CaseFolder();
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;
  CaseFolder(CaseFolder&&) = delete;
  CaseFolder& operator=(CaseFolder&&) = delete;

  const std::string& parent() const { return parent_; }
  const std::string& name() const { return name_; }

 private:
  std::string parent_, name_;
};

}  // namespace demvof
