#include "firmware/record/perfetto_file.hpp"

#include <utility>

namespace ivo::firmware {
namespace {

// Fields of TracePacket, TrackDescriptor, ProcessDescriptor, CounterDescriptor, TrackEvent, DebugAnnotation,
// InternedData.
namespace packet {
constexpr int kTimestamp = 8, kSequence = 10, kEvent = 11, kNames = 12, kFlags = 13, kTrack = 60;
}
namespace track {
constexpr int kUuid = 1, kName = 2, kProcess = 3, kParent = 5, kCounter = 8, kOrdering = 11, kRank = 12;
}
namespace process {
constexpr int kPid = 1, kName = 6;
}
namespace counter {
constexpr int kUnit = 3;
}
namespace event {
constexpr int kNote = 4, kType = 9, kName = 10, kTrack = 11, kCount = 30;
}
namespace note {
constexpr int kName = 1, kInteger = 4, kString = 6;
}
namespace names {
constexpr int kOfEvents = 2, kOfNotes = 3, kNumber = 1, kText = 2;
}

constexpr int kPacket = 1;  // of Trace
constexpr std::uint64_t kProcessTrack = 1;
constexpr std::uint64_t kOurSequence = 1;
constexpr std::uint64_t kByRank = 3;   // the order of tracks
constexpr std::uint64_t kCleared = 1;  // of the flags: numbers of names begin anew
constexpr std::uint64_t kNeeded = 2;   // they must be known

void put_varint(std::string& out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7U) {
    out += static_cast<char>(value | 0x80);
  }
  out += static_cast<char>(value);
}
void put(std::string& out, int field, std::uint64_t value) {
  put_varint(out, static_cast<std::uint64_t>(field) << 3U);
  put_varint(out, value);
}
void put(std::string& out, int field, std::string_view bytes) {
  put_varint(out, static_cast<std::uint64_t>(field) << 3U | 2U);
  put_varint(out, bytes.size());
  out += bytes;
}
/// A message as a field of the one that holds it.
std::string within(int field, const std::string& message) {
  std::string out;
  put(out, field, message);
  return out;
}

/// A packet of our sequence, as a field of Trace.
std::string described(const std::string& track, std::uint64_t flags = 0) {
  std::string message;
  put(message, packet::kSequence, kOurSequence);
  if (flags != 0) {
    put(message, packet::kFlags, flags);
  }
  if (!track.empty()) {
    put(message, packet::kTrack, track);
  }
  return within(kPacket, message);
}

/// The number of a name. A new one is told in `fresh`, as `field` of InternedData.
std::uint64_t number_of(std::map<std::string, std::uint64_t, std::less<>>& numbers, std::string_view name, int field,
                        std::string& fresh) {
  const auto known = numbers.find(name);
  if (known != numbers.end()) {
    return known->second;
  }
  const std::uint64_t number = numbers.size() + 1;
  numbers.emplace(name, number);
  std::string entry;
  put(entry, names::kNumber, number);
  put(entry, names::kText, name);
  put(fresh, field, entry);
  return number;
}

}  // namespace

Result<PerfettoFile> PerfettoFile::create(const std::string& path, const std::string& process,
                                          RecordFile::Earlier earlier) {
  const std::string first = described({}, kCleared);
  Result<RecordFile> opened = RecordFile::create(path, first, {.record = "trace", .of = "events"}, earlier);
  if (!opened) {
    return opened.error();
  }
  PerfettoFile file(std::move(opened).value());
  file.file_.append(first, 0);
  std::string who;
  put(who, process::kPid, 1U);
  put(who, process::kName, process);
  std::string message;
  put(message, track::kUuid, kProcessTrack);
  put(message, track::kProcess, who);
  put(message, track::kOrdering, kByRank);
  file.file_.append(described(message), 0);
  return file;
}

PerfettoFile::Track PerfettoFile::add_track(const std::string& name, Unit unit) {
  ++tracks_;
  std::string message;
  put(message, track::kUuid, tracks_);
  put(message, track::kName, name);
  put(message, track::kParent, kProcessTrack);
  if (unit != Unit::kNone) {
    std::string counts;
    put(counts, counter::kUnit, static_cast<std::uint64_t>(unit));
    put(message, track::kCounter, counts);
  }
  put(message, track::kRank, tracks_);
  file_.append(described(message), 0);
  return tracks_;
}

void PerfettoFile::begin_slice(Track track, Instant at, std::string_view name, Notes notes) {
  append(at, named(track, Type::kSliceBegin, name, notes), 1);
}
void PerfettoFile::end_slice(Track track, Instant at) { append(at, named(track, Type::kSliceEnd, {}, {}), 0); }
void PerfettoFile::instant(Track track, Instant at, std::string_view name, Notes notes) {
  append(at, named(track, Type::kInstant, name, notes), 1);
}
void PerfettoFile::count(Track track, Instant at, std::int64_t value) {
  std::string message = named(track, Type::kCounter, {}, {});
  put(message, event::kCount, static_cast<std::uint64_t>(value));
  append(at, message, 1);
}

std::string PerfettoFile::named(Track track, Type type, std::string_view name, Notes notes) {
  std::string message;
  put(message, event::kType, static_cast<std::uint64_t>(type));
  put(message, event::kTrack, track);
  if (!name.empty()) {
    put(message, event::kName, number_of(names_, name, names::kOfEvents, new_names_));
  }
  for (const Note& told : notes) {
    std::string annotation;
    put(annotation, note::kName, number_of(notes_, told.name, names::kOfNotes, new_names_));
    if (const auto* number = std::get_if<std::int64_t>(&told.value)) {
      put(annotation, note::kInteger, static_cast<std::uint64_t>(*number));
    } else {
      put(annotation, note::kString, std::get<std::string_view>(told.value));
    }
    put(message, event::kNote, annotation);
  }
  return message;
}

void PerfettoFile::append(Instant at, const std::string& event, std::uint64_t holds) {
  std::string message;
  put(message, packet::kTimestamp, static_cast<std::uint64_t>(at.time_since_epoch().count()));
  put(message, packet::kSequence, kOurSequence);
  put(message, packet::kEvent, event);
  if (!new_names_.empty()) {
    put(message, packet::kNames, std::exchange(new_names_, {}));
  }
  put(message, packet::kFlags, kNeeded);
  file_.append(within(kPacket, message), holds);
}

}  // namespace ivo::firmware
