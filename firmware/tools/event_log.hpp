// events.jsonl: a line of JSON for each event of a run, in the order in which they happened, and the tracks that the
// positions make. A run that takes up a search that was cut off goes on with its log.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "firmware/record/event.hpp"
#include "firmware/tools/resume/logged_run.hpp"

namespace ivo::firmware {

class EventLog {
 public:
  /// Opens the file at `path`, which no other run may be writing, as it is. `agents`: names by number. Then one of
  /// start_anew() and go_on().
  [[nodiscard]] static Result<EventLog> open(const std::string& path, std::vector<std::string> agents);
  /// An empty file. What was in it is kept as `previous`, unless that is empty.
  [[nodiscard]] Result<void> start_anew(const std::string& previous);
  /// Behind the last whole line of `run`, which was read of this file, with a line that says so. Time goes on where
  /// that ended, when the clock does not. `search_s`: how long had been searched.
  [[nodiscard]] Result<void> go_on(const LoggedRun& run, double search_s);

  /// Appends all that the ring holds and hands it to the system, so that a killed program loses none of it.
  void drain(EventRing& ring);

  /// Fails when an event did not get into the file. Nothing may be drained after it.
  [[nodiscard]] Result<void> close();

  /// In the file, to the end of its last line.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  /// What the log calls this moment.
  [[nodiscard]] double time_s(Instant at) const noexcept;
  /// To be synced by who keeps a state beside it; open until close().
  [[nodiscard]] int descriptor() const noexcept { return fileno(file_.get()); }

  /// Where each agent was, as often as the loop recorded it.
  [[nodiscard]] const std::vector<std::vector<Point>>& tracks() const noexcept { return tracks_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { (void)std::fclose(file); }
  };
  EventLog(std::FILE* file, std::string path, std::vector<std::string> agents);
  void append(const std::string& line);
  [[nodiscard]] std::string line(const Event& event) const;

  std::unique_ptr<std::FILE, Close> file_;
  std::string path_;
  std::vector<std::string> agents_;
  std::vector<std::vector<Point>> tracks_;
  std::uint64_t bytes_ = 0;
  double ended_s_ = 0.0;           // of a log that is gone on with
  std::optional<Duration> shift_;  // of its time; known with the first event
  bool lost_ = false;
};

}  // namespace ivo::firmware
