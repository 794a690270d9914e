#include "firmware/tools/run_terminal.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "drivers/drive_fault_text.hpp"
#include "firmware/tools/plan_terminal.hpp"

namespace ivo::firmware {
namespace {

std::string positions(const RunView& run, const LoopStatus& status) {
  std::string text;
  const auto& agents = run.inputs.file.mission.agents;
  for (std::size_t m = 0; m < agents.size(); ++m) {
    text += "  " + agents[m].name + " " + place_text(status.tracks[m].position);
  }
  return text;
}

std::string bus_text(const LoopStatus& status) {
  const hal::BusState state = status.counters.bus_state;
  return state == hal::BusState::kActive ? "" : "  bus: " + std::string(hal::name_of(state));
}

std::string lateness_text(const LoopStatus& status) {
  if (status.lateness == Lateness::kInTime) {
    return "";
  }
  return format("  %llu periods lost", static_cast<unsigned long long>(status.counters.skipped)) +
         (status.lateness == Lateness::kRampDown ? ", slowing down" : "");
}

}  // namespace

RunTerminal::RunTerminal(const RunView& run) : run_(&run) {}

void RunTerminal::show_mission(const std::string& bus) const {
  ivo::firmware::show_mission(*run_);
  say("bus", bus);
}

void RunTerminal::show_planning(const planner::Progress& progress) {
  if (progress.generations > 0) {  // else the loop has not shown anything yet
    show_progress(line_, *run_, progress);
  }
}

void RunTerminal::show_plan(const planner::Plan& plan) {
  line_.end();
  horizon_s_ = plan.score.horizon_s;
  say("plans", score_text(*run_, plan.score));
  show_bound(*run_, plan.score);
  show_paths(*run_, plan);
}

void RunTerminal::show_starting(const LoopStatus& status) {
  const bool held = status.stop_held.reason != drivers::DriveFaultReason::kNone;
  if (held && !stop_held_) {
    line_.end();
    say("waiting", drivers::describe(status.stop_held) + "; the robot gets ready when that has ended");
  }
  stop_held_ = held;
  if (line_.live() && line_.due(0, 1)) {
    line_.draw("drives", format("the drives start up (%.1f s)", seconds(status.at.time_since_epoch())));
  }
}

void RunTerminal::show_search(const LoopStatus& status) {
  constexpr int kParts = 1000;
  const double share = std::min(1.0, seconds(status.search_time) / std::max(1.0, horizon_s_));
  if (line_.due(static_cast<int>(kParts * share), kParts)) {
    line_.draw("searching", format("%6.1f s", seconds(status.search_time)) + positions(*run_, status) +
                                bus_text(status) + lateness_text(status));
  }
}

void RunTerminal::show_fault(const LoopStatus& status) const {
  say("fault", status.drive_fault.reason != drivers::DriveFaultReason::kNone
                   ? drivers::describe(status.drive_fault)
                   : "the drives lost power or did not come to rest");
}

void RunTerminal::show_result(const RunOutcome& outcome, const LoopStatus& status, const planner::Plan* plan,
                              std::uint64_t lapses) {
  line_.end();
  static constexpr std::array<const char*, 5> kLabels = {"found", "ended", "stopped", "fault", "no consent"};
  say(kLabels[static_cast<std::size_t>(outcome.end)], outcome.reason);
  if (status.search_started && plan != nullptr) {
    const double search_s = seconds(status.search_time);
    say("time", format("searched %.1f s; expected %.1f s", search_s, plan->score.expected_time_s));
    if (run_->object.place()) {
      say("object", "lay at " + place_text(*run_->object.place()));
    }
    const auto& agents = run_->inputs.file.mission.agents;
    for (std::size_t m = 0; m < agents.size(); ++m) {
      say("", agents[m].name + format(": %.1f of %.1f m, %.2f m/s on average", status.tracks[m].moved_m,
                                      plan->paths[m].length_m, mean_speed_mps(status.tracks[m])));
    }
  }
  const LoopCounters& counters = status.counters;
  std::string loop = format(
      "%llu cycles, %llu frames sent, %llu received", static_cast<unsigned long long>(counters.cycles),
      static_cast<unsigned long long>(counters.bus.sent), static_cast<unsigned long long>(counters.bus.received));
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) {
      loop += format(", %llu %s", static_cast<unsigned long long>(count), what);
    }
  };
  add(counters.bus.send_dropped, "not sent");
  add(counters.bus.receive_dropped, "lost");
  add(counters.malformed_frames, "malformed");
  add(counters.refused_commands, "commands refused");
  add(counters.refused_frames, "frames refused");
  add(counters.skipped, "periods skipped");
  add(lapses, "times the host was late");
  say("loop", loop);
}

void RunTerminal::show_file(const std::string& path) const { say("wrote", path); }

bool ConsentQuestion::possible() { return isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0; }

void ConsentQuestion::ask(const char* label, const char* question) {
  asked_ = true;
  if (!possible()) {
    return;
  }
  (void)tcflush(STDIN_FILENO, TCIFLUSH);  // what was typed before the question was shown is no answer to it
  open_ = true;
  (void)std::printf("%s", labelled(label, question).c_str());
  (void)std::fflush(stdout);
}

void ConsentQuestion::close() {
  if (open_) {
    open_ = false;
    (void)std::printf("\n");
  }
}

Answer ConsentQuestion::poll(int wait_ms) {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (::poll(&input, possible() ? 1 : 0, wait_ms) <= 0) {
    return Answer::kNone;
  }
  std::array<char, 64> text{};
  const ssize_t size = ::read(STDIN_FILENO, text.data(), text.size());
  open_ = size <= 0;  // a typed line ends the question's
  const std::string_view line(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return line == "y\n" || line == "Y\n" || line == "yes\n" ? Answer::kYes : Answer::kNo;
}

}  // namespace ivo::firmware
