// events.jsonl: a line of JSON for each event of a run, in the order in which they happened, and the tracks that the
// positions make.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "firmware/record/event.hpp"

namespace ivo::firmware {

class EventLog {
 public:
  /// Begins a new file at `path`, which no other run may be writing. `agents`: names by number.
  [[nodiscard]] static Result<EventLog> create(const std::string& path, std::vector<std::string> agents);

  /// Appends all that the ring holds and hands it to the system, so that a killed program loses none of it.
  void drain(EventRing& ring);

  /// Fails when an event did not get into the file. Nothing may be drained after it.
  [[nodiscard]] Result<void> close();

  /// Where each agent was, as often as the loop recorded it.
  [[nodiscard]] const std::vector<std::vector<Point>>& tracks() const noexcept { return tracks_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { (void)std::fclose(file); }
  };
  EventLog(std::FILE* file, std::string path, std::vector<std::string> agents);
  [[nodiscard]] std::string line(const Event& event) const;

  std::unique_ptr<std::FILE, Close> file_;
  std::string path_;
  std::vector<std::string> agents_;
  std::vector<std::vector<Point>> tracks_;
  bool lost_ = false;
};

}  // namespace ivo::firmware
