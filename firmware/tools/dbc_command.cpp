#include "firmware/tools/dbc_command.hpp"

#include <cstdio>

#include "firmware/files/dbc_file.hpp"
#include "firmware/files/robot_file.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {

int dbc(const DbcOptions& options) {
  const Result<Robot> robot = read_robot(options.robot);
  if (!robot) {
    return refuse(robot.error());
  }
  const std::string text = dbc_text(robot.value());
  if (options.out.empty()) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
      complain({"standard output: cannot be written"});
      return exit_status::kFaultOrStop;
    }
    return exit_status::kEnded;
  }
  if (const Result<void> written = write_file(options.out, text); !written) {
    return refuse(written.error());
  }
  say("wrote", options.out);
  return exit_status::kEnded;
}

}  // namespace ivo::firmware
