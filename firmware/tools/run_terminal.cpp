#include "firmware/tools/run_terminal.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <variant>

namespace ivo::firmware {
namespace {

constexpr int kLabelWidth = 10;

template <class... Args>
std::string format(const char* form, Args... args) {
  std::array<char, 512> text{};
  (void)std::snprintf(text.data(), text.size(), form, args...);
  return text.data();
}

void say(const char* label, const std::string& text) {
  (void)std::printf("%-*s  %s\n", kLabelWidth, label, text.c_str());
  (void)std::fflush(stdout);
}

std::string place(Point p) { return format("(%.1f, %.1f)", p.x_m, p.y_m); }

std::string bar(int part, int whole) {
  constexpr int kWidth = 24;
  const int filled = whole > 0 ? kWidth * part / whole : 0;
  return "[" + std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kWidth - filled), '.') + "]";
}

std::string prior_text(const MissionInputs& inputs) {
  if (inputs.prior_image) {
    const double pixel_m = std::get<ImagePrior>(inputs.file.mission.prior).resolution_m;
    const double width_m = inputs.prior_image->width_px * pixel_m;
    const double height_m = inputs.prior_image->height_px * pixel_m;
    const planner::SegmentedMap map = inputs.map.view();
    const bool smaller = width_m < map.width_m() || height_m < map.height_m();
    return format("image of %.1f x %.1f m", width_m, height_m) + (smaller ? ": nothing beyond it" : "");
  }
  if (inputs.gaussians.empty()) {
    return "uniform";
  }
  return inputs.gaussians.size() == 1 ? "a Gaussian"
                                      : format("%d Gaussians", static_cast<int>(inputs.gaussians.size()));
}

// A line that is longer than the terminal cannot be drawn over itself.
std::string cut_to_terminal(const std::string& line) {
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? line.substr(0, size.ws_col - 1U) : line;
}

std::string positions(const RunView& run, const LoopStatus& status) {
  std::string text;
  const auto& agents = run.inputs.file.mission.agents;
  for (std::size_t m = 0; m < agents.size(); ++m) {
    text += "  " + agents[m].name + " " + place(status.tracks[m].position);
  }
  return text;
}

}  // namespace

RunTerminal::RunTerminal(const RunView& run) : run_(run), live_(isatty(STDOUT_FILENO) != 0) {}

void RunTerminal::show_mission(const std::string& bus) const {
  const Mission& mission = run_.inputs.file.mission;
  const planner::SegmentedMap map = run_.inputs.map.view();
  say("mission", mission.name + format(", seed %llu", static_cast<unsigned long long>(mission.seed)));
  say("map", run_.inputs.map.path + format(", %.1f x %.1f m", map.width_m(), map.height_m()));
  for (const AgentSpec& agent : mission.agents) {
    say(agent.kind == AgentKind::kRobot ? "robot" : "person",
        agent.name + " from " + place(agent.start) +
            format(", %.2f m/s, sees %.1f m", agent.speed_mps, agent.sight_radius_m) +
            (agent.preferred.empty() ? std::string()
                                     : format(", %d preferred %s", static_cast<int>(agent.preferred.size()),
                                              agent.preferred.size() == 1 ? "area" : "areas")));
  }
  say("prior", prior_text(run_.inputs));
  say("graph",
      format("%d nodes %.2f m apart, %d edges, %d cells of %.2f m, %.1f %% of the prior out of everybody's sight",
             run_.planner.graph().nodes(), mission.planner.spacing_m, run_.planner.graph().edges(),
             run_.planner.cells().count(), mission.planner.cell_m, 100 * run_.planner.belief().unobservable_share));
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    if (run_.planner.graph().nodes_reached_by(static_cast<int>(m)) == 1) {
      say("note", mission.agents[m].name + " can go nowhere from its start and searches what it sees from there");
    }
    if (planner::in(run_.planner.left_without_sub_prior(), static_cast<int>(m))) {
      say("note", mission.agents[m].name + " has no probability of its own left and searches the whole prior");
    }
  }
  say("bus", bus);
}

// A person reads no faster, and a search at full speed would spend its time drawing.
bool RunTerminal::time_to_draw() {
  const auto now = std::chrono::steady_clock::now();
  if (now - drawn_ < std::chrono::milliseconds(50)) {
    return false;
  }
  drawn_ = now;
  return true;
}

