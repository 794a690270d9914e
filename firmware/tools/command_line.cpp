#include "firmware/tools/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>

#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/run_options.hpp"

namespace ivo::firmware {
namespace {

// "max" or a factor of real time.
std::string read_speed(const std::string& text, RunOptions& options) {
  if (text == "max") {
    options.max_speed = true;
    return {};
  }
  char* end = nullptr;
  options.speed = std::strtod(text.c_str(), &end);
  const bool whole = end != text.c_str() && *end == '\0';
  return whole && options.speed >= 0.01 && options.speed <= 1000.0
             ? std::string()
             : "\"" + text + "\"; expected max, or 0.01 to 1000 (times real time)";
}

// An unset variable of a shell is not the default.
std::string not_empty(const std::string& value) { return value.empty() ? "is empty; expected a name" : std::string(); }

}  // namespace

int command_line(int argc, const char* const* argv) {
  CLI::App app("IVO search controller: a robot and a person find something together", "ivo");
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("ivo: ") + error.what() + "; ivo --help shows what there is\n";
  });

  RunOptions run_options;
  std::string clock = "real";
  CLI::App* run_command = app.add_subcommand("run", "Plan a mission, ask for consent, search");
  run_command->add_option("MISSION", run_options.mission, "Mission file, as config/missions/courtyard.toml")
      ->required();
  run_command->add_flag("--yes", run_options.yes,
                        "Consent to the plans beforehand: the robot moves without a question");
  run_command->add_option_function<std::string>(
      "--speed",
      [&](const std::string& text) {
        if (const std::string fault = read_speed(text, run_options); !fault.empty()) {
          throw CLI::ValidationError("--speed", fault);
        }
      },
      "Times real time, or max for a manual clock (virtual bus only; default 1)");
  run_command->add_option("--out", run_options.out, "Folder for plan, report, events and picture (default out/MISSION)")
      ->check(not_empty);
  run_command
      ->add_option("--can", run_options.can,
                   "CAN interface, as can0 or vcan0 (default: drives simulated in this process)")
      ->check(not_empty);
  run_command->add_option("--clock", clock, "real, or sync: time moves when the drives have answered (with --can)")
      ->check(CLI::IsMember({"real", "sync"}));

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_status::kWrongInput;
  }
  run_options.lock_step = clock == "sync";
  return run(run_options);
}

}  // namespace ivo::firmware
