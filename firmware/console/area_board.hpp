// The areas that are drawn on the map, for everybody the same: what a plan will be asked to heed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "config/limits.hpp"
#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::console {

struct DrawnArea {
  AreaPurpose purpose{};
  std::uint8_t agent = 0;  ///< or AreaCommand::kEverybody
  std::uint8_t corners = 0;
  std::array<Corner, kAreaCorners> corner{};
};

/// What of a mission bounds what clients say.
struct BoardRules {
  int agents = 0;
  double width_m = 0.0;  ///< of the map
  double height_m = 0.0;
};

class AreaBoard {
 public:
  using Slots = std::array<std::optional<DrawnArea>, kAreaSlots>;

  explicit AreaBoard(const BoardRules& rules) : rules_(rules) {}

  /// Refuses an agent that the mission does not have, a border that is none, an area that lies off the map, and more
  /// areas of an agent than a plan can heed. Of `area` all is in the range that CommandCheck gives it.
  [[nodiscard]] Verdict put(const AreaCommand& area);
  /// An empty slot stays as it is.
  void remove(std::uint32_t slot);

  [[nodiscard]] const Slots& slots() const noexcept { return slots_; }
  /// From 1; grows with each change.
  [[nodiscard]] std::uint32_t revision() const noexcept { return revision_; }

 private:
  [[nodiscard]] bool has_room_for(const AreaCommand& area) const;

  BoardRules rules_;
  Slots slots_{};
  std::uint32_t revision_ = 1;
};

}  // namespace ivo::firmware::console
