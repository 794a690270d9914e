#include "firmware/tools/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "firmware/files/number_text.hpp"
#include "firmware/tools/bench/bench_command.hpp"
#include "firmware/tools/colonies.hpp"
#include "firmware/tools/console/console_command.hpp"
#include "firmware/tools/dbc_command.hpp"
#include "firmware/tools/doctor/doctor_options.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/load_command.hpp"
#include "firmware/tools/plan_options.hpp"
#include "firmware/tools/profile/profile_options.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/wheels_options.hpp"

namespace ivo::firmware {
namespace {

// "max" or a factor of real time.
std::string read_speed(const std::string& text, RunOptions& options) {
  if (text == "max") {
    options.max_speed = true;
    return {};
  }
  options.max_speed = false;
  char* end = nullptr;
  options.speed = std::strtod(text.c_str(), &end);
  const bool whole = end != text.c_str() && *end == '\0';
  return whole && options.speed >= 0.01 && options.speed <= 1000.0
             ? std::string()
             : "\"" + text + "\"; expected max, or 0.01 to 1000 (times real time)";
}

// An unset variable of a shell is not the default.
std::string not_empty(const std::string& value) { return value.empty() ? "is empty; expected a name" : std::string(); }

template <class Choice>
void add_choice(CLI::App& command, const std::string& name, std::optional<Choice>& choice,
                const std::array<const char*, 2>& words, const std::string& what) {
  const std::string expected = std::string(words[0]) + " or " + words[1];
  command.add_option_function<std::string>(
      name,
      [&choice, &words, name, expected](const std::string& word) {
        const auto* const found = std::find(words.begin(), words.end(), word);
        if (found == words.end()) {
          throw CLI::ValidationError(name, "\"" + word + "\"; expected " + expected);
        }
        choice = static_cast<Choice>(found - words.begin());
      },
      expected + ": " + what);
}

std::string number_text(double value) { return shortest(value); }
std::string number_text(int value) { return std::to_string(value); }
std::string number_text(std::uint64_t value) { return std::to_string(value); }
template <class Number>
const char* kind_of(Number /*of*/) {
  return std::is_integral_v<Number> ? "a whole number" : "a number";
}

/// A number of the option's type between two ends.
template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& name, std::optional<Number>& number, Number least,
                        Number most, const std::string& what) {
  return command.add_option_function<std::string>(
      name,
      [&number, name, least, most](const std::string& text) {
        Number value{};
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (status != std::errc() || end != text.data() + text.size() || !(value >= least && value <= most)) {
          throw CLI::ValidationError(name, "\"" + text + "\"; expected " + kind_of(least) + ", " + number_text(least) +
                                               " to " + number_text(most));
        }
        number = value;
      },
      what);
}

/// The library counts arguments of a type; people give an option its value, once.
std::string plain(const CLI::Error& error) {
  const std::string text = error.what();
  const std::string option = text.substr(0, text.find(':'));
  if (text.find(" required TEXT missing") != std::string::npos) {
    return option + ": has no value; expected one";
  }
  return text.find("At Most 1 required") != std::string::npos ? option + ": is given twice; expected once" : text;
}

/// What is wrong with the word that names a command of `app`, or asks for help; empty when nothing is.
std::string command_fault(const CLI::App& app, int argc, const char* const* argv, int place = 1) {
  const std::string word = argc > place ? argv[place] : "";
  std::string names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* /*any*/) { return true; })) {
    if (command->get_name() == word) {
      return place == 1 && (word == "wheels" || word == "console") ? command_fault(*command, argc, argv, place + 1)
                                                                   : std::string();
    }
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  if (word == "-h" || word == "--help") {
    return {};
  }
  const std::string of = place == 1 ? "" : " of " + app.get_name();
  if (place > 1 && word.starts_with('-')) {
    return "\"" + word + "\" stands before the command" + of + "; expected it behind one of " + names;
  }
  return (argc > place ? "no command" + of + " is called \"" + word + "\"" : "no command" + of) + "; expected " + names;
}

void add_tracing(CLI::App& command, RunOptions& options) {
  command.add_option("--trace", options.trace, "File for every cycle, its phases and frames, for Perfetto")
      ->check(not_empty);
  command.add_option("--log", options.log, "File for poses, commands, plans, belief and timing, MCAP, for Foxglove")
      ->check(not_empty);
  command.add_flag("--trace-marker", options.trace_marker, "Phases as lines in the kernel's own trace too (root)");
}

void add_speed(CLI::App& command, RunOptions& options, const char* what) {
  command.add_option_function<std::string>(
      "--speed",
      [&options](const std::string& text) {
        if (const std::string fault = read_speed(text, options); !fault.empty()) {
          throw CLI::ValidationError("--speed", fault);
        }
      },
      what);
}

