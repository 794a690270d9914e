// A walk along a view, some rows at a time: how a slice ends within an edge, whatever the sight radius.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "planner/world/sight_table.hpp"

namespace ivo::planner {

class ViewWalk {
 public:
  struct Part {
    Swath swath;  ///< rows of one swath of the view
    const std::uint64_t* words = nullptr;
    bool ends_swath = false;
  };

  void begin(const SightView& view) noexcept {
    view_ = view;
    swath_ = 0;
    row_ = 0;
  }
  [[nodiscard]] bool done() const noexcept { return swath_ == view_.size(); }
  [[nodiscard]] bool reversed() const noexcept { return view_.reversed; }

  /// The next rows of the swath under way, `rows` (> 0) at most. Not when done.
  [[nodiscard]] Part next(const SightTable& sight, int rows) noexcept {
    const Swath& swath = view_.at(swath_);
    Part part{swath, sight.words(swath) + row_, false};
    part.swath.first_row += row_;
    part.swath.rows = static_cast<std::int16_t>(std::min(swath.rows - row_, rows));
    row_ += part.swath.rows;
    if (row_ == swath.rows) {
      part.ends_swath = true;
      row_ = 0;
      ++swath_;
    }
    return part;
  }

 private:
  SightView view_;
  std::size_t swath_ = 0;
  int row_ = 0;
};

}  // namespace ivo::planner
