// What each edge shows, as words of bits over the cells, cut into pieces of about a metre: what a move would add to
// what is seen is a few masked words instead of hundreds of cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/search/edge_events.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware::rivals {

/// One bit a cell.
using CellSet = std::vector<std::uint64_t>;

/// Cells of one word that come into sight around the same point of an edge.
struct CoverageRow {
  std::uint64_t bits = 0;
  std::uint32_t word = 0;
  float at = 0.0F;  ///< share of the edge at which they are counted as seen
};

class Coverage {
 public:
  /// Cost: the sight table's events, sorted edge by edge.
  Coverage(const planner::Planner& prepared, const planner::SearchProblem& search);

  [[nodiscard]] std::size_t words() const { return words_; }
  [[nodiscard]] std::span<const CoverageRow> along(int agent, planner::Edge e) const {
    return rows_of(layers_[layer_[static_cast<std::size_t>(agent)]].edges, static_cast<std::size_t>(e));
  }
  [[nodiscard]] std::span<const CoverageRow> around(int agent, planner::Node n) const {
    return rows_of(layers_[layer_[static_cast<std::size_t>(agent)]].nodes, static_cast<std::size_t>(n));
  }

  /// p of the cells in a word's bits. Cost: constant on a uniform prior, else the bits.
  [[nodiscard]] double mass(std::uint32_t word, std::uint64_t bits) const;
  /// p of the rows' cells that are not in `seen`.
  [[nodiscard]] double new_mass(std::span<const CoverageRow> rows, const CellSet& seen) const;

 private:
  struct Layer {
    double radius_m = 0.0;
    std::vector<std::uint32_t> edges;  // where the rows of each edge begin
    std::vector<std::uint32_t> nodes;
  };
  [[nodiscard]] std::span<const CoverageRow> rows_of(const std::vector<std::uint32_t>& firsts, std::size_t i) const {
    return {rows_.data() + firsts[i], rows_.data() + firsts[i + 1]};
  }
  void add_rows(std::span<const planner::SightEvent> events, int points, double piece_points);

  const planner::Belief& belief_;
  std::size_t words_;
  double uniform_mass_ = 0.0;       // of every cell with mass; 0 when they differ
  std::vector<std::size_t> layer_;  // of each agent
  std::vector<Layer> layers_;
  std::vector<CoverageRow> rows_;
  std::vector<std::uint64_t> keys_;  // while building
  std::vector<planner::SightEvent> around_;
};

}  // namespace ivo::firmware::rivals
