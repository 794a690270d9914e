// What people agree on with the robot at its console: areas, plans, who is where, what is found. Between the console's
// desk and the loop; the run's thread turns it between cycles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/console/console_desk.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/mission/searched_map.hpp"
#include "firmware/tools/dialogue/drawn_areas.hpp"
#include "firmware/tools/dialogue/plan_maker.hpp"
#include "firmware/tools/dialogue/shown_documents.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/run_documents.hpp"

namespace ivo::firmware {

class Dialogue {
 public:
  /// `inputs` are what was read, `planner` is prepared for them and the loop's; all outlive this. A plan that is made
  /// anew changes the areas of `inputs`. Takes the memory of a second planner.
  Dialogue(MissionInputs& inputs, planner::Planner& planner, const SearchObject& object, ControlLoop& loop,
           console::ConsoleDesk& desk);

  /// Before the first observe(): the areas at `path`, where they are kept from now on, take the place of the mission's
  /// if the search is `taken_up`. Refuses a file there that holds none.
  [[nodiscard]] Result<void> keep_areas_at(const std::string& path, bool taken_up);
  /// What an earlier run of this search has seen, by where its agents were.
  void take_up(const std::vector<std::vector<Point>>& tracks);

  /// Takes what clients want and where they are, and lays down what is new.
  void observe(const LoopStatus& status);
  /// Adds to the console's status what the loop does not know.
  void complete(console::Status& status) const;
  /// A plan is being made anew: nothing is to be agreed to.
  [[nodiscard]] bool preparing() const noexcept { return step_ != Step::kIdle; }
  /// The plan leads somebody into an area that was closed after it was made: nobody is to set off.
  [[nodiscard]] bool may_not_set_off() const noexcept { return into_no_go_.has_value(); }
  /// What was read, and the planner of the loop's plan; changes with observe().
  [[nodiscard]] const RunView& view() const noexcept { return views_[current_]; }
  /// Why the areas are not kept; none while they are.
  [[nodiscard]] const std::optional<Error>& failure() const noexcept { return failure_; }
  void show_report(std::string report) { (void)desk_.documents().put(console::Document::kReport, std::move(report)); }

 private:
  enum class Step : std::uint8_t {
    kIdle,
    kHalting,    ///< the robot is to stand before anybody's place counts as a start
    kPreparing,  ///< tables
    kHandedOver  ///< the loop has not taken them up yet
  };

  /// Of a plan as it was shown.
  struct PlanMark {
    std::uint32_t number = 0;
    int generation = 0;
    bool ready = false;
    friend bool operator==(const PlanMark&, const PlanMark&) = default;
  };

  void take_requests();
  void take_poses();
  void go_on(const LoopStatus& status);
  void prepare(const LoopStatus& status);
  void hand_over();
  void refuse(const planner::Refusal& refusal);
  void look(const LoopStatus& status);
  void follow_persons(const LoopStatus& status);
  void look_ahead(const LoopStatus& status);
  void lay_down(const LoopStatus& status);
  void lay_down_plan();
  [[nodiscard]] planner::Planner& spare() const noexcept { return *planners_[1 - current_]; }

  MissionInputs& inputs_;
  ControlLoop& loop_;
  console::ConsoleDesk& desk_;
  std::unique_ptr<planner::Planner, PlannerDeleter> second_;
  std::array<planner::Planner*, 2> planners_;
  std::array<RunView, 2> views_;
  std::size_t current_ = 0;
  SearchedMap searched_;
  std::uint32_t searched_shown_ = 0;
  Instant searched_shown_at_{};
  PlanMaker maker_;
  Step step_ = Step::kIdle;
  bool made_ = false;       // by the maker, and the loop has not been told
  PlanAreas heeded_;        // by the current plan
  PlanAreas to_be_heeded_;  // by the one that is made
  std::vector<AgentSpec> agents_before_;
  PreferredSlots slots_;
  std::uint32_t plan_before_ = 0;
  std::uint32_t notices_ = 0;
  std::uint32_t areas_shown_ = 0;
  std::string areas_path_;
  std::uint32_t areas_kept_ = 0;  // revisions
  std::uint32_t areas_tried_ = 0;
  Instant areas_tried_at_{};
  std::optional<Error> failure_;
  PlanMark plan_shown_;
  std::string plan_ready_;                         // the last that was planned to its end, as a document
  std::array<double, limits::kAgents> along_m_{};  // of its path, each person
  std::array<double, limits::kAgents> left_m_{};
  std::optional<std::uint8_t> into_no_go_;  // whose way ahead leads there
  std::uint32_t areas_ahead_ = 0;           // revision that was judged, with the plan and when below
  PlanMark plan_ahead_;
  Instant looked_ahead_at_{};
};

}  // namespace ivo::firmware
