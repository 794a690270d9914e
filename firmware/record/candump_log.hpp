// A record of frames as `candump -L` of can-utils writes it, so that canplayer, tshark and the like read it:
// "(1436509052.249713) can0 181#112233445566", a line a frame.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "firmware/record/record_file.hpp"
#include "firmware/record/recording_bus.hpp"

namespace ivo::firmware {

/// Outside the loop: every call may wait for the disk. Each drain hands whole lines to the system; what a killed
/// program or a full disk leaves: record_file.hpp.
class CandumpLog {
 public:
  /// A new file at `path` (RecordFile::create); anything there that is no record is refused. `interface`: the name on
  /// every line. `epoch`: what a reader's clock says at Instant{}; zero for simulated time.
  [[nodiscard]] static Result<CandumpLog> create(const std::string& path, const std::string& interface, Duration epoch,
                                                 RecordFile::Earlier earlier = RecordFile::Earlier::kReplaced);

  /// Appends all that the ring holds.
  void drain(FrameRing& ring);

  /// Fails when a frame is not in the file, and says how many. Nothing may be drained after it.
  [[nodiscard]] Result<void> close(const FrameRing& ring) { return file_.close(ring.lost()); }

  /// Frames in the file.
  [[nodiscard]] std::uint64_t frames() const noexcept { return file_.count(); }
  /// "4711 frames in FILE"
  [[nodiscard]] std::string summary() const { return std::to_string(frames()) + " frames in " + file_.where(); }

 private:
  CandumpLog(RecordFile file, std::string interface, Duration epoch)
      : file_(std::move(file)), interface_(std::move(interface)), epoch_(epoch) {}

  RecordFile file_;
  std::string interface_;
  Duration epoch_;
};

/// The line of one frame, with its end.
[[nodiscard]] std::string candump_line(const RecordedFrame& recorded, const std::string& interface, Duration epoch);

}  // namespace ivo::firmware
