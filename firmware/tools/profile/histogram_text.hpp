// A histogram of times as bars of characters.
#pragma once

#include <cstdint>
#include <string>

#include "config/base/time_histogram.hpp"

namespace ivo::firmware {

/// A line a range, from the fastest to where 99.9 % lie and one for the rest; nothing without a value.
[[nodiscard]] std::string histogram_text(const TimeHistogram& times);

/// "12,345"
[[nodiscard]] std::string grouped(std::uint64_t number);

}  // namespace ivo::firmware
