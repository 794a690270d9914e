#include "planner/search/edge_events.hpp"

#include <algorithm>
#include <cmath>

#include "config/base/contract.hpp"
#include "planner/search/work.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::planner {

void EdgeEvents::clear() noexcept {
  slots_.fill({});
  oldest_ = 0;
  block_count_ = 0;
  head_ = 0;
  making_ = kNone;
  taken_.open(cells_.columns(), cells_.rows());
}

int EdgeEvents::prepare(int agent, Node tail, Edge e, int rows) noexcept {
  if (ready(agent, e)) {
    return 0;
  }
  int work = 0;
  if (making_ != slot(agent, e)) {
    work += begin(agent, tail, e);
  }
  const SightView view = sight_.along_edge(agent, e);
  while (swath_ < view.size() && work < rows) {
    const Swath& swath = view.at(swath_);
    while (row_ < swath.rows && work < rows) {
      row_ += add_row(swath, rows, work) ? 1 : 0;
    }
    if (row_ == swath.rows) {
      row_ = 0;
      ++swath_;
    }
  }
  if (swath_ == view.size()) {
    finish(agent, tail, e);
  }
  return work;
}

// No edge has more events than its swaths have cells.
int EdgeEvents::most(int agent, Edge e) const noexcept {
  int most = 0;
  for (const Swath& swath : sight_.along_edge(agent, e).swaths) {
    const std::uint64_t* const words = sight_.words(swath);
    for (int i = 0; i < swath.rows; ++i) {
      most += std::popcount(words[i]);
    }
  }
  return most;
}

int EdgeEvents::begin(int agent, Node tail, Edge e) noexcept {
  const SightView view = sight_.along_edge(agent, e);
  if (making_ != kNone) {
    taken_.open(cells_.columns(), cells_.rows());  // another edge was left half made
  }
  make_room(most(agent, e));
  making_ = slot(agent, e);
  made_first_ = head_;
  made_ = 0;
  tail_ = graph_.position(tail);
  end_ = graph_.position(graph_.head(e));
  radius_m_ = sight_.radius_m(agent);
  points_ = sight_.points(e);
  reversed_ = view.reversed;
  const double size = cells_.cell_m();
  open_ = !cells_.any_occluder(
      {std::max(0, static_cast<int>((std::min(tail_.x_m, end_.x_m) - radius_m_) / size) - 1),
       std::max(0, static_cast<int>((std::min(tail_.y_m, end_.y_m) - radius_m_) / size) - 1),
       std::min(cells_.columns() - 1, static_cast<int>((std::max(tail_.x_m, end_.x_m) + radius_m_) / size) + 1),
       std::min(cells_.rows() - 1, static_cast<int>((std::max(tail_.y_m, end_.y_m) + radius_m_) / size) + 1)});
  swath_ = 0;
  row_ = 0;
  point_ = kNotBegun;
  int rows = 0;
  for (const Swath& swath : view.swaths) {
    rows += swath.rows;
  }
  for (const Swath& swath : sight_.from_node(agent, tail).swaths) {
    taken_.look(swath, sight_.words(swath), [](int, std::uint64_t) {});
    rows += swath.rows;
  }
  return 1 + work::rows_opened(rows);
}

void EdgeEvents::make_room(int size) noexcept {
  const auto evict = [&] {
    slots_[static_cast<std::size_t>(blocks_[index(oldest_)].slot)] = {};
    oldest_ = (oldest_ + 1) % kBlocks;
    --block_count_;
  };
  IVO_CONTRACT(size <= kept_);
  if (head_ + size > kept_) {
    while (block_count_ > 0 && blocks_[index(oldest_)].first >= head_) {
      evict();
    }
    head_ = 0;
  }
  while (block_count_ > 0 && blocks_[index(oldest_)].first >= head_ && blocks_[index(oldest_)].first < head_ + size) {
    evict();
  }
  if (block_count_ == kBlocks) {
    evict();
  }
}

// A cell of this row that nothing earlier took is first seen from one of the swath's points. False when it has to go
// on.
bool EdgeEvents::add_row(const Swath& swath, int rows, int& work) noexcept {
  const int first = reversed_ ? points_ - swath.last_point : swath.first_point;
  const int last = reversed_ ? points_ - swath.first_point : swath.last_point;
  const int row = swath.first_row + row_;
  const std::uint64_t taken = taken_.window(row, swath.first_byte);
  const std::uint64_t fresh = sight_.words(swath)[row_] & ~taken;
  std::uint64_t left = fresh;
  work += 2;
  // At least a cell's one point, whatever is left of the part.
  for (bool more = true; more && left != 0; more = work < rows) {
    const int bit = std::countr_zero(left);
    const int column = 8 * swath.first_byte + bit;
    if (!find_first_point(column, row, first, last, rows, work)) {
      break;
    }
    pool_[index(made_first_ + made_++)] = SightEvent(taken_.cell(row, swath.first_byte, bit), point_);
    point_ = kNotBegun;
    left &= left - 1;
  }
  taken_.set_window(row, swath.first_byte, taken | (fresh & ~left));
  return left == 0;
}

bool EdgeEvents::find_first_point(int column, int row, int from, int to, int rows, int& work) noexcept {
  if (point_ == kNotBegun) {
    ++work;
    // Where the circle around the cell meets the line says where to begin; the rule decides.
    const Point c = cells_.centre(column, row);
    const double dx = end_.x_m - tail_.x_m;
    const double dy = end_.y_m - tail_.y_m;
    const double length2 = dx * dx + dy * dy;
    const double along = (c.x_m - tail_.x_m) * dx + (c.y_m - tail_.y_m) * dy;
    const double across = (c.x_m - tail_.x_m) * dy - (c.y_m - tail_.y_m) * dx;
    const double half2 = radius_m_ * radius_m_ * length2 - across * across;
    const double share = length2 > 0.0 ? (along - std::sqrt(std::max(0.0, half2))) / length2 : 0.0;
    point_ = std::clamp(static_cast<int>(share * points_) - 1, from, to);
  }
  while (point_ < to) {
    work += 2;
    if (sees(point_, column, row, work)) {
      return true;
    }
    ++point_;
    if (work >= rows) {
      return false;
    }
  }
  return true;
}

bool EdgeEvents::sees(int point, int column, int row, int& work) const noexcept {
  const Point p = sight_point(tail_, end_, point, points_);
  if (!within_radius(cells_, p, column, row, radius_m_)) {
    return false;
  }
  if (open_) {
    return true;
  }
  int walked = 0;
  const bool seen = line_of_sight(cells_, p, cells_.at(column, row), walked);
  work += work::ray(walked);
  return seen;
}

void EdgeEvents::finish(int agent, Node tail, Edge e) noexcept {
  slots_[making_] = {made_first_, made_};
  blocks_[index((oldest_ + block_count_) % kBlocks)] = {made_first_, made_, static_cast<std::int32_t>(making_)};
  ++block_count_;
  head_ = made_first_ + made_;
  making_ = kNone;
  for (const SightView& view : {sight_.along_edge(agent, e), sight_.from_node(agent, tail)}) {
    for (const Swath& swath : view.swaths) {
      for (int i = 0; i < swath.rows; ++i) {
        taken_.set_window(swath.first_row + i, swath.first_byte, 0);
      }
    }
  }
}

}  // namespace ivo::planner
