#include <chrono>
#include <filesystem>
#include <limits>
#include <utility>

#include "firmware/tools/colonies.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/plan_options.hpp"
#include "firmware/tools/plan_terminal.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/result_files.hpp"
#include "firmware/tools/stop_signal.hpp"

namespace ivo::firmware {
namespace {

using SteadyClock = std::chrono::steady_clock;

double seconds_since(SteadyClock::time_point begin) {
  return std::chrono::duration<double>(SteadyClock::now() - begin).count();
}

void override_mission(const PlanOptions& options, Mission& mission) {
  mission.planner.profile = options.profile.value_or(mission.planner.profile);
  mission.planner.heuristic = options.heuristic.value_or(mission.planner.heuristic);
  mission.seed = options.seed.value_or(mission.seed);
  const int without_iterations = options.time_limit_s ? std::numeric_limits<int>::max() : mission.planner.generations;
  mission.planner.generations = options.iterations.value_or(without_iterations);
}

/// Searches to the end, the limit or a signal, but not before there is a plan unless a signal asks for it.
double search(Colonies& colonies, const PlanOptions& options, const PlanView& view) {
  LiveLine line;
  const SteadyClock::time_point begin = SteadyClock::now();
  for (bool more = true; more;) {
    const planner::Progress progress = colonies.search_on();
    const double elapsed_s = seconds_since(begin);
    const bool out_of_time = options.time_limit_s && elapsed_s >= *options.time_limit_s && progress.has_plan;
    more = !progress.done && !out_of_time && !stop_asked();
    if (options.time_limit_s && !options.iterations) {
      show_progress(line, view, progress, {.elapsed_s = elapsed_s, .limit_s = *options.time_limit_s});
    } else {
      show_progress(line, view, progress);
    }
  }
  line.end();
  return seconds_since(begin);
}

}  // namespace

int plan(const PlanOptions& options) {
  end_on_signals("ivo: stopped before there was a plan; nothing was written\n");
  Result<MissionInputs> read = read_inputs(options.mission);
  if (!read) {
    return refuse(read.error());
  }
  MissionInputs inputs = std::move(read).value();
  override_mission(options, inputs.file.mission);
  planner::Planner& planner = the_planner();
  Result<Colonies> colonies = Colonies::create(planner, options.threads);
  if (!colonies) {
    return refuse(colonies.error());
  }
  const SteadyClock::time_point begin = SteadyClock::now();
  if (const Result<void> prepared = prepare(planner, inputs); !prepared) {
    return refuse(prepared.error());
  }
  colonies.value().start();
  const double prepare_s = seconds_since(begin);
  const std::string out =
      options.out.empty() ? "out/" + std::filesystem::path(options.mission).stem().string() : options.out;
  if (const Result<void> opened = open_folder(out, {"plan.json", "search.png"}); !opened) {
    return refuse(opened.error());
  }

  const PlanView view{inputs, planner};
  show_mission(view);
  stop_on_signals();
  const double search_s = search(colonies.value(), options, view);
  const planner::Progress progress = colonies.value().progress();
  if (!progress.has_plan) {
    complain({"stopped before there was a plan; nothing was written"});
    return exit_status::kFaultOrStop;
  }
  static planner::Plan best;  // large
  colonies.value().best_plan(best);
  show_score(view, best.score);
  show_paths(view, best);
  say("time", format("graph and tables %.2f s, search %.2f s, ", prepare_s, search_s) +
                  counted(progress.generation, "generation"));
  const PlanSearch how{.generations_done = progress.generation, .threads = options.threads};
  const bool plan_kept = keep(out + "/plan.json", plan_json(plan_document(view, best, how)));
  const bool picture_kept = keep(out + "/search.png", picture_png(plan_picture(view, best, "plan")));
  if (stop_asked()) {
    say("stopped", "on request; this is the best plan until then");
  }
  return plan_kept && picture_kept && !stop_asked() ? exit_status::kEnded : exit_status::kFaultOrStop;
}

}  // namespace ivo::firmware
