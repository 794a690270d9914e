// Keeps states in a StateFile from a thread of its own, so that nobody waits for the disk.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "firmware/record/state_file.hpp"

namespace ivo::firmware {

class StateWriter {
 public:
  /// `log`: a file of which the states tell how long it was; synced before each of them. The caller may close it.
  StateWriter(StateFile file, int log);
  /// What was handed over is written first.
  ~StateWriter();
  StateWriter(const StateWriter&) = delete;
  StateWriter& operator=(const StateWriter&) = delete;

  /// Never waits for the disk: of states that come faster than the disk takes them the newest counts.
  void keep(std::string state);
  /// Waits until this one is on the disk.
  [[nodiscard]] Result<void> keep_and_wait(std::string state);
  /// Why the last state that was tried is not on the disk; none when it is. What comes next is tried all the same.
  [[nodiscard]] std::optional<Error> failure();

 private:
  void write_in_turn();
  [[nodiscard]] Result<void> written(const std::string& state) noexcept;

  StateFile file_;
  int log_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::string> next_;
  std::uint64_t handed_over_ = 0;
  std::uint64_t done_ = 0;  // with states up to this one
  std::optional<Error> failure_;
  bool closing_ = false;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace ivo::firmware
