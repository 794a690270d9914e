#include "planner/search/segment_pool.hpp"

#include <algorithm>
#include <cmath>

#include "planner/search/work.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::planner {
namespace {

constexpr int kQ = 256;  // parts of a tick
constexpr int kAll = 1 << 30;
constexpr double kLongest_m = 5e5;   // of a map; then products of ticks and their fractions stay whole numbers
constexpr int kMostLines = 1 << 20;  // of cells: rows or columns

}  // namespace

bool SegmentPool::open() noexcept {
  const Cells& cells = world_.cells;
  const Bodies& bodies = world_.bodies;
  const SegmentedMap& map = world_.map;
  double widest_m = 0.0;
  for (const Body& body : bodies) {
    widest_m = std::max(widest_m, body.sight_radius_m);
  }
  // A part spans at most kRows rows, and with its first byte's other columns at most a word.
  const double span_m = (Part::kRows - 2) * cells.cell_m() - 2.0 * widest_m;
  const double part_m = std::min(span_m, widest_m);
  if (cells.cell_m() * kTicksAMetre < 1.0 || widest_m * kTicksAMetre >= static_cast<double>(Disc::kMost) ||
      span_m < 2.0 * cells.cell_m() || part_m * kTicksAMetre < 1.0) {
    return false;
  }
  if (std::max(map.width_m(), map.height_m()) > kLongest_m || std::max(cells.columns(), cells.rows()) > kMostLines) {
    return false;
  }
  part_ticks_ = static_cast<std::int32_t>(part_m * kTicksAMetre);
  cell_q_ = static_cast<std::int64_t>(cells.cell_m() * kTicksAMetre * kQ + 0.5);
  inverse_q_ = (std::int64_t{1} << 40) / cell_q_;
  int discs = 0;
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    // What lies on the rim is seen from the sight points alone, and those are up to half a cell apart: a sweep that
    // took it for seen all along would be a way to see what nobody sees.
    const double r_m = bodies[m].sight_radius_m;
    const double off_m = std::min(r_m, 0.25 * cells.cell_m());
    const auto radius = static_cast<std::int32_t>(std::sqrt(r_m * r_m - off_m * off_m) * kTicksAMetre);
    int disc = 0;
    while (disc < discs && discs_[index(disc)].radius != radius) {
      ++disc;
    }
    disc_of_agent_[m] = disc;
    if (disc < discs) {
      continue;
    }
    ++discs;
    Disc& made = discs_[index(disc)];
    made.radius = radius;
    for (std::int64_t d = 0; d <= radius; ++d) {
      made.half[static_cast<std::size_t>(d)] = static_cast<std::int16_t>(
          whole_square_root(static_cast<std::uint64_t>(std::int64_t{radius} * radius - d * d)));
    }
  }
  for (std::size_t kind = 0; kind < kAgentKinds; ++kind) {
    clear_[kind].build(map, cells,
                       static_cast<ClassSet>(obstacle_classes(map.classes) |
                                             restricted_classes(map.classes, static_cast<AgentKind>(kind))));
  }
  free_segment_ = -1;
  for (std::int32_t s = kSegments - 1; s >= 0; --s) {
    segments_[index(s)].next_free = free_segment_;
    free_segment_ = s;
  }
  free_part_ = -1;
  for (std::int32_t p = kParts - 1; p >= 0; --p) {
    parts_[index(p)].next = free_part_;
    free_part_ = p;
  }
  free_parts_ = kParts;
  return true;
}

bool SegmentPool::proved(int agent, const Place& from, const Place& to, int& work) const noexcept {
  if (from.node >= 0 && to.node >= 0) {
    if (from.node == to.node) {
      return true;
    }
    if (const Edge e = world_.graph.find(from.node, to.node); e >= 0 && in(world_.graph.open_to(e), agent)) {
      return true;
    }
  }
  const Body& body = world_.bodies[index(agent)];
  const double radius_m = std::min(std::max(body.footprint_radius_m, world_.clearance_m), kLongest_m);
  const auto radius = static_cast<std::int32_t>(radius_m * kTicksAMetre + 1.0);
  const auto width = static_cast<std::int32_t>(world_.map.width_m() * kTicksAMetre);
  const auto height = static_cast<std::int32_t>(world_.map.height_m() * kTicksAMetre);
  work += 4;
  for (const Place* place : {&from, &to}) {
    const Spot s = place->spot;
    if (s.x < radius || s.y < radius || s.x > width - radius || s.y > height - radius) {
      return false;
    }
    // The node itself may lie nearer to the border than the spot that it is rounded to.
    if (place->node >= 0 && !inside_border(world_.map, point_at(*place), radius_m)) {
      return false;
    }
  }
  // In the same order whichever way it is gone: who can go there can come back.
  const bool turned = to.spot.x < from.spot.x || (to.spot.x == from.spot.x && to.spot.y < from.spot.y);
  const Place& first = turned ? to : from;
  const Place& last = turned ? from : to;
  const Point a = point_at(first);
  const Point b = point_at(last);
  if (!body.restricted.empty() && touches(body.restricted, a, b)) {
    return false;
  }
  if (clear_[static_cast<std::size_t>(body.kind)].surely_free(first.spot, last.spot, radius + 1)) {
    return true;
  }
#if IVO_PLANNER_FIXED
  return false;  // the exact test is libccd's, in floating point
#else
  work += 1 + static_cast<int>(std::abs(b.y_m - a.y_m) / world_.map.resolution_m);
  return swept_disc_is_free(
      world_.map,
      static_cast<ClassSet>(obstacle_classes(world_.map.classes) | restricted_classes(world_.map.classes, body.kind)),
      a, b, radius_m);
#endif
}

