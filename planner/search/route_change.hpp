// One proposed change of a route: a waypoint is moved, added or dropped, a stretch is reversed (2-opt, Croes 1958) or
// goes to another place (or-opt, Or 1976), or two agents go on with each other's ways (2-opt*, Potvin and Rousseau
// 1995). The segments that it needs are made in parts of bounded work; whoever judges it accepts or rejects it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "planner/numeric/rng.hpp"
#include "planner/search/route.hpp"
#include "planner/search/route_judge.hpp"

namespace ivo::planner {

class RouteChange {
 public:
  /// Where waypoints may lie; lengths in ticks (lattice.hpp).
  struct Field {
    int agents = 0;
    std::int32_t width = 0;  ///< of the map
    std::int32_t height = 0;
    std::int32_t border = 0;  ///< least distance of a new waypoint from the border
    std::int32_t sight = 1;   ///< the widest radius: waypoints are moved by shares of it
  };

  /// `judge` says how long a segment takes.
  RouteChange(SegmentPool& pool, const RouteJudge& judge) noexcept : pool_(pool), judge_(judge) {}

  /// Another mission.
  void open(const Field& field) noexcept { field_ = field; }

  /// Draws a change of `current`, which was judged as `judged`. False when the draw is of no use: then there is nothing
  /// to make, accept or reject. Adds the work done to `work`. Cost: the legs.
  [[nodiscard]] bool propose(const Route& current, const Judgement& judged, Rng& rng, int& work) noexcept;
  /// Makes its segments until `work` has come to `enough`. False when one is not proved free or there is no room: then
  /// the change is rejected.
  [[nodiscard]] bool make(int& work, int enough) noexcept;
  [[nodiscard]] bool made() const noexcept { return wish_ == wishes_.size(); }

  /// When made: the route as changed, until the next proposal.
  [[nodiscard]] const Route& candidate() const noexcept { return candidate_; }
  /// Up to then the candidate is as the current route.
  [[nodiscard]] Seconds changed_s() const noexcept { return changed_s_; }

  /// When made: `current` becomes the candidate, and the segments that it loses go back to the pool. Cost: the legs.
  void accept(Route& current) noexcept;
  /// The segments made for the change go back to the pool.
  void reject() noexcept;

 private:
  struct Wish {  // a segment that the candidate needs; its leg holds -1 - its number until it is made
    int agent = 0;
    Place from;
    Place to;
    std::int32_t segment = -1;
    bool wanted = true;
  };

  bool shift(int agent) noexcept;
  bool add(int agent) noexcept;
  bool drop(int agent) noexcept;
  bool reverse(int agent) noexcept;
  bool relocate(int agent) noexcept;
  bool exchange(int agent) noexcept;

  [[nodiscard]] Place place(const Legs& legs, int agent, int i) const noexcept;
  [[nodiscard]] Seconds time_at(int agent, int leg) const noexcept;
  [[nodiscard]] int reach(int agent) const noexcept;
  [[nodiscard]] Place near(const Place& centre, int spread) noexcept;
  [[nodiscard]] int pick_spread() noexcept;
  [[nodiscard]] bool put(int agent, Legs& legs, int i, const Place& from, const Place& to) noexcept;
  void lose(const Leg& leg) noexcept { (void)lost_.push_back(leg.segment); }
  void take_out(const Leg& leg) noexcept;
  void changed(Seconds at_s) noexcept { changed_s_ = std::min(changed_s_, at_s); }
  void fill_in(int& work) noexcept;

  SegmentPool& pool_;
  const RouteJudge& judge_;
  Field field_;

  // Of the proposal under way.
  const Route* current_ = nullptr;
  const Judgement* judged_ = nullptr;
  Rng* rng_ = nullptr;

  Route candidate_;
  Legs spare_;
  StaticVector<Wish, 8> wishes_;
  std::size_t wish_ = 0;                // the one under way
  StaticVector<std::int32_t, 4> lost_;  // segments of the current route alone; or-opt loses three
  Seconds changed_s_{};
};

}  // namespace ivo::planner
