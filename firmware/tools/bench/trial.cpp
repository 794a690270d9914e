#include "firmware/tools/bench/trial.hpp"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <mutex>
#include <thread>

#include "config/limits.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr planner::Budget kPart{100'000};

std::string refusal_text(const planner::Refusal& refusal) {
  using enum planner::RefusalCode;
  const char* what = "a start or a prior that it cannot use";
  switch (refusal.code) {
    case kTooManyCells:
      what = "cells";
      break;
    case kTooManySquares:
      what = "squares";
      break;
    case kTooManyNodes:
      what = "nodes";
      break;
    case kTooManyEdges:
      what = "edges";
      break;
    case kSightTableFull:
      what = "sight table rows";
      break;
    case kTooManySwaths:
      what = "swaths";
      break;
    default:
      return std::string("the planner refuses ") + what;
  }
  return format("more %s than the %.0f of this build's %s capacity", what, refusal.limit, limits::Planner::kName);
}

}  // namespace

double thread_seconds() {
  timespec now{};
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Result<double> prepare(planner::Planner& planner, const planner::SearchProblem& problem) {
  const double begin_s = thread_seconds();
  if (const planner::Refusal refusal = planner.prepare(problem)) {
    return Error{refusal_text(refusal)};
  }
  return thread_seconds() - begin_s;
}

Result<Found> search_to_end(planner::Planner& planner, const planner::SearchProblem& problem) {
  const Result<double> prepared = prepare(planner, problem);
  if (!prepared) {
    return prepared.error();
  }
  Found found;
  found.prepare_s = prepared.value();
  const double begin_s = thread_seconds();
  while (!planner.step(kPart).done) {
  }
  found.search_s = thread_seconds() - begin_s;
  const auto plan = std::make_unique<planner::Plan>();
  planner.best_plan(*plan);
  found.score = plan->score;
  found.bound_s = planner.bounds(found.score.unseen_mass).bound_s();
  for (const planner::AgentPath& path : plan->paths) {
    found.length_m += path.length_m;
  }
  return found;
}

Cores::Cores() {
  const unsigned cores = std::clamp(std::thread::hardware_concurrency(), 1U, 2U);
  for (unsigned i = 0; i < cores; ++i) {
    planners_.push_back(make_planner());
  }
}

void Cores::each(std::size_t count, const std::string& what,
                 const std::function<void(std::size_t, planner::Planner&)>& job) {
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex showing;
  LiveLine line;
  const auto work = [&](planner::Planner& planner) {
    for (std::size_t i = next++; i < count; i = next++) {
      job(i, planner);
      const std::lock_guard lock(showing);
      ++done;
      if (line.live() && line.due(static_cast<int>(done), static_cast<int>(count))) {
        line.draw("bench", what + format(": %zu of %zu", done, count));
      }
    }
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < planners_.size(); ++i) {
    others.emplace_back([&, i] { work(*planners_[i]); });
  }
  work(*planners_.front());
  for (std::thread& other : others) {
    other.join();
  }
  line.end();
}

}  // namespace ivo::firmware::bench
