// The rows of Table I as problems, without files: the fixed-point build has the planner alone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "planner/search/planner.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::cross {

struct PaperRow {
  bool m2 = false;
  bool peaked = false;  ///< two Gaussians, else uniform
  bool sub_priors = false;
};

/// "M1/G/S"
[[nodiscard]] inline std::string name_of(PaperRow row) {
  return std::string(row.m2 ? "M2" : "M1") + (row.peaked ? "/G" : "/U") + (row.sub_priors ? "/S" : "");
}

/// Owns what the problem's views point into.
class PaperCase {
 public:
  explicit PaperCase(PaperRow row) {
    if (row.m2) {
      draw_m2();
    }
    problem_.map = map_.view();
    problem_.agents.resize(2);
    problem_.agents[0].body.start = {1.75, 1.75};
    problem_.agents[1].body.start = {39.25, 1.75};
    problem_.agents[0].speed_mps = problem_.agents[1].speed_mps = 1.0;
    if (row.peaked) {
      problem_.prior = std::span<const planner::GaussianComponent>(gaussians_);
    }
    if (row.sub_priors && row.peaked) {
      problem_.sub_priors = planner::DealtComponents{nearest_};
    } else if (row.sub_priors) {
      problem_.sub_priors = planner::AlikeSubPriors{};
    }
  }
  PaperCase(const PaperCase&) = delete;
  PaperCase& operator=(const PaperCase&) = delete;

  /// To change before it is used.
  [[nodiscard]] planner::SearchProblem& problem() { return problem_; }

 private:
  // As toolchain/maps/m2.py draws it.
  void draw_m2() {
    using enum SemanticClass;
    map_.put(kBuilding, 5, 26, 13, 34).put(kPavement, 9, 26, 13, 29).put(kBuilding, 24, 29, 34, 35);
    map_.put(kBuilding, 27, 10, 35, 16).put(kPavement, 27, 10, 30, 12).put(kBuilding, 7, 7, 12, 13);
    map_.put(kWall, 16, 16, 16.5, 24).put(kWall, 16, 16, 20, 16.5).put(kWall, 23.5, 16, 24, 21);
    map_.put(kWall, 19.5, 23.5, 24, 24).put(kWall, 4, 19, 11, 19.5).put(kWall, 17.5, 4, 18, 11);
    map_.put(kWall, 22, 5.5, 30, 6).put(kWall, 29, 21, 36, 21.5).put(kWall, 28.75, 21, 29.25, 25);
    map_.put(kWall, 17.5, 29, 18, 36);
  }

  test::DrawnMap map_{40.0, 40.0, 0.25};
  std::vector<planner::GaussianComponent> gaussians_ = {{{12.0, 12.0}, 4.0, 1.0}, {{30.0, 28.0}, 4.0, 1.0}};
  std::array<std::int8_t, 2> nearest_ = {0, 1};
  planner::SearchProblem problem_;
};

}  // namespace ivo::cross
