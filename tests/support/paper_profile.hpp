// The paper's colony, whatever the default profile is.
#pragma once

namespace ivo::test {

/// `colony` is planner::ColonyParameters. One that knows no profiles is the paper's.
template <class Colony>
void use_paper_profile(Colony& colony) {
  if constexpr (requires { colony.profile; }) {
    colony.profile = decltype(colony.profile)::kPaper;
  }
}

}  // namespace ivo::test
