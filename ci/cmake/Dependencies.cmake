# Every library the project links, all from Debian 12; docs/dependencies.md says what each is for.
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(HDF5 REQUIRED COMPONENTS C HL)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(MPI QUIET COMPONENTS C)  # optional: without it granvof runs as one process
find_package(GTest REQUIRED)
include(GoogleTest)
