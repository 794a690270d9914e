// The last emergencies of one drive, for people and records to see. Fixed size; a storm of them neither grows nor
// floods it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "drivers/canopen/emcy.hpp"

namespace ivo::drivers {

struct EmcyEntry {
  Emergency emergency;      ///< the newest of them
  Instant first{};          ///< when the first came
  Instant last{};           ///< when the newest came
  std::uint32_t count = 0;  ///< how many of this code came, each within kTogether of the one before
};

/// Entries are in the order of their first emergency, oldest first. An emergency is counted with the entry of the same
/// code that had its newest within kTogether; other codes in between do not matter. An entry beyond kEntries pushes the
/// oldest out. No more than kNewEntries are begun within kTogether: what exceeds them is a storm of ever other codes
/// and is only counted.
class EmcyHistory {
 public:
  static constexpr std::size_t kEntries = 16;
  static constexpr std::size_t kNewEntries = 8;
  static constexpr Duration kTogether = std::chrono::seconds(1);

  /// Cost: kEntries comparisons. True when it began an entry: something new to tell.
  bool add(const Emergency& emergency, Instant now) noexcept;
  void clear() noexcept { *this = EmcyHistory(); }

  [[nodiscard]] const StaticVector<EmcyEntry, kEntries>& entries() const noexcept { return entries_; }
  [[nodiscard]] std::uint64_t total() const noexcept { return total_; }          ///< emergencies, each one
  [[nodiscard]] std::uint64_t forgotten() const noexcept { return forgotten_; }  ///< of them, in no entry (any more)

 private:
  StaticVector<EmcyEntry, kEntries> entries_;
  std::uint64_t total_ = 0;
  std::uint64_t forgotten_ = 0;
  Instant window_{};  // since when begun_ counts
  std::size_t begun_ = 0;
};

}  // namespace ivo::drivers
