// What `ivo run` was asked on the command line.
#pragma once

#include <string>

namespace ivo::firmware {

struct RunOptions {
  std::string mission;
  std::string out;            ///< folder; empty: out/<mission's file name>
  bool yes = false;           ///< consent is given beforehand
  bool resume = false;        ///< a search that was cut off in `out` is taken up
  bool max_speed = false;     ///< manual clock, as fast as it goes
  double speed = 1.0;         ///< times real time
  std::string can;            ///< interface; empty: drives simulated in this process
  bool lock_step = false;     ///< time moves when the drives have answered
  std::string script;         ///< what the simulated drives are to do wrong, of the virtual bus; empty: nothing
  std::string record;         ///< file for every frame sent or received; empty: none
  std::string stats;          ///< file for what the cycles cost; empty: none
  std::string watchdog;       ///< the machine's, as /dev/watchdog; empty: it is not ours to feed
  std::string trace;          ///< file for what each cycle did and how long it took, for Perfetto; empty: none
  std::string log;            ///< file for poses, commands, plans, belief and timing, for Foxglove; empty: none
  bool trace_marker = false;  ///< lines in the kernel's own trace too
  std::string console;        ///< path of the socket that the console is served at; empty: none
  bool no_real_time = false;  ///< the degraded mode: no real-time thread, no locked memory
};

/// The whole of `ivo run`. Returns the exit status: 0 ended as planned, 1 fault or stop, 2 wrong input, 3 no consent.
[[nodiscard]] int run(const RunOptions& options);

}  // namespace ivo::firmware
