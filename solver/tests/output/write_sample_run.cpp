// Writes two runs, 3D without joining and 2D joined, for check_with_python.py: write_sample_run DIRECTORY
#include <cstdio>
#include <exception>

#include "solver/output/run_writer.hpp"
#include "solver/tests/output/samples.hpp"

int main(int argc, char** argv) {
  using namespace granvof;
  if (argc != 2) return 2;
  try {
    for (const int dimensions : {2, 3}) {
      const auto scene = dimensions == 2 ? test::small_scene() : test::small_scene_3d();
      const auto directory = std::filesystem::path(argv[1]) / (dimensions == 2 ? "2d" : "3d");
      auto writer = RunWriter::fresh(directory, scene, {"granvof", "write_sample_run", 1, 1, {}}, {});
      for (const double time : {0.0, 0.5}) {
        auto fields = test::numbered_fields(scene, time);
        if (dimensions == 3) fields.p_s = fields.f_s;
        writer.write_series_row(time, {}, extract_scalars(fields, scene));
        writer.write_fields(fields);
      }
      if (dimensions == 2) writer.finish({}, {ExitState::finished, ""});
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
