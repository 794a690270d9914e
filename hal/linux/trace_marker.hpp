// Lines in the kernel's own trace, beside what its scheduler and drivers say: "B|pid|name" and "E|pid", as kernelshark
// shows and Perfetto draws them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.hpp"
#include "hal/api/cycle_marker.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::hal {

/// A system call a line: for whoever asks for it. A line that the kernel does not take is counted.
class TraceMarker final : public CycleMarker {
 public:
  /// Where tracefs is mounted.
  static constexpr const char* kFile = "/sys/kernel/tracing/trace_marker";

  /// `phases`: names of what a cycle does, in order. All lines are made here. Fails when the file cannot be written,
  /// which root alone may.
  [[nodiscard]] static Result<TraceMarker> open(std::span<const std::string_view> phases,
                                                const std::string& path = kFile);

  void begin_cycle() noexcept override;
  void end_phase(std::size_t phase) noexcept override;
  void end_cycle() noexcept override { write(end_); }
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  TraceMarker(FileDescriptor file, std::span<const std::string_view> phases);
  void write(const std::string& line) noexcept;

  FileDescriptor file_;
  std::string begin_cycle_;
  std::vector<std::string> begin_;  // of each phase
  std::string end_;
  std::uint64_t lost_ = 0;
};

}  // namespace ivo::hal
