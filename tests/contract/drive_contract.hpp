// What is expected of every wheel drive, simulated or real, as checks one by one: CiA 301 and CiA 402 as far as the
// product relies on them, and what its own simulation promises beyond.
#pragma once

#include <span>

#include "tests/contract/drive_bench.hpp"

namespace ivo::contract {

struct Check {
  const char* name = "";
  bool turns = false;  ///< the wheel
  void (*run)(DriveBench&) = nullptr;
};

/// Each begins with a reset of the node, and needs nothing of the others. Throws Broken or NotThere.
[[nodiscard]] std::span<const Check> drive_contract();

// In parts.
[[nodiscard]] std::span<const Check> node_checks();
[[nodiscard]] std::span<const Check> sdo_checks();
[[nodiscard]] std::span<const Check> pdo_checks();
[[nodiscard]] std::span<const Check> power_checks();
[[nodiscard]] std::span<const Check> emergency_checks();

}  // namespace ivo::contract
