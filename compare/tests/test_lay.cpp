#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compare/lay/lay.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {
namespace {

class Lay : public testing::Test {
 protected:
  compare::Run theirs(const std::string& text) const {
    const auto file = directory_.path() / "theirs.csv";
    std::ofstream(file) << text;
    return read_their_series(file, scene_);
  }

  std::string refusal(const std::string& text) const {
    try {
      theirs(text);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "accepted";
  }

  const test::TemporaryDirectory directory_;
  const Scene scene_ = load_scene(cases_directory() / "s1.toml");
  const double height_ = scene_.bed->box.upper[1] - scene_.bed->box.lower[1];
  const double tau_ = std::sqrt(height_ / scene_.gravity);
  // Our front moves h0 in 2 tau.
  const compare::Run ours_ =
      theirs("T [-],front_dilute [m]\n0,0.1\n2," + std::to_string(0.1 + height_) + "\n");
};

TEST_F(Lay, FrontsInMetresAgainstSecondsMeetOurs) {
  const compare::Run run = theirs("time [s],front_dilute [m]\n0,0.2\n" + std::to_string(2 * tau_) + "," +
                                  std::to_string(0.2 + 0.5 * height_) + "\n");
  const auto curves = lay(ours_, run);
  ASSERT_EQ(curves.size(), 2u);  // the derived run-out, and the front itself
  EXPECT_EQ(curves[0].name, "run_out");
  EXPECT_NEAR(*curves[0].ours_at_end, 1.0, 1e-3);
  EXPECT_NEAR(*curves[0].theirs_at_end, 0.5, 1e-3);
  EXPECT_NEAR(curves[0].window.end, 2.0, 1e-3);
  EXPECT_EQ(curves[1].name, "front_dilute");
}

TEST_F(Lay, RunOutMayBeGivenDirectly) {
  const auto curves = lay(ours_, theirs("T [-],run_out [-]\n0,0\n1,0.5\n4,2\n"));
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_NEAR(*curves[0].rms, 0.0, 1e-4);
  EXPECT_NEAR(*curves[0].theirs_at_end, 1.0, 1e-4);
}

TEST_F(Lay, AnEmptyFieldIsLeftOut) {
  const auto curves = lay(ours_, theirs("T [-],run_out [-]\n0,0\n1,\n2,1\n"));
  EXPECT_EQ(curves[0].theirs.size(), 2u);
}

TEST_F(Lay, BadInputIsNamed) {
  EXPECT_NE(refusal("time [s],speed [m/s]\n0,1\n").find("'speed' is not known; allowed: time, T, run_out"),
            std::string::npos);
  EXPECT_NE(refusal("time [s],front_dense [cm]\n0,1\n").find("is in 'cm', expected 'm'"), std::string::npos);
  EXPECT_NE(refusal("front_dense [m]\n1\n").find("one column 'time [s]' or 'T [-]' is needed, there are 0"),
            std::string::npos);
  EXPECT_NE(refusal("time [s],T [-]\n0,1\n").find("there are 2"), std::string::npos);
  EXPECT_NE(refusal("time [s],front_dense [m]\n0,nan\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusal("time [s],front_dense [m]\n0,1\n0,2\n").find("does not ascend from row 1 to row 2"),
            std::string::npos);
  EXPECT_NE(refusal("time [s],front_dense [m]\n1,1\n0,2\n").find("does not ascend"), std::string::npos);
  EXPECT_NE(refusal("time [s],front_dense [m],front_dense [m]\n0,1,2\n").find("'front_dense' is given twice"),
            std::string::npos);
  EXPECT_NE(refusal("time [ms],front_dense [m]\n0,1\n").find("expected 's'"), std::string::npos);
}

// Finite in the file, and beyond what differences, squares, areas or other units can hold.
TEST_F(Lay, WhatIsTooLargeToCompareIsRefused) {
  for (const char* text : {"time [s],front_dilute [m]\n0,1e308\n1,-1e308\n",
                           "time [s],front_dilute [m]\n-1.7e308,1\n1.7e308,2\n",
                           "time [s],run_out [-]\n0,1\n1.7e308,2\n1.75e308,2\n",
                           "time [s],p_base [Pa]\n0,1e200\n1e200,1e200\n"}) {
    const compare::Run run = theirs(text);
    EXPECT_THROW(lay(run, run), std::invalid_argument) << text;
  }
}

// What has no meaning, though every scalar of it would be a number.
TEST_F(Lay, FieldsWithoutAMeaningAreRefused) {
  const auto refusal_of = [&](const std::vector<double>& times, double f_s, double alpha) -> std::string {
    Scene coarse = scene_;
    coarse.grid.cells = {4, 2, 1};
    coarse.grid.spacing = {scene_.tank[0] / 4, scene_.tank[1] / 2, scene_.tank[2]};
    FieldsFile file = FieldsFile::create(directory_.path(), coarse);
    for (const double time : times) {
      CellFields fields;
      fields.time = time;
      fields.cells = coarse.grid.cells;
      fields.spacing = coarse.grid.spacing;
      for (auto* values : {&fields.f_s, &fields.alpha, &fields.p_c, &fields.p_s, &fields.theta, &fields.phi,
                           &fields.u_s[0], &fields.u_s[1], &fields.u_c[0], &fields.u_c[1]})
        values->assign(8, 0.25);
      fields.f_s[5] = f_s;
      fields.alpha[5] = alpha;
      file.append(fields);
    }
    file.bring_up_to_date();
    try {
      read_their_fields(directory_.path() / "fields.h5", scene_);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal_of({0.0, 1.0}, 0.5, 0.5), "accepted");
  EXPECT_EQ(refusal_of({0.0}, -0.04, 1.04), "accepted");  // an overshoot of their fluxes
  EXPECT_NE(refusal_of({}, 0.5, 0.5).find("it holds no instant"), std::string::npos);
  EXPECT_NE(refusal_of({0.0, 0.0}, 0.5, 0.5).find("instant 2 is of t = 0 s"), std::string::npos);
  EXPECT_NE(refusal_of({2.0, 1.0}, 0.5, 0.5).find("instant 2 is of t = 1 s"), std::string::npos);
  EXPECT_NE(refusal_of({-1.0}, 0.5, 0.5).find("instant 1 is of t = -1 s"), std::string::npos);
  EXPECT_NE(refusal_of({0.0}, 2.0, 0.5).find("f_s is 2 in a cell, allowed: 0 to 1"), std::string::npos);
  EXPECT_NE(refusal_of({0.0}, 0.5, -0.1).find("alpha is -0.1 in a cell, allowed: 0 to 1"), std::string::npos);
}

// Fields of a box that is a hundredth longer than the tank are those of another scene; of the tank's own they
// are read.
TEST_F(Lay, FieldsOfAnotherBoxAreRefused) {
  const auto read = [&](double longer) {
    Scene coarse = scene_;
    coarse.grid.cells = {4, 2, 1};
    coarse.grid.spacing = {scene_.tank[0] * longer / 4, scene_.tank[1] / 2, scene_.tank[2]};
    CellFields fields;
    fields.cells = coarse.grid.cells;
    fields.spacing = coarse.grid.spacing;
    for (auto* values : {&fields.f_s, &fields.alpha, &fields.p_c, &fields.p_s, &fields.theta, &fields.phi,
                         &fields.u_s[0], &fields.u_s[1], &fields.u_c[0], &fields.u_c[1]})
      values->assign(8, 0.25);
    FieldsFile file = FieldsFile::create(directory_.path(), coarse);
    file.append(fields);
    file.bring_up_to_date();
    return read_their_fields(directory_.path() / "fields.h5", scene_);
  };
  EXPECT_EQ(read(1.0).series.rows.size(), 1u);
  try {
    read(1.01);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {  // by the file and the scene that they name
    EXPECT_NE(
        std::string(error.what()).find("fields.h5: the box is 0.404 m in direction 0, the tank of s1 0.4 m"),
        std::string::npos)
        << error.what();
  }
}

TEST_F(Lay, WhatNeitherHasIsLeftOut) {
  const compare::Run zero = theirs("T [-],run_out [-],f_s_max [-]\n0,0,0\n2,1,0\n");
  EXPECT_EQ(lay(zero, zero).size(), 1u);
}

TEST_F(Lay, NothingInCommonIsAnError) {
  EXPECT_THROW(lay(ours_, theirs("time [s],p_base [Pa]\n0,1\n1,2\n")), std::invalid_argument);
  EXPECT_THROW(lay(ours_, theirs("T [-],run_out [-]\n5,1\n6,2\n")), std::invalid_argument);
}

TEST_F(Lay, JsonHoldsBothCurves) {
  const auto json = nlohmann::json::parse(
      lay_json(lay(ours_, theirs("T [-],run_out [-]\n0,0\n2,1\n")), ours_, "a laboratory"));
  EXPECT_EQ(json.at("theirs"), "a laboratory");
  EXPECT_EQ(json.at("curves").at(0).at("theirs").at("y").size(), 2u);
}

}  // namespace
}  // namespace granvof::compare
