#include "planner/world/sight_table.hpp"

#include <algorithm>
#include <cmath>

#include "planner/numeric/index.hpp"
#include "planner/world/sight_disc.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::planner {
namespace {

Refusal too_much(RefusalCode code, int value, int limit) noexcept {
  return {.code = code, .value = static_cast<double>(value), .limit = static_cast<double>(limit)};
}

}  // namespace

Refusal SightTable::build(const Cells& cells, const Graph& graph, const SightRadii& radii_m) noexcept {
  word_count_ = 0;
  swath_count_ = 0;
  std::fill_n(observable_by_.begin(), cells.count(), AgentSet{0});
  canvas_.open(cells.columns(), cells.rows());
  painted_ = {cells.columns(), cells.rows(), -1, -1};
  assign_layers(graph, radii_m);
  for (int layer = 0; layer < layers_; ++layer) {
    if (const Refusal refusal = add_nodes(cells, graph, layer)) {
      return refusal;
    }
    if (const Refusal refusal = add_edges(cells, graph, layer)) {
      return refusal;
    }
  }
  return shortage();
}

bool SightTable::fits() const noexcept { return word_count_ <= limits::kSightWords && swath_count_ <= limits::kSwaths; }

// Then it need not be counted on.
bool SightTable::fits_nowhere() const noexcept {
  return word_count_ > std::max(limits::kSightWords, limits::Desktop::kSightWords) ||
         swath_count_ > std::max(limits::kSwaths, limits::Desktop::kSwaths);
}

// The capacity that is short by more.
Refusal SightTable::shortage() const noexcept {
  if (fits()) {
    return {};
  }
  const double words = static_cast<double>(word_count_) / limits::kSightWords;
  const double swaths = static_cast<double>(swath_count_) / limits::kSwaths;
  return words >= swaths ? too_much(RefusalCode::kSightTableFull, word_count_, limits::kSightWords)
                         : too_much(RefusalCode::kTooManySwaths, swath_count_, limits::kSwaths);
}

void SightTable::assign_layers(const Graph& graph, const SightRadii& radii_m) noexcept {
  layers_ = 0;
  for (int agent = 0; agent < graph.agents(); ++agent) {
    const double radius_m = radii_m[index(agent)];
    int layer = 0;
    while (layer < layers_ && layer_radius_m_[index(layer)] != radius_m) {
      ++layer;
    }
    if (layer == layers_) {
      layer_radius_m_[index(layer)] = radius_m;
      layer_agents_[index(layer)] = 0;
      ++layers_;
    }
    layer_of_agent_[index(agent)] = layer;
    layer_agents_[index(layer)] = static_cast<AgentSet>(layer_agents_[index(layer)] | agent_bit(agent));
  }
}

Refusal SightTable::add_nodes(const Cells& cells, const Graph& graph, int layer) noexcept {
  for (Node n = 0; n < graph.nodes(); ++n) {
    const auto agents = static_cast<AgentSet>(graph.reached_by(n) & layer_agents_[index(layer)]);
    Record& record = node_records_[index(layer)][index(n)];
    record = {swath_count_, 0};
    if (agents == 0) {
      continue;
    }
    paint(cells, graph.position(n), layer_radius_m_[index(layer)]);
    cut(cells, painted_.first_column / 8, 0, 0, agents);
    if (fits_nowhere()) {
      return shortage();
    }
    record.count = swath_count_ - record.first;
  }
  return {};
}

// Both directions of an edge have the same sight points, so one record serves both.
Refusal SightTable::add_edges(const Cells& cells, const Graph& graph, int layer) noexcept {
  auto& records = edge_records_[index(layer)];
  for (Node n = 0; n < graph.nodes(); ++n) {
    for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
      const Node head = graph.head(e);
      if (head < n) {
        continue;
      }
      const Edge back = graph.find(head, n);
      const int points = sight_points(graph.length_m(e), cells.cell_m());
      if (points > kMaxPoint) {
        return {.code = RefusalCode::kEdgeTooLong, .value = static_cast<double>(points), .limit = kMaxPoint};
      }
      points_[index(e)] = points_[index(back)] = static_cast<std::int16_t>(points);
      against_[index(e)] = false;
      against_[index(back)] = true;
      records[index(e)] = {swath_count_, 0};
      const auto agents = static_cast<AgentSet>((graph.open_to(e) | graph.open_to(back)) & layer_agents_[index(layer)]);
      if (agents != 0) {
        if (const Refusal refusal = add_edge(cells, graph.position(n), graph.position(head), points,
                                             layer_radius_m_[index(layer)], records[index(e)], agents)) {
          return refusal;
        }
      }
      records[index(back)] = records[index(e)];
    }
  }
  return {};
}

