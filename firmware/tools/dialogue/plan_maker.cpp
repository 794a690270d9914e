#include "firmware/tools/dialogue/plan_maker.hpp"

#include "hal/linux/real_time.hpp"

namespace ivo::firmware {

void PlanMaker::begin(planner::Planner& planner, const planner::SearchProblem& problem) {
  wait();
  problem_ = std::make_unique<planner::SearchProblem>(problem);
  if (problem.searched != nullptr) {
    searched_ = std::make_unique<planner::CellSet>(*problem.searched);
    problem_->searched = searched_.get();
  }
  ended_.store(false);
  thread_ = std::thread([this, &planner] {
    hal::name_thread("ivo-tables");
    hal::leave_signals_to_others();
    refusal_ = planner.prepare(*problem_);
    ended_.store(true);
  });
}

bool PlanMaker::done() {
  if (!thread_.joinable() || !ended_.load()) {
    return false;
  }
  wait();
  return true;
}

void PlanMaker::wait() {
  if (thread_.joinable()) {
    thread_.join();
  }
}

}  // namespace ivo::firmware
