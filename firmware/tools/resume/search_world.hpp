// Where a search goes on: what simulated drives did says nothing about where a robot stands.
#pragma once

#include <string>

#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_world.hpp"

namespace ivo::firmware {

/// "the virtual bus", "a simulated interface", whichever it is, or the name of a real one. `time`: of the world that is
/// opened by `options`.
[[nodiscard]] std::string search_world(const RunOptions& options, RunWorld::Time time);

/// Why a search that was begun in `kept` is not to be taken up in `now`; empty when it can be.
[[nodiscard]] std::string other_world(const std::string& kept, const std::string& now);

}  // namespace ivo::firmware
