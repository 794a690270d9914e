// Makes a planner ready beside the loop: its tables take longer than a cycle has.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "planner/search/planner.hpp"

namespace ivo::firmware {

/// All calls from one thread; the work is done in another, of ordinary priority.
class PlanMaker {
 public:
  PlanMaker() = default;
  PlanMaker(const PlanMaker&) = delete;
  PlanMaker& operator=(const PlanMaker&) = delete;
  ~PlanMaker() { wait(); }

  /// `planner` is nobody else's until done(). What `problem` points to stays as it is until then, but for
  /// `problem.searched`, which is copied.
  void begin(planner::Planner& planner, const planner::SearchProblem& problem);
  [[nodiscard]] bool busy() const noexcept { return thread_.joinable(); }
  /// It has ended: with the planner ready, or refused. True once; then busy() is false.
  [[nodiscard]] bool done();
  [[nodiscard]] const planner::Refusal& refusal() const noexcept { return refusal_; }

 private:
  void wait();

  std::unique_ptr<planner::SearchProblem> problem_;
  std::unique_ptr<planner::CellSet> searched_;
  planner::Refusal refusal_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace ivo::firmware
