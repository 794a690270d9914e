// A trace as Perfetto reads it (ui.perfetto.dev, trace_processor): a row of protobuf messages TracePacket, each whole.
// Names are sent once and referred to by number from then on. Field numbers: protos/perfetto/trace of Perfetto.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "firmware/record/record_file.hpp"

namespace ivo::firmware {

/// Outside the loop. Packets go out with write_out(); a killed program's file ends with a whole one, and opens.
class PerfettoFile {
 public:
  using Track = std::uint64_t;  ///< from 1; 0 is no track
  enum class Unit : std::uint8_t { kNone = 0, kNanoseconds = 1, kCount = 2 };
  /// Shown beside a slice: a name and a value.
  struct Note {
    std::string_view name;
    std::variant<std::int64_t, std::string_view> value;
  };
  using Notes = std::initializer_list<Note>;

  /// A new file (RecordFile::create); anything there that is no trace of ours is refused. `process`: the group that all
  /// tracks are shown in.
  [[nodiscard]] static Result<PerfettoFile> create(const std::string& path, const std::string& process,
                                                   RecordFile::Earlier earlier = RecordFile::Earlier::kReplaced);

  /// Tracks are shown in the order in which they are made.
  /// `unit`: of a track that counts.
  Track add_track(const std::string& name, Unit unit = Unit::kNone);

  // Of one track, times do not go back; slices nest as their times do.
  void begin_slice(Track track, Instant at, std::string_view name, Notes notes = {});
  void end_slice(Track track, Instant at);
  void instant(Track track, Instant at, std::string_view name, Notes notes = {});
  void count(Track track, Instant at, std::int64_t value);

  void write_out() { file_.write_out(); }
  [[nodiscard]] Result<void> close(std::uint64_t lost_before) { return file_.close(lost_before); }
  /// Slices, instants and counts in the file.
  [[nodiscard]] std::uint64_t events() const noexcept { return file_.count(); }
  [[nodiscard]] std::string where() const { return file_.where(); }

 private:
  enum class Type : std::uint8_t { kSliceBegin = 1, kSliceEnd = 2, kInstant = 3, kCounter = 4 };
  using Numbers = std::map<std::string, std::uint64_t, std::less<>>;

  explicit PerfettoFile(RecordFile file) : file_(std::move(file)) {}
  std::string named(Track track, Type type, std::string_view name, Notes notes);
  void append(Instant at, const std::string& event, std::uint64_t holds);

  RecordFile file_;
  Track tracks_ = 1;       // made so far; the first is the process
  Numbers names_;          // of events
  Numbers notes_;          // of their notes
  std::string new_names_;  // told with the next packet
};

}  // namespace ivo::firmware
