// What a terminal shows of a mission and its plans, whether they are run, only planned or scored.
#pragma once

#include "firmware/tools/plan_documents.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {

/// Map, agents, prior, graph, and what is odd about them.
void show_mission(const PlanView& view);
/// How far a search is that time ends; without a limit generations end it.
struct SearchTime {
  double elapsed_s = 0.0;
  double limit_s = 0.0;
};
/// Generation, the best plan so far, and its gap.
void show_progress(LiveLine& line, const PlanView& view, const planner::Progress& progress, SearchTime time = {});
/// Each agent's way, and what is left unseen.
void show_paths(const PlanView& view, const planner::Plan& plan);
/// The bounds, and how far above them ET_c is.
void show_bound(const PlanView& view, const planner::PlanScore& score);
/// All figures of a score, a line each: ET, ET_c, EST, unseen mass, bounds and gap.
void show_score(const PlanView& view, const planner::PlanScore& score);

}  // namespace ivo::firmware