// An edge is cut into equal parts, long enough to save words, short enough to say when: a sight radius each, twice that
// where the edge is long and hardly ever taken.
Refusal SightTable::add_edge(const Cells& cells, Point a, Point b, int points, double radius_m, Record& record,
                             AgentSet agents) noexcept {
  const int a_radius = std::max(1, static_cast<int>(2.0 * radius_m / cells.cell_m()));  // points, half a cell apart
  const int longest = points > 3 * a_radius ? 2 * a_radius : a_radius;
  const int parts = (points + longest - 1) / longest;
  const int byte = std::max(0, static_cast<int>((std::min(a.x_m, b.x_m) - radius_m) / cells.cell_m()) / 8);
  for (int part = 0; part < parts; ++part) {
    const int first = points * part / parts;
    const int last = points * (part + 1) / parts;
    for (int k = first; k <= last; ++k) {
      paint(cells, sight_point(a, b, k, points), radius_m);
    }
    cut(cells, byte, first, last, agents);
    if (fits_nowhere()) {
      return shortage();
    }
  }
  record.count = swath_count_ - record.first;
  return {};
}

void SightTable::paint(const Cells& cells, Point from, double radius_m) noexcept {
  const SightDisc disc(cells, from, radius_m);
  for (int row = disc.first_row(); row <= disc.last_row(); ++row) {
    const SightDisc::Run run = disc.run(row);
    if (run.first > run.last) {
      continue;
    }
    painted_.first_row = std::min(painted_.first_row, row);
    painted_.last_row = std::max(painted_.last_row, row);
    painted_.first_column = std::min(painted_.first_column, run.first);
    painted_.last_column = std::max(painted_.last_column, run.last);
    if (disc.open()) {
      canvas_.set_run(row, run.first, run.last);
      continue;
    }
    for (int column = run.first; column <= run.last; ++column) {
      if (!canvas_.test(column, row) && line_of_sight(cells, from, cells.at(column, row))) {
        canvas_.set(column, row);
      }
    }
  }
}

// What was painted becomes swaths, one a window of 64 columns; the canvas is empty again. Where one window is enough it
// begins at `common_byte`: an ant's look that loads just the words that the look before has stored does not wait for
// them.
void SightTable::cut(const Cells& cells, int common_byte, int first_point, int last_point, AgentSet agents) noexcept {
  const bool common = painted_.first_column >= 8 * common_byte && painted_.last_column < 8 * common_byte + 64;
  for (int byte = common ? common_byte : painted_.first_column / 8; byte * 8 <= painted_.last_column; byte += 8) {
    int first_row = -1;
    int last_row = -1;
    for (int row = painted_.first_row; row <= painted_.last_row; ++row) {
      if (canvas_.window(row, byte) != 0) {
        first_row = last_row < 0 ? row : first_row;
        last_row = row;
      }
    }
    if (last_row < 0) {
      continue;
    }
    keep({.first_row = first_row,
          .first_byte = byte,
          .first_word = word_count_,
          .rows = static_cast<std::int16_t>(last_row - first_row + 1),
          .first_point = static_cast<std::int16_t>(first_point),
          .last_point = static_cast<std::int16_t>(last_point)},
         agents);
  }
  painted_ = {cells.columns(), cells.rows(), -1, -1};
}

void SightTable::keep(const Swath& swath, AgentSet agents) noexcept {
  const int first = word_count_;
  word_count_ += swath.rows;
  ++swath_count_;
  const bool kept = fits();
  for (int i = 0; i < swath.rows; ++i) {
    const int row = swath.first_row + i;
    const std::uint64_t word = canvas_.window(row, swath.first_byte);
    canvas_.set_window(row, swath.first_byte, 0);
    if (!kept) {
      continue;
    }
    words_[index(first + i)] = word;
    for_each_bit(word, [&](int bit) {
      AgentSet& by = observable_by_[index(canvas_.cell(row, swath.first_byte, bit))];
      by = static_cast<AgentSet>(by | agents);
    });
  }
  if (kept) {
    swaths_[index(swath_count_ - 1)] = swath;
  }
}

}  // namespace ivo::planner