std::int32_t SegmentPool::begin(int agent, const Place& from, const Place& to, int& work) noexcept {
  const Metres length = distance(from.spot, to.spot);
  const std::int64_t ticks = whole_ticks(length);
  const auto parts = static_cast<std::int32_t>(std::max<std::int64_t>(1, (ticks + part_ticks_ - 1) / part_ticks_));
  if (free_segment_ < 0 || free_parts_ < parts || !proved(agent, from, to, work)) {
    return -1;
  }
  making_ = free_segment_;
  Segment& segment = segments_[index(making_)];
  free_segment_ = segment.next_free;
  segment = {.from = from, .to = to, .length = length, .first_part = free_part_, .last_part = -1, .parts = parts};
  // All its parts at once, so that it can be released before they are made.
  std::int32_t before = -1;
  for (std::int32_t k = 0; k < parts; ++k) {
    Part& part = parts_[index(free_part_)];
    part.before = before;
    before = free_part_;
    free_part_ = part.next;
  }
  segment.last_part = before;
  free_parts_ -= parts;
  next_part_ = segment.first_part;
  parts_made_ = 0;
  row_ = -1;
  work += work::kSegment + work::kPart * parts / 8;
  agent_ = agent;
  return making_;
}

bool SegmentPool::make_rows(int& work, int enough) noexcept {
  const Segment& segment = segments_[index(making_)];
  while (work < enough) {
    Part& part = parts_[index(next_part_)];
    if (row_ < 0) {
      begin_part(part, work);
      row_ = 0;
    }
    for (; row_ < part.rows && work < enough; ++row_) {
      part.words[index(row_)] = sweep_row(part, row_, work);
    }
    if (row_ == part.rows) {
      row_ = -1;
      next_part_ = part.next;
      if (++parts_made_ == segment.parts) {
        return true;
      }
    }
  }
  return false;
}

std::int32_t SegmentPool::make(int agent, const Place& from, const Place& to, int& work) noexcept {
  const std::int32_t id = begin(agent, from, to, work);
  if (id >= 0) {
    (void)make_rows(work, kAll);
  }
  return id;
}

void SegmentPool::release(std::int32_t id) noexcept {
  Segment& segment = segments_[index(id)];
  parts_[index(segment.last_part)].next = free_part_;
  free_part_ = segment.first_part;
  free_parts_ += segment.parts;
  segment.next_free = free_segment_;
  free_segment_ = id;
}

void SegmentPool::begin_part(Part& part, int& work) noexcept {
  const Segment& segment = segments_[index(making_)];
  const Spot a = segment.from.spot;
  const Spot b = segment.to.spot;
  const auto at = [&](std::int32_t k) {
    return Spot{a.x + static_cast<std::int32_t>(std::int64_t{b.x - a.x} * k / segment.parts),
                a.y + static_cast<std::int32_t>(std::int64_t{b.y - a.y} * k / segment.parts)};
  };
  Sweep& sweep = sweep_;
  sweep.p = at(parts_made_);
  sweep.q = at(parts_made_ + 1);
  const auto [low_x, high_x] = std::minmax(sweep.p.x, sweep.q.x);
  const auto [low_y, high_y] = std::minmax(sweep.p.y, sweep.q.y);
  const std::int32_t radius = discs_[index(disc_of(agent_))].radius;
  const auto cell_at = [&](std::int64_t ticks) {
    return static_cast<std::int32_t>((std::max<std::int64_t>(0, ticks) * kQ * inverse_q_) >> 40);
  };
  const Cells& cells = world_.cells;
  const CellWindow window{cell_at(low_x - radius), cell_at(low_y - radius),
                          std::min(cells.columns() - 1, cell_at(high_x + radius)),
                          std::min(cells.rows() - 1, cell_at(high_y + radius))};
  part.first_row = window.first_row;
  part.first_byte = window.first_column / 8;
  part.rows = std::clamp(window.last_row - window.first_row + 1, 1, Part::kRows);
  sweep.hides =
      window.first_column <= window.last_column && window.first_row <= window.last_row && cells.any_occluder(window);
  // The disc's two tangents: from where it touches at p to where it touches at q.
  const std::int64_t dx = sweep.q.x - sweep.p.x;
  const std::int64_t dy = sweep.q.y - sweep.p.y;
  const std::int64_t length = whole_ticks(distance(sweep.p, sweep.q));
  sweep.side = length > 0 ? Spot{static_cast<std::int32_t>(-dy * radius / length),
                                 static_cast<std::int32_t>(dx * radius / length)}
                          : Spot{};
  sweep.slope = dy != 0 ? (dx << 20) / dy : 0;
  work += work::kPart;
}

