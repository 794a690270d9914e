// A bench's records as a table for people and as JSON for programs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/tools/bench/bench.hpp"

namespace ivo::firmware::bench {

/// A case a row, a figure a column, aligned; cases with a figure in common and one clock share a table. A figure with a
/// target stands with it and with whether it holds. Ends with a line break.
[[nodiscard]] std::string table_of(std::span<const Record> records);

/// A list with a record a figure, as config/schemas/bench.schema.json says.
[[nodiscard]] std::string json_of(std::span<const Record> records);

/// What json_of wrote; `path` is for the complaint.
[[nodiscard]] Result<std::vector<Record>> records_of(const std::string& json, const std::string& path);

}  // namespace ivo::firmware::bench
