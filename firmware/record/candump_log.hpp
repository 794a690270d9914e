// A record of frames as `candump -L` of can-utils writes it, so that canplayer, tshark and the like read it:
// "(1436509052.249713) can0 181#112233445566", a line a frame.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "firmware/record/recording_bus.hpp"

namespace ivo::firmware {

/// Outside the loop: every call may wait for the disk. Each drain hands whole lines to the system, so a program that is
/// killed loses only what was not drained. When the disk refuses, the file ends with the last whole line that it took
/// and the record with it; close() says so.
class CandumpLog {
 public:
  /// Begins a new file at `path`; an earlier record there is replaced, anything else is refused. `interface`: the name
  /// on every line. `epoch`: what a reader's clock says at Instant{}; zero for simulated time.
  [[nodiscard]] static Result<CandumpLog> create(const std::string& path, const std::string& interface, Duration epoch);

  /// Appends all that the ring holds.
  void drain(FrameRing& ring);

  /// Fails when a frame is not in the file, and says how many. Nothing may be drained after it.
  [[nodiscard]] Result<void> close(const FrameRing& ring);

  /// Frames in the file.
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }

 private:
  /// A file descriptor that is closed once.
  class File {
   public:
    explicit File(int fd) noexcept : fd_(fd) {}
    File(File&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    File& operator=(File&&) = delete;
    ~File() { (void)close(); }
    [[nodiscard]] int fd() const noexcept { return fd_; }
    bool close() noexcept;

   private:
    int fd_;
  };

  CandumpLog(int file, std::string path, std::string interface, Duration epoch);
  void append(const RecordedFrame& recorded);
  void write_out();

  File file_;
  std::string path_;
  std::string interface_;
  Duration epoch_;
  std::string lines_;             // not written yet
  std::uint64_t lines_held_ = 0;  // in lines_
  std::uint64_t frames_ = 0;
  std::uint64_t missing_ = 0;
  int failure_ = 0;  // errno of the write that ended the record
};

/// The line of one frame, with its end.
[[nodiscard]] std::string candump_line(const RecordedFrame& recorded, const std::string& interface, Duration epoch);

}  // namespace ivo::firmware