// The cells of a row whose centres lie in the disc swept from p to q.
std::uint64_t SegmentPool::sweep_row(const Part& part, std::int32_t i, int& work) noexcept {
  const auto& [p, q, side, slope, hides] = sweep_;
  const Disc& disc = discs_[index(disc_of(agent_))];
  const std::int64_t y = ((2 * (part.first_row + std::int64_t{i}) + 1) * cell_q_) / (2 * kQ);
  std::int64_t low = INT64_MAX;
  std::int64_t high = INT64_MIN;
  const auto widen = [&](std::int64_t a, std::int64_t b) {
    low = std::min(low, a);
    high = std::max(high, b);
  };
  for (const Spot centre : {p, q}) {
    const std::int64_t off = std::abs(y - centre.y);
    if (off <= disc.radius) {
      const std::int64_t half = disc.half[static_cast<std::size_t>(off)];
      widen(centre.x - half, centre.x + half);
    }
  }
  const std::int64_t dy = q.y - p.y;
  if (dy != 0) {
    for (const int sign : {1, -1}) {
      const std::int64_t up = y - (p.y + sign * side.y);
      if (dy > 0 ? up >= 0 && up <= dy : up <= 0 && up >= dy) {
        const std::int64_t x = p.x + sign * side.x + ((up * slope) >> 20);
        widen(x, x);
      }
    }
  } else if (std::abs(y - p.y) <= disc.radius) {
    widen(std::min(p.x, q.x), std::max(p.x, q.x));
  }
  work += work::kSweptRow;
  if (low > high) {
    return 0;
  }
  // Columns whose centres lie between: (column + 1/2) cell >= low, <= high.
  const std::int64_t first = (std::max<std::int64_t>(0, 2 * low * kQ + cell_q_ - 1) * inverse_q_) >> 41;
  const std::int64_t last = std::min<std::int64_t>(
      world_.cells.columns() - 1, ((std::max<std::int64_t>(-1, 2 * high * kQ + cell_q_) * inverse_q_) >> 41) - 1);
  const std::int64_t a = std::max<std::int64_t>(0, first - part.first_byte * 8);
  const std::int64_t b = std::min<std::int64_t>(63, last - part.first_byte * 8);
  if (a > b) {
    return 0;
  }
  const std::uint64_t word = (~std::uint64_t{0} >> static_cast<unsigned>(63 - (b - a))) << static_cast<unsigned>(a);
  return hides ? seen_of(word, part, i, work) : word;
}

// Keeps the cells that are seen from one of three places on the way.
std::uint64_t SegmentPool::seen_of(std::uint64_t word, const Part& part, std::int32_t i, int& work) const noexcept {
  constexpr int kLooks = 3;
  const Cells& cells = world_.cells;
  const double radius_m = world_.bodies[index(agent_)].sight_radius_m + 0.5 * cells.cell_m();
  const int row = part.first_row + i;
  std::uint64_t kept = 0;
  for (int k = 0; k < kLooks; ++k) {
    const Spot spot{sweep_.p.x + (sweep_.q.x - sweep_.p.x) * k / (kLooks - 1),
                    sweep_.p.y + (sweep_.q.y - sweep_.p.y) * k / (kLooks - 1)};
    const Point from = point_of(spot);
    for_each_bit(word & ~kept, [&](int bit) {
      const int column = part.first_byte * 8 + bit;
      work += 1;
      if (!within_radius(cells, from, column, row, radius_m)) {
        return;
      }
      int walked = 0;
      const bool seen = line_of_sight(cells, from, cells.at(column, row), walked);
      work += work::ray(walked);
      if (seen) {
        kept |= std::uint64_t{1} << static_cast<unsigned>(bit);
      }
    });
    if (sweep_.p == sweep_.q) {
      break;
    }
  }
  return kept;
}

}  // namespace ivo::planner
