// A plan as a document, a picture and one line, from what was read and planned.
#pragma once

#include <string>

#include "firmware/files/picture.hpp"
#include "firmware/files/plan_file.hpp"
#include "firmware/tools/planner_setup.hpp"

namespace ivo::firmware {

/// A mission and its planner. Both outlive it.
struct PlanView {
  const MissionInputs& inputs;
  const planner::Planner& planner;
};

/// How the plan was searched for, beyond what the mission says.
struct PlanSearch {
  int generations_done = 0;
  int threads = 1;
};

/// Bounds for a plan of this score, and how far above them it is (model.md, "Bounds": from ET_c, never from Eq. 8).
[[nodiscard]] BoundsDocument bounds_of(const PlanView& view, const planner::PlanScore& score);
/// One line: "76.1 s, strict 70.5 s; ET_c 77.0 s is 1.2 % above".
[[nodiscard]] std::string bound_text(const PlanView& view, const planner::PlanScore& score);
/// One line: what the team can expect of a plan.
[[nodiscard]] std::string score_text(const PlanView& view, const planner::PlanScore& score);
[[nodiscard]] ScoreDocument score_document(const PlanView& view, const planner::PlanScore& score);
[[nodiscard]] PlanDocument plan_document(const PlanView& view, const planner::Plan& plan, const PlanSearch& search);
/// Map, prior, starts, areas and plans; `title` beside the mission's name.
[[nodiscard]] SearchPicture plan_picture(const PlanView& view, const planner::Plan& plan, const std::string& title);

}  // namespace ivo::firmware