void RunTerminal::overwrite(const std::string& line) {
  if (!time_to_draw()) {
    return;
  }
  (void)std::printf("\r\033[K%s", cut_to_terminal(line).c_str());
  (void)std::fflush(stdout);
  line_open_ = true;
}

void RunTerminal::end_line() {
  if (line_open_) {
    (void)std::printf("\n");
    line_open_ = false;
  }
}

void RunTerminal::show_planning(const planner::Progress& progress) {
  if (progress.generations == 0) {
    return;  // the loop has not shown anything yet
  }
  const std::string text = format("%d of %d generations", progress.generation, progress.generations) +
                           (progress.has_plan ? ", " + score_text(run_, progress.best) : std::string());
  if (live_) {
    overwrite(format("%-*s  ", kLabelWidth, "planning") + bar(progress.generation, progress.generations) + " " + text);
    return;
  }
  const int tenth = 10 * progress.generation / std::max(1, progress.generations);
  if (tenth > tenth_shown_) {
    tenth_shown_ = tenth;
    say("planning", text);
  }
}

void RunTerminal::show_plan(const planner::Plan& plan) {
  end_line();
  tenth_shown_ = -1;
  horizon_s_ = plan.score.horizon_s;
  say("plans", score_text(run_, plan.score));
  const auto& agents = run_.inputs.file.mission.agents;
  for (std::size_t m = 0; m < agents.size(); ++m) {
    say("", agents[m].name +
                format(": %.1f m, %.0f s, %d waypoints, ends at ", plan.paths[m].length_m, plan.paths[m].duration_s,
                       static_cast<int>(plan.paths[m].waypoints.size())) +
                place(plan.paths[m].waypoints.back()));
  }
  if (!plan.score.complete) {
    say("note", format("the plans leave %.1f %% of the probability unsearched; a smaller spacing_m leaves less",
                       100 * plan.score.unseen_mass));
  }
}

void RunTerminal::show_starting(const LoopStatus& status) {
  if (live_) {
    overwrite(
        format("%-*s  the drives start up (%.1f s)", kLabelWidth, "drives", seconds(status.at.time_since_epoch())));
  }
}

void RunTerminal::show_search(const LoopStatus& status) {
  const std::string text = format("%6.1f s", seconds(status.search_time)) + positions(run_, status);
  if (live_) {
    overwrite(format("%-*s  ", kLabelWidth, "searching") + text);
    return;
  }
  const int step = static_cast<int>(10.0 * seconds(status.search_time) / std::max(1.0, horizon_s_));
  if (step > tenth_shown_) {
    tenth_shown_ = step;
    say("searching", text);
  }
}

void RunTerminal::show_result(const RunOutcome& outcome, const LoopStatus& status, const planner::Plan* plan,
                              std::uint64_t lapses) {
  end_line();
  static constexpr std::array<const char*, 5> kLabels = {"found", "ended", "stopped", "fault", "no consent"};
  say(kLabels[static_cast<std::size_t>(outcome.end)], outcome.reason);
  if (status.search_started && plan != nullptr) {
    const double search_s = seconds(status.search_time);
    say("time", format("searched %.1f s; expected %.1f s", search_s, plan->score.expected_time_s));
    if (run_.object.place()) {
      say("object", "lay at " + place(*run_.object.place()));
    }
    const auto& agents = run_.inputs.file.mission.agents;
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

void ConsentQuestion::ask() {
  asked_ = true;
  (void)tcflush(STDIN_FILENO, TCIFLUSH);  // what was typed before the plans were shown is no consent to them
  open_ = true;
  (void)std::printf("%-*s  Start the search? The robot will move; Ctrl-C stops it. [y/N] ", kLabelWidth, "consent");
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
  if (::poll(&input, 1, wait_ms) <= 0) {
    return Answer::kNone;
  }
  std::array<char, 64> text{};
  const ssize_t size = ::read(STDIN_FILENO, text.data(), text.size());
  open_ = size <= 0;  // a typed line ends the question's
  const std::string_view line(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return line == "y\n" || line == "Y\n" || line == "yes\n" ? Answer::kYes : Answer::kNo;
}

}  // namespace ivo::firmware
