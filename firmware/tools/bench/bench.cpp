#include "firmware/tools/bench/bench.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "config/base/contract.hpp"
#include "firmware/tools/bench/can/fault_report.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr std::array<Bench, 7> kBenches = {{
    {"table1", "the paper's Table I: eight rows, both heuristics, beside the paper's figures", table1},
    {"speed", "400 generations of 10 ants in the paper's profile, tables apart", speed},
    {"quality", "the fast profile's expected time after 0.1, 1 and 10 s, beside the bound", quality},
    {"compare", "four other planners on the same scenes in the same time", compare},
    {"scale", "the cost of a generation from 100 nodes up, and real maps and priors", scale},
    {"can", "the wheel bus: its cost, its load, and each of 28 faults provoked on a kernel's own bus", can,
     table_with_faults},
    {"loop",
     "a cycle by phase on the virtual bus, planning or not, traced or not, here and in toolchain/rt; what the objects "
     "weigh",
     loop},
}};

double worst_of(const std::vector<double>& values, Sense good) {
  return good == Sense::kAtLeast ? *std::min_element(values.begin(), values.end())
                                 : *std::max_element(values.begin(), values.end());
}

}  // namespace

std::span<const Bench> benches() { return kBenches; }

double mean(const std::vector<double>& values) {
  IVO_CONTRACT(!values.empty());
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void Sheet::add(const std::string& case_name, const std::string& figure, double value, const std::string& unit,
                std::optional<Target> target) {
  std::optional<bool> holds;
  if (target) {
    holds = target->sense == Sense::kAtMost ? value <= target->value : value >= target->value;
  }
  put({bench_, case_name, figure, value, unit, target, holds});
}

void Sheet::add_median(const std::string& case_name, const std::string& figure, std::vector<double> values,
                       const std::string& unit, std::optional<Target> target, Sense good) {
  IVO_CONTRACT(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  add(case_name, figure, 0.5 * (values[(n - 1) / 2] + values[n / 2]), unit, target);
  add(case_name, figure + ", worst", worst_of(values, target ? target->sense : good), unit);
}

void Sheet::add_mean(const std::string& case_name, const std::string& figure, const std::vector<double>& values,
                     const std::string& unit, std::optional<Target> target) {
  add(case_name, figure, mean(values), unit, target);
  add(case_name, figure + ", worst", worst_of(values, target ? target->sense : Sense::kAtMost), unit);
}

void Sheet::skip(const std::string& case_name, const std::string& reason) {
  put({bench_, case_name, "skipped: " + reason, std::nullopt, "", std::nullopt, std::nullopt});
}

void Sheet::add_text(const std::string& case_name, const std::string& figure, const std::string& text, bool holds) {
  put({bench_, case_name, figure, std::nullopt, "", std::nullopt, holds, text});
}

void Sheet::take(std::vector<Record> records) {
  for (Record& record : records) {
    records_.push_back(std::move(record));
  }
}

void Sheet::put(Record record) {
  record.clock = clock_;
  records_.push_back(std::move(record));
}

}  // namespace ivo::firmware::bench
