// drive-contract --can IFACE --node N [--master N] [--speed UNITS] [--move]: whether a drive on a CAN interface,
// simulated or real, does what the product relies on. One line a check; exit status 0 when none is broken, 1 when one
// is, 2 for wrong input.
#include <charconv>
#include <iostream>
#include <span>
#include <string_view>

#include "hal/linux/monotonic_clock.hpp"
#include "hal/linux/socketcan_bus.hpp"
#include "tests/contract/drive_contract.hpp"

namespace {

struct Options {
  std::string interface;
  int node_id = 0;
  int master_node_id = 127;
  int speed = 650;
  bool move = false;
};

bool take_number(std::string_view text, int least, int most, int& into) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), into);
  return error == std::errc() && end == text.data() + text.size() && into >= least && into <= most;
}

/// What is wrong with the arguments; empty when nothing is.
std::string parse(std::span<const char* const> arguments, Options& options) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view name = arguments[i];
    if (name == "--move") {
      options.move = true;
      continue;
    }
    const std::string_view value = i + 1 < arguments.size() ? arguments[++i] : "";
    bool taken = false;
    if (name == "--can") {
      options.interface = value;
      taken = !value.empty();
    } else if (name == "--node") {
      taken = take_number(value, 1, 127, options.node_id);
    } else if (name == "--master") {
      taken = take_number(value, 1, 127, options.master_node_id);
    } else if (name == "--speed") {
      taken = take_number(value, -1'000'000, 1'000'000, options.speed) && options.speed != 0;
    }
    if (!taken) {
      return "\"" + std::string(name) + " " + std::string(value) +
             "\"; expected --can IFACE --node 1..127 [--master 1..127] [--speed UNITS] [--move]";
    }
  }
  if (options.interface.empty() || options.node_id == 0) {
    return "expected --can IFACE and --node N";
  }
  return options.node_id == options.master_node_id ? "--node is the master's; expected another" : "";
}

int run(ivo::hal::SocketCanBus& bus, const Options& options) {
  using namespace ivo;
  hal::MonotonicClock clock;
  contract::DriveBench bench({.bus = bus,
                              .node_id = static_cast<std::uint8_t>(options.node_id),
                              .master_node_id = static_cast<std::uint8_t>(options.master_node_id),
                              .speed = options.speed,
                              .now = [&clock] { return clock.now(); },
                              .pass = [&bus](Duration time) { (void)bus.wait_readable(time); }});
  int broken = 0;
  for (const contract::Check& check : contract::drive_contract()) {
    if (check.turns && !options.move) {
      std::cout << "left out  " << check.name << ": it turns the wheel; expected --move" << std::endl;
      continue;
    }
    try {
      bench.reset();
      check.run(bench);
      std::cout << "kept      " << check.name << std::endl;
    } catch (const contract::NotThere& missing) {
      std::cout << "not there " << check.name << ": " << missing.what() << std::endl;
    } catch (const contract::Broken& reason) {
      std::cout << "BROKEN    " << check.name << ": " << reason.what() << std::endl;
      ++broken;
    }
  }
  try {
    bench.reset();
  } catch (const contract::Broken& reason) {
    std::cout << "BROKEN    the last reset: " << reason.what() << std::endl;
    ++broken;
  }
  return broken == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  Options options;
  const std::string wrong =
      parse(std::span<const char* const>(arguments, static_cast<std::size_t>(count)).subspan(1), options);
  if (!wrong.empty()) {
    std::cerr << "drive-contract: " << wrong << '\n';
    return 2;
  }
  // A check may send several frames of one COB-ID at once; each of them counts.
  auto bus = ivo::hal::SocketCanBus::open(options.interface, {.confirm = false});
  if (!bus) {
    std::cerr << "drive-contract: " << bus.error().message << '\n';
    return 2;
  }
  return run(bus.value(), options);
}
