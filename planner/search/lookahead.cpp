#include "planner/search/lookahead.hpp"

#include <algorithm>

#include "planner/numeric/exponential.hpp"
#include "planner/search/work.hpp"

namespace ivo::planner {

void Lookahead::open(int moves, double patience) noexcept {
  moves_ = std::clamp(moves, 1, kMostMoves);
  depth_ = -1;
  for (int m = 0; m < world_.graph.agents(); ++m) {
    // At least a unit of resolution, whatever the speed.
    eighth_s_[index(m)] =
        std::max(Seconds(0x1p-10), Seconds(patience * world_.graph.spacing_m() / world_.speeds_mps[index(m)] / 8.0));
  }
  for (int k = 0; k < kWeights; ++k) {
    weights_[index(k)] = Mass(exp_negative(-k / 8.0));
  }
}

void Lookahead::begin(int agent, Node here) noexcept {
  agent_ = agent;
  undo_count_ = 0;
  depth_ = -1;
  push(here, Seconds{});
}

void Lookahead::push(Node here, Seconds from_s) noexcept {
  Level& level = levels_[index(++depth_)];
  level = {};
  level.next = world_.graph.first_edge(here);
  level.end = world_.graph.end_edge(here);
  level.from_s = from_s;
}

int Lookahead::advance(SeenMap& seen, int rows) noexcept {
  int work = 1;
  while (depth_ >= 0 && work <= rows) {
    Level& level = levels_[index(depth_)];
    if (level.next < level.end) {
      const Edge e = level.next++;
      if (in(world_.graph.open_to(e), agent_)) {
        take_option(e, unseen_mass(world_, agent_, world_.sight.along_edge(agent_, e), seen, work));
      }
    } else if (level.option < level.count) {
      const Edge e = level.options[index(level.option)].edge;
      level.undo_mark = undo_count_;
      work += follow(seen, e, level.from_s, level.value);
      if (depth_ + 1 < moves_) {
        push(world_.graph.head(e), level.from_s + world_.seconds_along(agent_, e));
      } else {
        work += end_option(seen);
      }
    } else if (--depth_ >= 0) {
      levels_[index(depth_)].value += level.best;
      work += end_option(seen);
    }
  }
  return work;
}

// The best few by mass a metre, the most first.
void Lookahead::take_option(Edge e, Mass mass) noexcept {
  Level& level = levels_[index(depth_)];
  const Eta rate = eta_of(mass, world_.graph.length_m(e));
  if (mass <= Mass{} || (level.count == kWidth && rate <= level.options[kWidth - 1].rate)) {
    return;
  }
  int slot = level.count < kWidth ? level.count++ : kWidth - 1;
  for (; slot > 0 && level.options[index(slot - 1)].rate < rate; --slot) {
    level.options[index(slot)] = level.options[index(slot - 1)];
  }
  level.options[index(slot)] = {rate, e};
}

int Lookahead::follow(SeenMap& seen, Edge e, Seconds from_s, Mass& value) noexcept {
  const Belief& belief = world_.belief;
  const auto& mass = belief.has_sub_priors ? belief.sub_mass[index(agent_)] : belief.mass;
  const SightView view = world_.sight.along_edge(agent_, e);
  const Pace pace = world_.pace(agent_, e);
  const int points = world_.sight.points(e);
  value = Mass{};
  int work = 0;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const Swath& swath = view.at(i);
    Mass shown{};
    int cells = 0;
    seen.look(swath, world_.sight.words(swath), [&](int row, std::uint64_t fresh) {
      if (undo_count_ < kUndo) {
        undo_[index(undo_count_++)] = {row, swath.first_byte, seen.window(row, swath.first_byte) & ~fresh};
      } else {
        seen.set_window(row, swath.first_byte, seen.window(row, swath.first_byte) & ~fresh);
      }
      const Cell first = seen.cell(row, swath.first_byte, 0);
      cells += std::popcount(fresh);
      for_each_bit(fresh, [&](int bit) { shown += mass[index(first + bit)]; });
    });
    const int middle = (swath.first_point + swath.last_point) / 2;
    value += weighted(shown, from_s + after_points(pace, view.reversed ? points - middle : middle));
    work += work::rows_shown(swath.rows, cells) + swath.rows / 2;
  }
  return work;
}

Mass Lookahead::weighted(Mass mass, Seconds time_s) const noexcept {
#if IVO_PLANNER_FIXED
  const std::int64_t eighths = time_s.raw() / eighth_s_[index(agent_)].raw();
  const Mass weight = eighths < kWeights ? weights_[index(static_cast<int>(eighths))] : Mass{};
  return round_to<Mass>(mass * weight);
#else
  const double eighths = time_s / eighth_s_[index(agent_)];
  return eighths < kWeights ? mass * weights_[index(static_cast<int>(eighths))] : Mass{};
#endif
}

int Lookahead::end_option(SeenMap& seen) noexcept {
  Level& level = levels_[index(depth_)];
  const int undone = undo_count_ - level.undo_mark;
  while (undo_count_ > level.undo_mark) {
    const Undo& undo = undo_[index(--undo_count_)];
    seen.set_window(undo.row, undo.byte, undo.word);
  }
  if (level.value > level.best) {
    level.best = level.value;
    level.chosen = level.options[index(level.option)].edge;
  }
  ++level.option;
  return 2 + undone / 3;
}

}  // namespace ivo::planner
