// `ivo bench`: figures of the search core, each bench within 8 minutes on 2 cores. Figures that are compared are taken
// in one run; the worst stands beside the median or the mean.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ivo::firmware::bench {

enum class Sense : std::uint8_t { kAtMost, kAtLeast };

struct Target {
  double value = 0.0;
  Sense sense = Sense::kAtMost;
};

/// One figure of one case.
struct Record {
  std::string bench;
  std::string case_name;
  std::string figure;
  std::optional<double> value;  ///< none: skipped, and `figure` says why
  std::string unit;
  std::optional<Target> target;
  std::optional<bool> holds;  ///< whether the value meets its target; none without one
  std::string text{};         ///< a figure in words: then `value` is none, and `holds` says whether it is as expected
  std::string clock{};        ///< what a time was taken with, where it is not processor time of one core
};

struct Options {
  bool quick = false;  ///< the shortened version, for tests
  std::string data;    ///< folder of maps and priors that are not part of the product; empty: none
};

/// What a bench writes its figures to.
class Sheet {
 public:
  explicit Sheet(std::string bench) : bench_(std::move(bench)) {}

  void add(const std::string& case_name, const std::string& figure, double value, const std::string& unit,
           std::optional<Target> target = std::nullopt);
  /// Median and worst: "FIGURE", "FIGURE, worst". A target is for the median, and says which values are bad; without
  /// one large ones are, unless `good` says otherwise. At least one value.
  void add_median(const std::string& case_name, const std::string& figure, std::vector<double> values,
                  const std::string& unit, std::optional<Target> target = std::nullopt, Sense good = Sense::kAtMost);
  /// Mean and worst, as add_median.
  void add_mean(const std::string& case_name, const std::string& figure, const std::vector<double>& values,
                const std::string& unit, std::optional<Target> target = std::nullopt);
  void skip(const std::string& case_name, const std::string& reason);
  /// A figure in words.
  void add_text(const std::string& case_name, const std::string& figure, const std::string& text, bool holds);
  /// Of all records that are added from now on.
  void clock(const std::string& name) { clock_ = name; }
  /// Records of another run of the same bench.
  void take(std::vector<Record> records);

  [[nodiscard]] const std::vector<Record>& records() const noexcept { return records_; }

 private:
  void put(Record record);

  std::string bench_;
  std::string clock_;
  std::vector<Record> records_;
};

/// Of at least one value.
[[nodiscard]] double mean(const std::vector<double>& values);

struct Bench {
  const char* name = "";
  const char* about = "";  ///< one line
  void (*run)(const Options& options, Sheet& sheet) = nullptr;
  /// Its records for people, where they are more than a table of figures (bench_report.hpp); none: table_of.
  std::string (*table)(std::span<const Record> records) = nullptr;
};

/// In the order in which `ivo bench all` runs them.
[[nodiscard]] std::span<const Bench> benches();

void table1(const Options& options, Sheet& sheet);
void speed(const Options& options, Sheet& sheet);
void quality(const Options& options, Sheet& sheet);
void scale(const Options& options, Sheet& sheet);
void compare(const Options& options, Sheet& sheet);
void can(const Options& options, Sheet& sheet);
void loop(const Options& options, Sheet& sheet);

}  // namespace ivo::firmware::bench
