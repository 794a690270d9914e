#include "firmware/tools/doctor/disk_checks.hpp"

#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::uint64_t kComfortBytes = std::uint64_t{1} << 30U;  // hours of traces and records
constexpr std::uint64_t kLeastBytes = std::uint64_t{100} << 20U;  // one search
constexpr double kSlowMs = 100.0;
constexpr double kTooSlowMs = 1000.0;  // what is to survive is written each second

Finding room(const DiskFacts& facts) {
  const std::string check = "room";
  const std::string found =
      format("%.1f GiB free in ", static_cast<double>(facts.free_bytes) / (1U << 30U)) + facts.folder;
  const std::string remedy =
      "`du -xh " + facts.folder + " | sort -h | tail` shows what takes it; or --out on another disk";
  if (facts.free_bytes < kLeastBytes) {
    return fault(check, found + "; expected at least 0.1 GiB", remedy);
  }
  return facts.free_bytes < kComfortBytes ? warning(check, found + "; expected at least 1 GiB", remedy)
                                          : ok(check, found);
}

Finding writing(const DiskFacts& facts) {
  const std::string check = "write and sync";
  if (facts.writes.empty()) {
    return fault(check, facts.folder + ": " + (facts.refusal.empty() ? "nothing was written" : facts.refusal),
                 "a folder that this user may write: `install -d -o $USER DIR`, then --out DIR");
  }
  const auto ms = [](Duration time) { return 1e3 * seconds(time); };
  const double longest = ms(facts.writes.back());
  const std::string found =
      format("4 KiB in %.2f ms, at worst %.2f ms (of %d)", ms(facts.writes[facts.writes.size() / 2]), longest,
             static_cast<int>(facts.writes.size()));
  const std::string remedy = "another disk for --out (an SSD, no SD card), or end what writes there: `iotop -o`";
  if (longest >= kTooSlowMs) {
    return fault(check, found + format("; expected less than %.0f ms", kTooSlowMs), remedy);
  }
  return longest >= kSlowMs ? warning(check, found + format("; expected less than %.0f ms", kSlowMs), remedy)
                            : ok(check, found);
}

}  // namespace

Group disk_checks(const DiskFacts& facts) {
  Group group{"Disk for results", {room(facts), writing(facts)}};
  if (facts.in_memory) {
    group.findings.push_back(
        warning("kept", facts.folder + " is in memory: gone when the power goes", "--out DIR on a disk"));
  }
  return group;
}

}  // namespace ivo::firmware::doctor
