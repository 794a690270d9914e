// A robot of each PDO layout.
#pragma once

#include <array>
#include <chrono>

#include "config/robot.hpp"

namespace ivo::fuzz {

/// `layout` 0: a command frame for each drive, 500 Hz; 1: two drives share their targets, 1 kHz, one drive is geared.
inline const Robot& robot_of(unsigned layout) {
  static const std::array<Robot, 2> robots = [] {
    std::array<Robot, 2> both{};
    both[1].pdo_layout = PdoLayout::kShared;
    both[1].cycle = std::chrono::milliseconds(1);
    both[1].drives[2].gear_ratio = 20.0;
    return both;
  }();
  return robots[layout];
}

}  // namespace ivo::fuzz
