// What a route is worth, well enough to judge a change of it: parts of segments in order of time, what each shows first
// taken at the part's middle. Judging starts again from a state kept a little before the change. ET_c without
// sub-priors, EST in its continuous form with them.
#pragma once

#include <array>
#include <cstdint>

#include "planner/search/belief.hpp"
#include "planner/search/mass_planes.hpp"
#include "planner/search/route.hpp"

namespace ivo::planner {

struct Judgement {
  MassTime cost{};
  Seconds end_s{};
  bool complete = false;
  std::array<std::int32_t, limits::kAgents> legs_used{};
};

class RouteJudge {
 public:
  explicit RouteJudge(const SegmentPool& pool) noexcept : pool_(pool) {}

  /// Another mission. Cost: the cells.
  void open(const Cells& cells, const Belief& belief, const std::array<SecondsAMetre, limits::kAgents>& paces,
            double max_unseen_mass) noexcept;
  /// What agent m sees from its start.
  void set_start(int agent, std::int32_t segment) noexcept { starts_[index(agent)] = segment; }

  /// Judges `route`, which is as the current one up to `changed_s`; states before that are kept for the next. `route`
  /// lasts until done(). Returns the work done.
  int start(const Route& route, Seconds changed_s) noexcept;
  /// The route last judged is the current one from now on.
  void accept() noexcept;
  /// Up to about `rows` rows. Returns the work done.
  int advance(int rows) noexcept;
  /// Takes for complete only what sees so much more than must be seen, cut to a part of what may stay unseen. What was
  /// judged before is to be judged anew.
  void demand(double mass) noexcept;
  [[nodiscard]] double demanded() const noexcept { return demanded_; }
  [[nodiscard]] bool done() const noexcept { return done_; }
  [[nodiscard]] const Judgement& judgement() const noexcept { return judgement_; }
  [[nodiscard]] Seconds seconds_along(int agent, std::int32_t segment) const noexcept {
    return duration(pool_[segment].length, paces_[index(agent)]);
  }

 private:
  struct Cursor {
    Seconds time_s{};
    Seconds leg_begin_s{};
    std::int32_t leg = 0;
    std::int32_t part = -1;  // next of the leg under way; -1: the leg is yet to begin
    std::int32_t parts_done = 0;
  };
  struct State {
    Seconds time_s{};  // of the cursor that is farthest
    Mass unseen{};
    Mass unfound{};  // of the sub-priors
    MassTime cost{};
    std::array<Cursor, limits::kAgents> cursors{};
  };
  static constexpr int kKept = 20;

  struct Shown {
    Mass mass{};
    Mass sub_mass{};
    int work = 0;
  };
  [[nodiscard]] int next_agent() const noexcept;
  int advance_agent(int agent) noexcept;
  [[nodiscard]] Shown look(int agent, const Part& part) noexcept;
  void keep_state() noexcept;
  void end_complete(Seconds begin_s, Seconds length_s, const Shown& shown) noexcept;
  void end_incomplete() noexcept;

  const SegmentPool& pool_;
  const Belief* belief_ = nullptr;
  int agents_ = 0;
  double may_stay_unseen_ = 0.0;
  double demanded_ = 0.0;
  Mass max_unseen_{};
  Seconds horizon_s_{};  // K of EST
  std::array<SecondsAMetre, limits::kAgents> paces_{};
  std::array<std::int32_t, limits::kAgents> starts_{};
  MassPlanes planes_;
  std::array<MassPlanes, limits::kAgents> sub_planes_{};

  const Route* route_ = nullptr;
  Seconds changed_s_{};
  bool done_ = true;
  SeenMap seen_;
  State state_;
  Judgement judgement_;

  std::array<State, kKept> kept_{};
  std::array<SeenMap, kKept> kept_seen_{};
  int kept_count_ = 0;
  Seconds keep_every_s_{};
  Seconds next_kept_s_{};
};

}  // namespace ivo::planner
