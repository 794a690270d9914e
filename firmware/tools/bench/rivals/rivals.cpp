#include "firmware/tools/bench/rivals/rivals.hpp"

#include <array>

#include "firmware/tools/bench/rivals/greedy_planner.hpp"
#include "firmware/tools/bench/rivals/lawnmower_planner.hpp"
#include "firmware/tools/bench/rivals/receding_horizon_planner.hpp"
#include "firmware/tools/bench/rivals/rollout_tree_planner.hpp"

namespace ivo::firmware::rivals {

std::span<const NamedRival> all() {
  static constexpr std::array<NamedRival, 4> kAll = {{{"greedy one step", plan_greedily, false},
                                                      {"receding horizon", plan_with_receding_horizon, false},
                                                      {"lawnmower", plan_like_a_lawnmower, false},
                                                      {"rollout tree search", plan_by_rollouts, true}}};
  return kAll;
}

}  // namespace ivo::firmware::rivals
