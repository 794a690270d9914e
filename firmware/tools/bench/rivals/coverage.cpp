#include "firmware/tools/bench/rivals/coverage.hpp"

#include <algorithm>
#include <bit>
#include <memory>

namespace ivo::firmware::rivals {

Coverage::Coverage(const planner::Planner& prepared, const planner::SearchProblem& search)
    : belief_(prepared.belief()), words_((planner::index(prepared.cells().count()) + 63) / 64) {
  constexpr double kPieceM = 1.0;
  const std::span<const planner::Cell> cells = belief_.cells_with_mass();
  const double first = planner::to_double(belief_.mass[planner::index(cells.front())]);
  const bool uniform = std::all_of(cells.begin(), cells.end(), [&](planner::Cell c) {
    return planner::to_double(belief_.mass[planner::index(c)]) == first;
  });
  uniform_mass_ = uniform ? first : 0.0;

  const planner::Graph& graph = prepared.graph();
  const planner::SightTable& sight = prepared.sight();
  const auto events = std::make_unique<planner::EdgeEvents>(prepared.cells(), graph, sight);
  events->clear();
  for (std::size_t m = 0; m < search.agents.size(); ++m) {
    const double radius_m = search.agents[m].sight_radius_m;
    const auto known =
        std::find_if(layers_.begin(), layers_.end(), [&](const Layer& layer) { return layer.radius_m == radius_m; });
    layer_.push_back(static_cast<std::size_t>(known - layers_.begin()));
    if (known != layers_.end()) {
      continue;
    }
    const auto agent = static_cast<int>(m);
    Layer layer{radius_m, {}, {}};
    const auto here = [&] { return static_cast<std::uint32_t>(rows_.size()); };
    for (planner::Node n = 0; n < graph.nodes(); ++n) {
      for (planner::Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
        layer.edges.push_back(here());
        while (events->prepare(agent, n, e, 1 << 20) > 0) {
        }
        add_rows(events->along(agent, e), sight.points(e), 2.0 * kPieceM / prepared.cells().cell_m());
      }
    }
    layer.edges.push_back(here());
    for (planner::Node n = 0; n < graph.nodes(); ++n) {
      layer.nodes.push_back(here());
      around_.clear();
      for (const planner::Swath& swath : sight.from_node(agent, n).swaths) {
        for (int i = 0; i < swath.rows; ++i) {
          const planner::Cell leftmost = prepared.cells().at(8 * swath.first_byte, swath.first_row + i);
          planner::for_each_bit(sight.words(swath)[i],
                                [&](int bit) { around_.push_back(planner::SightEvent(leftmost + bit, 0)); });
        }
      }
      add_rows(around_, 1, 1.0);
    }
    layer.nodes.push_back(here());
    layers_.push_back(std::move(layer));
  }
}

void Coverage::add_rows(std::span<const planner::SightEvent> events, int points, double piece_points) {
  const int pieces = std::max(1, static_cast<int>(points / piece_points + 0.5));
  // Piece, then word, then bit: a cell is below 2^22.
  keys_.clear();
  for (const planner::SightEvent event : events) {
    if (belief_.mass[planner::index(event.cell())] <= planner::Mass{}) {
      continue;
    }
    const auto piece = static_cast<std::uint64_t>(std::max(0, event.point() - 1)) * static_cast<std::uint64_t>(pieces) /
                       static_cast<std::uint64_t>(points);
    keys_.push_back(piece << 32U | static_cast<std::uint64_t>(event.cell()));
  }
  std::sort(keys_.begin(), keys_.end());
  std::uint64_t last = ~std::uint64_t{0};
  for (const std::uint64_t key : keys_) {
    if (key >> 6U != last) {
      last = key >> 6U;
      const auto middle = (static_cast<float>(key >> 32U) + 0.5F) / static_cast<float>(pieces);
      rows_.push_back({0, static_cast<std::uint32_t>(key & 0xFFFFFFFFU) >> 6U, middle});
    }
    rows_.back().bits |= std::uint64_t{1} << (key & 63U);
  }
}

double Coverage::mass(std::uint32_t word, std::uint64_t bits) const {
  if (uniform_mass_ > 0.0) {
    return uniform_mass_ * std::popcount(bits);
  }
  double sum = 0.0;
  for (const planner::Mass* const mass = belief_.mass.data() + std::size_t{word} * 64; bits != 0; bits &= bits - 1) {
    sum += planner::to_double(mass[std::countr_zero(bits)]);
  }
  return sum;
}

double Coverage::new_mass(std::span<const CoverageRow> rows, const CellSet& seen) const {
  double sum = 0.0;
  for (const CoverageRow& row : rows) {
    if (const std::uint64_t bits = row.bits & ~seen[row.word]; bits != 0) {
      sum += mass(row.word, bits);
    }
  }
  return sum;
}

}  // namespace ivo::firmware::rivals