CLI::App* add_profile(CLI::App& app, ProfileOptions& options) {
  CLI::App* command = app.add_subcommand("profile", "Say where the time of a mission's cycles goes; nothing moves");
  command->add_option("MISSION", options.run.mission, "Mission file, as config/missions/courtyard.toml")
      ->required()
      ->check(not_empty);
  add_speed(*command, options.run, "Times real time: cycles begin with cold caches, as a robot's do; or max (default)");
  command->add_flag("--planning-only", options.planning_only, "End once the plan is ready");
  add_tracing(*command, options.run);
  return command;
}

CLI::App* add_plan(CLI::App& app, PlanOptions& options, std::optional<int>& threads) {
  CLI::App* command = app.add_subcommand("plan", "Plan a mission; nothing moves");
  command->add_option("MISSION", options.mission, "Mission file, as config/missions/courtyard.toml")
      ->required()
      ->check(not_empty);
  add_choice(*command, "--profile", options.profile, kSearchProfileWords, "instead of the mission's");
  add_choice(*command, "--heuristic", options.heuristic, kSearchHeuristicWords, "instead of the mission's");
  add_number(*command, "--time-limit", options.time_limit_s, 0.001, 86400.0,
             "Seconds of search; without --iterations it goes on so long");
  add_number(*command, "--iterations", options.iterations, 1, 1'000'000'000, "Generations, instead of the mission's");
  add_number(*command, "--seed", options.seed, std::uint64_t{0},
             std::uint64_t{std::numeric_limits<std::int64_t>::max()}, "Instead of the mission's");
  add_number(*command, "--threads", threads, 1, Colonies::kMost, "Colonies that search side by side (default 1)");
  command->add_option("--out", options.out, "Folder for plan and picture (default out/MISSION)")->check(not_empty);
  return command;
}

CLI::App* add_score(CLI::App& app, ScoreOptions& options) {
  CLI::App* command = app.add_subcommand("score", "Score a plan of any origin on a mission");
  command->add_option("MISSION", options.mission, "Mission file")->required()->check(not_empty);
  command->add_option("PLAN", options.plan, "Plan, as plan.json: agents and their waypoints")
      ->required()
      ->check(not_empty);
  command->add_option("--json", options.json, "File for the score")->check(not_empty);
  command->add_option("--out", options.out, "Folder for score.json and a picture of the plan, search.png")
      ->check(not_empty);
  return command;
}

CLI::App* add_bench(CLI::App& app, bench::CommandOptions& options) {
  CLI::App* command = app.add_subcommand("bench", "Measure the search core, the wheel bus and the loop");
  command->add_option("NAME", options.name, "Which bench, or all; without a name a list of them")->check(not_empty);
  command->add_option("--json", options.json, "File for the figures")->check(not_empty);
  command->add_flag("--quick", options.bench.quick, "Shortened: for a look, not for figures");
  command->add_option("--data", options.bench.data, "Folder with dubai/ and sarenv/, for compare and scale")
      ->check(CLI::ExistingDirectory);
  return command;
}

// In the order in which add_wheels adds them.
constexpr std::array kWheelsCommands{&wheels::list, &wheels::watch, &wheels::turn, &wheels::check};

CLI::App* add_wheels(CLI::App& app, wheels::Options& options) {
  CLI::App* wheels = app.add_subcommand("wheels", "Look at the wheel drives and try them, wheel by wheel");
  wheels->require_subcommand(1);
  CLI::App* list = wheels->add_subcommand("list", "Who is on the bus; reads, writes nothing");
  CLI::App* watch = wheels->add_subcommand("watch", "What the drives say; sends nothing");
  CLI::App* turn = wheels->add_subcommand("turn", "Turn one wheel slowly while the space bar is held");
  CLI::App* check = wheels->add_subcommand("check", "Check node-ids, signs and units, wheel by wheel");
  for (CLI::App* command : {list, watch, turn, check}) {
    command->add_option("--can", options.can, "CAN interface, as can0 or vcan0")->check(not_empty);
    command->add_option("--robot", options.robot, "Robot file (default: as config/robots/ivo.toml)")->check(not_empty);
    command->add_flag("--sim", options.simulated, "Four simulated drives in this process, instead of --can");
    command->add_option("--sim-robot", options.simulated_robot, "Robot file that the simulated drives are made by")
        ->check(not_empty);
  }
  add_number(*watch, "--seconds", options.seconds, 0.1, 1e9, "How long; without it until Ctrl-C");
  turn->add_option("WHEEL", options.wheel, "front_left, front_right, rear_left or rear_right")->required();
  add_number(*turn, "--radps", options.radps, -2.0, 2.0, "At the wheel, below 0 backward (default 0.5)");
  add_number(*check, "--radps", options.radps, 0.05, 2.0, "At the wheel (default 0.5)");
  add_number(*check, "--turns", options.turns, 0.25, 20.0, "Of each wheel, to count: more is more exact (default 1)");
  return wheels;
}

CLI::App* add_load(CLI::App& app, LoadOptions& options) {
  CLI::App* command = app.add_subcommand("load", "Say how full a robot's bus is, as computed and as recorded");
  command->add_option("ROBOT", options.robot, "Robot file, as config/robots/ivo.toml")->required()->check(not_empty);
  command->add_option("LOG", options.log, "Record of frames, as run --record or candump -L writes it")
      ->check(not_empty);
  return command;
}

CLI::App* add_dbc(CLI::App& app, DbcOptions& options) {
  CLI::App* command = app.add_subcommand("dbc", "Describe a robot's bus as a DBC, for other tools");
  command->add_option("ROBOT", options.robot, "Robot file, as config/robots/ivo.toml")->required()->check(not_empty);
  command->add_option("--out", options.out, "File for it (default standard output)")->check(not_empty);
  return command;
}

CLI::App* add_doctor(CLI::App& app, doctor::Options& options) {
  CLI::App* command = app.add_subcommand("doctor", "Check a robot's PC, and say how to mend what is wrong");
  command->add_option("--robot", options.robot, "Robot file (default: as config/robots/ivo.toml)")->check(not_empty);
  command->add_option("--can", options.can, "CAN interface, as can0: it and its drives are checked too, by reading")
      ->check(not_empty);
  add_number(*command, "--cpu", options.cpu, 0, 8191,
             "The CPU to look at (default: the one that the robot file binds the loop to)");
  add_number(*command, "--priority", options.priority, 1, 99, "Of the loop's thread (default: the robot file's)");
  add_number(*command, "--latency", options.latency_s, 0.0, 86400.0,
             "Seconds of measuring wake-ups (default 5); 0 leaves it out");
  command->add_option("--out", options.out, "Folder where results will go (default out)")->check(not_empty);
  command->add_option("--json", options.json, "File for what was found")->check(not_empty);
  return command;
}

CLI::App* add_console(CLI::App& app, ConsoleOptions& options) {
  CLI::App* console = app.add_subcommand("console", "Ask a controller that runs, or tell it something");
  console->require_subcommand(1);
  const auto add = [&](const char* name, const char* what, ConsoleVerb verb) {
    CLI::App* command = console->add_subcommand(name, what);
    command->add_option("--socket", options.socket, "As given to ivo run --console (default " + options.socket + ")")
        ->check(not_empty);
    command->callback([&options, verb] { options.verb = verb; });
    return command;
  };
  const auto add_agent = [&](CLI::App* command) {
    command->add_option("AGENT", options.agent, "Name of an agent of the mission")->required()->check(not_empty);
    return command;
  };
  const auto add_planning = [&](CLI::App* command) {
    command->add_flag("!--no-wait", options.wait, "Do not wait until the plan is there");
  };
  add("status", "What it does, where everybody is, what it asks, counters", ConsoleVerb::kStatus);
  add("plan", "The plan in figures, beside the one before it", ConsoleVerb::kPlan);
  add("areas", "The areas that are drawn; with a file, draw its areas instead", ConsoleVerb::kAreas)
      ->add_option("FILE", options.areas, "GeoJSON in metres of the map")
      ->check(not_empty);
  add_planning(add("init", "Plan anew without preferred areas; a robot that moves pauses", ConsoleVerb::kInit));
  add_planning(
      add("replan", "Plan anew with the areas that are drawn; a robot that moves pauses", ConsoleVerb::kReplan));
  add("enough", "Take the best plan so far", ConsoleVerb::kEnough);
  add("accept", "The plan is good; nothing moves yet", ConsoleVerb::kAccept);
  add("start", "The plan is accepted: the robot moves", ConsoleVerb::kStart);
  add("consent", "Accept and start in one", ConsoleVerb::kConsent);
  add("refuse", "Disagree: the run ends", ConsoleVerb::kRefuse);
  add_agent(add("found", "The object is found, by AGENT", ConsoleVerb::kFound));
  CLI::App* position = add_agent(add("position", "The person AGENT is at X Y", ConsoleVerb::kPosition));
  constexpr double kFarthest_m = 1e6;
  add_number(*position, "X", options.x_m, 0.0, kFarthest_m, "Metres from the map's left border")->required();
  add_number(*position, "Y", options.y_m, 0.0, kFarthest_m, "Metres from the map's lower border")->required();
  add("pause", "As Stop on the page: the robot ramps down and stands until somebody agrees anew", ConsoleVerb::kPause);
  add("stop", "The robot ramps down, the run ends and cannot go on", ConsoleVerb::kStop);
  add("clear", "After a fault: start the drives up again; nothing moves before consent anew", ConsoleVerb::kClear);
  return console;
}

}  // namespace

