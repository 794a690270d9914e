#include "planner/search/lookahead.hpp"

#include <algorithm>
#include <bit>

#include "planner/numeric/exponential.hpp"
#include "planner/search/work.hpp"

namespace ivo::planner {

void Lookahead::open() noexcept {
  depth_ = -1;
  for (int k = 0; k < kWeights; ++k) {
    weights_[index(k)] = Mass(exp_negative(-k / 8.0));
  }
}

void Lookahead::start(int moves, double patience) noexcept {
  moves_ = std::clamp(moves, 1, kMostMoves);
  depth_ = -1;
  for (int m = 0; m < world_.graph.agents(); ++m) {
    // At least a unit of resolution, whatever the speed.
    eighth_s_[index(m)] =
        std::max(Seconds(0x1p-10), Seconds(patience * world_.graph.spacing_m() / world_.speeds_mps[index(m)] / 8.0));
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
  weighing_ = false;
  task_ = Task::kWeigh;
}

int Lookahead::advance(SeenMap& seen, int rows) noexcept {
  int work = 1;
  while (depth_ >= 0 && work <= rows) {
    const int left = rows - work + 1;
    switch (task_) {
      case Task::kWeigh:
        work += weigh(seen, left);
        break;
      case Task::kFollow:
        work += follow(seen, left);
        break;
      case Task::kUndo:
        work += undo(seen, left);
        break;
    }
  }
  return work;
}

int Lookahead::weigh(const SeenMap& seen, int rows) noexcept {
  Level& level = levels_[index(depth_)];
  if (level.next == level.end) {
    begin_option();
    return 0;
  }
  if (!weighing_) {
    if (!in(world_.graph.open_to(level.next), agent_)) {
      ++level.next;
      return 0;
    }
    unseen_.begin(agent_, world_.sight.along_edge(agent_, level.next));
    weighing_ = true;
  }
  const int work = unseen_.advance(seen, rows);
  if (unseen_.done()) {
    take_option(level.next++, unseen_.mass());
    weighing_ = false;
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

// The level's next option; without one, what its best showed is part of the option before.
void Lookahead::begin_option() noexcept {
  Level& level = levels_[index(depth_)];
  if (level.option < level.count) {
    level.undo_mark = undo_count_;
    level.value = Mass{};
    walk_.begin(world_.sight.along_edge(agent_, level.options[index(level.option)].edge));
    shown_ = Mass{};
    task_ = Task::kFollow;
  } else if (--depth_ >= 0) {
    levels_[index(depth_)].value += level.best;
    task_ = Task::kUndo;
  }
}

int Lookahead::follow(SeenMap& seen, int rows) noexcept {
  Level& level = levels_[index(depth_)];
  const Edge e = level.options[index(level.option)].edge;
  const Belief& belief = world_.belief;
  const auto& mass = belief.has_sub_priors ? belief.sub_mass[index(agent_)] : belief.mass;
  const Pace pace = world_.pace(agent_, e);
  const int points = world_.sight.points(e);
  int work = 0;
  while (!walk_.done() && work < rows) {
    const auto [swath, words, ends_swath] = walk_.next(world_.sight, std::min(rows - work, work::kRowsAtOnce));
    const int byte = swath.first_byte;
    int cells = 0;
    seen.look(swath, words, [&](int row, std::uint64_t fresh) {
      const std::uint64_t before = seen.window(row, byte) & ~fresh;
      if (undo_count_ < kUndo) {
        undo_[index(undo_count_++)] = {row, byte, before};
      } else {
        seen.set_window(row, byte, before);
      }
      const Cell first = seen.cell(row, byte, 0);
      cells += std::popcount(fresh);
      for_each_bit(fresh, [&](int bit) { shown_ += mass[index(first + bit)]; });
    });
    if (ends_swath) {
      const int middle = (swath.first_point + swath.last_point) / 2;
      level.value += weighted(shown_, level.from_s + after_points(pace, walk_.reversed() ? points - middle : middle));
      shown_ = Mass{};
    }
    work += work::rows_shown(swath.rows, cells) + swath.rows / 2;
  }
  if (walk_.done()) {
    if (depth_ + 1 < moves_) {
      push(world_.graph.head(e), level.from_s + world_.seconds_along(agent_, e));
    } else {
      task_ = Task::kUndo;
    }
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

int Lookahead::undo(SeenMap& seen, int rows) noexcept {
  constexpr int kToTheUnit = 3;
  const int mark = std::max(levels_[index(depth_)].undo_mark, undo_count_ - rows * kToTheUnit);
  const int undone = undo_count_ - mark;
  while (undo_count_ > mark) {
    const Undo& undo = undo_[index(--undo_count_)];
    seen.set_window(undo.row, undo.byte, undo.word);
  }
  if (undo_count_ == levels_[index(depth_)].undo_mark) {
    end_option();
  }
  return 2 + undone / kToTheUnit;
}

void Lookahead::end_option() noexcept {
  Level& level = levels_[index(depth_)];
  if (level.value > level.best) {
    level.best = level.value;
    level.chosen = level.options[index(level.option)].edge;
  }
  ++level.option;
  begin_option();
}

}  // namespace ivo::planner
