#include "firmware/tools/bench/bench_command.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "config/limits.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/tools/bench/bench_report.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

void run_one(const Bench& bench, const Options& options, std::vector<Record>& records) {
  (void)std::printf("%s: %s%s, %s capacity\n", bench.name, bench.about, options.quick ? ", shortened" : "",
                    limits::Planner::kName);
  (void)std::fflush(stdout);
  const auto begin = std::chrono::steady_clock::now();
  Sheet sheet(bench.name);
  bench.run(options, sheet);
  const double taken_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  (void)std::printf("%s(%.0f s)\n\n", (bench.table != nullptr ? bench.table : table_of)(sheet.records()).c_str(),
                    taken_s);
  (void)std::fflush(stdout);
  records.insert(records.end(), sheet.records().begin(), sheet.records().end());
}

std::string names() {
  std::string names;
  for (const Bench& bench : benches()) {
    names += std::string(bench.name) + ", ";
  }
  return names + "all";
}

}  // namespace

int run(const CommandOptions& options) {
  if (options.name.empty()) {
    for (const Bench& bench : benches()) {
      say(bench.name, bench.about);
    }
    say("all", "these, one after the other");
    return exit_status::kEnded;
  }
  const bool all = options.name == "all";
  const auto named = [&](const Bench& bench) { return options.name == bench.name; };
  if (!all && std::none_of(benches().begin(), benches().end(), named)) {
    return refuse({"no bench is called \"" + options.name + "\"; expected " + names()});
  }
  if (!options.json.empty()) {  // now, and not after minutes of work
    if (const Result<void> writable = check_writable(options.json); !writable) {
      return refuse(writable.error());
    }
  }
  std::vector<Record> records;
  for (const Bench& bench : benches()) {
    if (all || named(bench)) {
      run_one(bench, options.bench, records);
    }
  }
  if (!options.json.empty()) {
    if (const Result<void> written = write_file(options.json, json_of(records)); !written) {
      complain(written.error());
      return exit_status::kFaultOrStop;
    }
    say("wrote", options.json);
  }
  return exit_status::kEnded;
}

}  // namespace ivo::firmware::bench