int command_line(int argc, const char* const* argv) {
  CLI::App app("IVO search controller: a robot and a person find something together", "ivo");
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "ivo: " + plain(error) + "; ivo --help shows what there is\n";
  });

  RunOptions run_options;
  std::string clock = "real";
  CLI::App* run_command = app.add_subcommand("run", "Plan a mission, ask for consent, search");
  run_command->add_option("MISSION", run_options.mission, "Mission file, as config/missions/courtyard.toml")
      ->required()
      ->check(not_empty);
  run_command->add_flag("--yes", run_options.yes,
                        "Consent to the plans beforehand: the robot moves without a question");
  add_speed(*run_command, run_options, "Times real time, or max for a manual clock (virtual bus only; default 1)");
  run_command->add_option("--out", run_options.out, "Folder for plan, report, events and picture (default out/MISSION)")
      ->check(not_empty);
  run_command->add_flag("--resume", run_options.resume,
                        "Take up the search that was cut off in that folder, after consent; without one begin anew");
  run_command
      ->add_option("--can", run_options.can,
                   "CAN interface, as can0 or vcan0 (default: drives simulated in this process)")
      ->check(not_empty);
  run_command->add_option("--clock", clock, "real, or sync: time moves when the drives have answered (with --can)")
      ->check(CLI::IsMember({"real", "sync"}));
  run_command->add_option("--script", run_options.script, "What simulated drives do wrong and when, as of ivo-drives")
      ->check(not_empty);
  run_command->add_option("--record", run_options.record, "File for every frame sent or received, as candump -L")
      ->check(not_empty);
  add_tracing(*run_command, run_options);
  run_command->add_option("--stats", run_options.stats, "File for what the cycles cost, by phase")->check(not_empty);
  run_command
      ->add_option("--watchdog", run_options.watchdog,
                   "The machine's watchdog, as /dev/watchdog: fed while the loop runs (not beside systemd's own)")
      ->check(not_empty);
  run_command->add_flag("--no-real-time", run_options.no_real_time,
                        "Degraded: without real-time priority and locked memory, also on a real interface");
  run_command
      ->add_option("--console", run_options.console,
                   "Path of a socket through which it can be asked and told, by ivo console")
      ->check(not_empty);

  PlanOptions plan_options;
  std::optional<int> threads;
  CLI::App* const plan_command = add_plan(app, plan_options, threads);
  ScoreOptions score_options;
  CLI::App* const score_command = add_score(app, score_options);
  bench::CommandOptions bench_options;
  CLI::App* const bench_command = add_bench(app, bench_options);
  wheels::Options wheels_options;
  CLI::App* const wheels_command = add_wheels(app, wheels_options);
  LoadOptions load_options;
  CLI::App* const load_command = add_load(app, load_options);
  ProfileOptions profile_options;
  profile_options.run.max_speed = true;
  CLI::App* const profile_command = add_profile(app, profile_options);
  DbcOptions dbc_options;
  CLI::App* const dbc_command = add_dbc(app, dbc_options);
  doctor::Options doctor_options;
  CLI::App* const doctor_command = add_doctor(app, doctor_options);
  ConsoleOptions console_options;
  CLI::App* const console = add_console(app, console_options);

  if (const std::string fault = command_fault(app, argc, argv); !fault.empty()) {
    return refuse({fault});
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_status::kWrongInput;
  }
  if (plan_command->parsed()) {
    plan_options.threads = threads.value_or(1);
    return plan(plan_options);
  }
  if (score_command->parsed()) {
    return score(score_options);
  }
  if (bench_command->parsed()) {
    return bench::run(bench_options);
  }
  if (wheels_command->parsed()) {
    const auto commands = wheels_command->get_subcommands([](const CLI::App* /*any*/) { return true; });
    const auto asked = std::ranges::find_if(commands, [](const CLI::App* command) { return command->parsed(); });
    return kWheelsCommands[static_cast<std::size_t>(asked - commands.begin())](wheels_options);
  }
  if (profile_command->parsed()) {
    return profile(profile_options);
  }
  if (load_command->parsed()) {
    return load(load_options);
  }
  if (dbc_command->parsed()) {
    return dbc(dbc_options);
  }
  if (doctor_command->parsed()) {
    return doctor::examine(doctor_options);
  }
  if (console->parsed()) {
    return console_command(console_options);
  }
  run_options.lock_step = clock == "sync";
  return run(run_options);
}

}  // namespace ivo::firmware
