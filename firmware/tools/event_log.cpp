#include "firmware/tools/event_log.hpp"

#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "firmware/files/number_text.hpp"
#include "firmware/loop/loop_status.hpp"

namespace ivo::firmware {
namespace {

std::string json_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + '"';
}

std::string field(std::string_view key, const std::string& value) { return ",\"" + std::string(key) + "\":" + value; }
std::string field(std::string_view key, double value) { return field(key, shortest(value)); }
std::string field(std::string_view key, std::int32_t value) { return field(key, std::to_string(value)); }

std::string_view name_of(StopCause cause) {
  switch (cause) {
    case StopCause::kNoConsent:
      return "nobody consented";
    case StopCause::kPlanNotKept:
      return "the plans could not be written";
    case StopCause::kNone:
    case StopCause::kAsked:
      break;
  }
  return "operator";
}

std::string_view name_of(PauseCause cause) {
  switch (cause) {
    case PauseCause::kBeatLost:
      return "the operator's page is not heard";
    case PauseCause::kReplan:
      return "a plan is made anew";
    case PauseCause::kNoGo:
      return "a no-go area lies ahead";
    case PauseCause::kNone:
    case PauseCause::kAsked:
      break;
  }
  return "operator";
}

std::string_view name_of(Lateness lateness) {
  switch (lateness) {
    case Lateness::kRampDown:
      return "ramp down";
    case Lateness::kLatched:
      return "fault";
    case Lateness::kHeld:
      return "hold";
    case Lateness::kInTime:  // nothing may move
      break;
  }
  return "nothing";
}
Error cannot_be_written(const std::string& path) { return {path + ": cannot be written: " + std::strerror(errno)}; }

std::string place(const Event& event) { return field("x_m", event.x) + field("y_m", event.y); }

}  // namespace

Result<EventLog> EventLog::open(const std::string& path, std::vector<std::string> agents) {
  std::FILE* file = std::fopen(path.c_str(), "ae");
  if (file == nullptr) {
    return cannot_be_written(path);
  }
  EventLog log(file, path, std::move(agents));
  // Held until the process ends, however it ends.
  if (flock(fileno(file), LOCK_EX | LOCK_NB) != 0) {
    return Error{path + ": another run is writing here; expected a folder of its own for each run"};
  }
  return log;
}

Result<void> EventLog::start_anew(const std::string& previous) {
  const bool empty = std::fseek(file_.get(), 0, SEEK_END) == 0 && std::ftell(file_.get()) == 0;
  if (!previous.empty() && !empty) {
    if (std::rename(path_.c_str(), previous.c_str()) != 0) {
      return cannot_be_written(previous);
    }
    Result<EventLog> anew = open(path_, agents_);
    if (!anew) {
      return anew.error();
    }
    *this = std::move(anew).value();
  }
  return ftruncate(descriptor(), 0) == 0 ? Result<void>() : cannot_be_written(path_);
}

Result<void> EventLog::go_on(const LoggedRun& run, double search_s) {
  if (ftruncate(descriptor(), static_cast<off_t>(run.whole_bytes)) != 0) {
    return cannot_be_written(path_);
  }
  bytes_ = run.whole_bytes;
  tracks_ = run.tracks;
  ended_s_ = run.last_s;
  shift_.reset();
  append("{\"t_s\":" + shortest(ended_s_) + field("event", json_quoted("resumed")) + field("search_time_s", search_s) +
         "}");
  return lost_ || std::fflush(file_.get()) != 0 ? cannot_be_written(path_) : Result<void>();
}

double EventLog::time_s(Instant at) const noexcept {
  const Duration since = at.time_since_epoch();
  return seconds(since + shift_.value_or(std::max(Duration::zero(), from_seconds(ended_s_) - since)));
}

EventLog::EventLog(std::FILE* file, std::string path, std::vector<std::string> agents)
    : file_(file), path_(std::move(path)), agents_(std::move(agents)), tracks_(agents_.size()) {}

void EventLog::drain(EventRing& ring) {
  bool any = false;
  for (Event event; ring.pop(event); any = true) {
    if (event.kind == EventKind::kPosition) {
      tracks_[event.agent].push_back({event.x, event.y});
    }
    if (!shift_) {
      shift_ = std::max(Duration::zero(), from_seconds(ended_s_) - event.at.time_since_epoch());
    }
    append(line(event));
  }
  lost_ = lost_ || ring.lost() > 0 || (any && std::fflush(file_.get()) != 0);
}

Result<void> EventLog::close() {
  const bool closed = std::fclose(file_.release()) == 0;
  if (lost_ || !closed) {
    return Error{path_ + ": events were lost; expected room on the disk and a disk that keeps up"};
  }
  return {};
}

void EventLog::append(const std::string& line) {
  const std::string text = line + "\n";
  lost_ = lost_ || std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size();
  bytes_ += text.size();
}

std::string EventLog::line(const Event& event) const {
  const auto text = [&](std::string_view name, const std::string& fields = {}) {
    return "{\"t_s\":" + shortest(time_s(event.at)) + field("event", json_quoted(name)) + fields + "}";
  };
  const auto agent = [&] { return field("agent", json_quoted(agents_[event.agent])); };
  switch (event.kind) {
    case EventKind::kMode:
      return text("mode", field("mode", json_quoted(name_of(static_cast<Mode>(event.code)))));
    case EventKind::kPlanImproved:
      return text("plan improved",
                  field("generation", event.code) + field("expected_time_s", event.x) + field("unseen_mass", event.y));
    case EventKind::kPlanReady:
      return text("plan ready", field("generations", event.code));
    case EventKind::kConsent:
      return text("consent");
    case EventKind::kStopAsked:
      return text("stop asked", field("cause", json_quoted(name_of(static_cast<StopCause>(event.code)))));
    case EventKind::kSearchStarted:
      return text("search started");
    case EventKind::kPosition:
      return text("position", agent() + place(event));
    case EventKind::kFound:
      return text("found", agent() + place(event));
    case EventKind::kPathsEnded:
      return text("paths ended");
    case EventKind::kDriveFault:
      return text("drive fault", field("wheel", std::int32_t{event.agent}) + field("reason", event.code));
    case EventKind::kOverrun:
      return text("overrun", field("periods", event.code) +
                                 field("then", json_quoted(name_of(static_cast<Lateness>(event.agent)))));
    case EventKind::kBusState:
      return text("bus", field("state", json_quoted(hal::name_of(static_cast<hal::BusState>(event.code)))));
    case EventKind::kFaultCleared:
      return text("fault cleared");
    case EventKind::kPaused:
      return text("paused", field("cause", json_quoted(name_of(static_cast<PauseCause>(event.code)))));
    case EventKind::kPlanAsked:
      return text("plan asked", field("plan", event.code));
    case EventKind::kPlanTaken:
      return text("plan taken", field("plan", event.code));
  }
  return text("unknown");
}

}  // namespace ivo::firmware
