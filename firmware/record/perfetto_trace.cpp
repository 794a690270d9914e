#include "firmware/record/perfetto_trace.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace ivo::firmware {
namespace {

using Notes = PerfettoFile::Notes;

Instant end_of(const TraceEvent& event) { return event.at + Duration(event.lasted_ns); }

std::string hex(const TraceEvent& event) {
  const TracedFrame frame = event.get<TracedFrame>();
  std::string text;
  for (std::size_t i = 0; i < event.code && i < frame.data.size(); ++i) {
    std::array<char, 4> byte{};
    (void)std::snprintf(byte.data(), byte.size(), i == 0 ? "%02X" : " %02X", static_cast<unsigned>(frame.data[i]));
    text += byte.data();
  }
  return text;
}

std::string cob_id(std::uint16_t id) {
  std::array<char, 8> text{};
  (void)std::snprintf(text.data(), text.size(), "%03X", static_cast<unsigned>(id));
  return text.data();
}

}  // namespace

Result<PerfettoTrace> PerfettoTrace::create(const std::string& path, Options options) {
  Result<PerfettoFile> file = PerfettoFile::create(path, "ivo", options.earlier);
  if (!file) {
    return file.error();
  }
  return PerfettoTrace(std::move(file).value(), std::move(options));
}

PerfettoTrace::PerfettoTrace(PerfettoFile file, Options options)
    : file_(std::move(file)), options_(std::move(options)), tracks_{} {
  using Unit = PerfettoFile::Unit;
  tracks_.mode = file_.add_track("mode");
  tracks_.trouble = file_.add_track("faults, overruns, bus");
  tracks_.cycle = file_.add_track("cycle");
  tracks_.planner = file_.add_track("planner");
  tracks_.in = file_.add_track("frames in");
  tracks_.out = file_.add_track("frames out");
  tracks_.cycle_ns = file_.add_track("cycle took", Unit::kNanoseconds);
  tracks_.latency_ns = file_.add_track("wake-up latency", Unit::kNanoseconds);
  tracks_.units = file_.add_track("planner units in a cycle", Unit::kCount);
  tracks_.moves = file_.add_track("planner moves in a cycle", Unit::kCount);
  tracks_.lost = file_.add_track("trace events lost", Unit::kCount);
}

void PerfettoTrace::take(const TraceEvent& event) {
  last_ = std::max(last_, event.at);
  switch (event.kind) {
    case TraceKind::kCycleBegan:
      begin_cycle(event);
      break;
    case TraceKind::kCycleEnded:
      end_cycle(event);
      break;
    case TraceKind::kPhase:
      file_.begin_slice(tracks_.cycle, event.at, TraceNames::of(options_.names.phases, event.code));
      file_.end_slice(tracks_.cycle, end_of(event));
      break;
    case TraceKind::kSlice: {
      const TracedWork work = event.get<TracedWork>();
      file_.begin_slice(tracks_.planner, event.at, TraceNames::of(options_.names.slices, event.code),
                        {{"units", work.units}, {"moves", work.moves}});
      file_.end_slice(tracks_.planner, end_of(event));
      break;
    }
    case TraceKind::kFrameIn:
    case TraceKind::kFrameOut:
      frame(event);
      break;
    case TraceKind::kMode:
      enter_mode(event);
      break;
    case TraceKind::kFault:
      file_.instant(tracks_.trouble, event.at, "fault: " + options_.names.of_fault(event));
      break;
    case TraceKind::kBusState:
      file_.instant(tracks_.trouble, event.at, "bus: " + TraceNames::of(options_.names.bus_states, event.code));
      break;
    case TraceKind::kPose:
    case TraceKind::kCommand:
    case TraceKind::kToldWheels:
    case TraceKind::kWheelAngles:
      break;  // where the robot is and goes: for the log
  }
}

void PerfettoTrace::begin_cycle(const TraceEvent& event) {
  if (cycle_open_) {  // its end was lost
    file_.end_slice(tracks_.cycle, event.at);
  }
  cycle_open_ = true;
  const TracedCycle cycle = event.get<TracedCycle>();
  file_.begin_slice(tracks_.cycle, event.at, "cycle", {{"loop time ns", cycle.loop_ns}});
  file_.count(tracks_.latency_ns, event.at, cycle.latency_ns);
  if (cycle.skipped > 0) {
    file_.instant(tracks_.trouble, event.at, "overrun", {{"periods skipped", cycle.skipped}});
  }
}

void PerfettoTrace::end_cycle(const TraceEvent& event) {
  if (std::exchange(cycle_open_, false)) {
    file_.end_slice(tracks_.cycle, end_of(event));
  }
  const TracedWork work = event.get<TracedWork>();
  file_.count(tracks_.cycle_ns, event.at, event.lasted_ns);
  file_.count(tracks_.units, event.at, work.units);
  file_.count(tracks_.moves, event.at, work.moves);
}

void PerfettoTrace::frame(const TraceEvent& event) {
  const auto named = options_.names.frames.find(event.id);
  const std::string name = named != options_.names.frames.end() ? named->second : cob_id(event.id);
  const std::string id = cob_id(event.id);
  const std::string data = hex(event);
  if (event.kind == TraceKind::kFrameOut) {
    file_.instant(tracks_.out, event.at, name, {{"COB-ID", id}, {"data", data}});
    return;
  }
  const Duration waited(event.lasted_ns);
  file_.instant(tracks_.in, options_.real_time ? event.at - waited : event.at, name,
                {{"COB-ID", id}, {"data", data}, {"waited ns", waited.count()}});
}

void PerfettoTrace::enter_mode(const TraceEvent& event) {
  if (std::exchange(mode_open_, true)) {
    file_.end_slice(tracks_.mode, event.at);
  }
  file_.begin_slice(tracks_.mode, event.at, TraceNames::of(options_.names.modes, event.code));
}

Result<void> PerfettoTrace::close(std::uint64_t lost) {
  if (mode_open_) {
    file_.end_slice(tracks_.mode, last_);
  }
  file_.count(tracks_.lost, last_, static_cast<std::int64_t>(lost));
  return file_.close(lost);
}

std::string PerfettoTrace::summary() const { return std::to_string(file_.events()) + " events in " + file_.where(); }

}  // namespace ivo::firmware
