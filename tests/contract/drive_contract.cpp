#include "tests/contract/drive_contract.hpp"

#include <vector>

namespace ivo::contract {

std::span<const Check> drive_contract() {
  static const std::vector<Check> all = [] {
    std::vector<Check> checks;
    for (const auto part : {node_checks(), sdo_checks(), pdo_checks(), power_checks(), emergency_checks()}) {
      checks.insert(checks.end(), part.begin(), part.end());
    }
    return checks;
  }();
  return all;
}

}  // namespace ivo::contract
