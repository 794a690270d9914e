#include "firmware/tools/load_command.hpp"

#include <array>
#include <chrono>
#include <cmath>

#include "config/rates.hpp"
#include "drivers/canopen/bus_load.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/frame_bits.hpp"
#include "drivers/canopen/response_time.hpp"
#include "firmware/files/candump_file.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/robot_file.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

using drivers::FrameKind;

constexpr std::array<const char*, drivers::kFrameKinds> kFrameKindNames = {"NMT",  "SYNC", "EMCY",      "TPDO",
                                                                           "RPDO", "SDO",  "heartbeat", "other"};
constexpr Duration kSdoEvery = std::chrono::milliseconds(10);

const char* name_of(std::uint16_t id) { return kFrameKindNames[static_cast<std::size_t>(drivers::kind_of(id))]; }
double ms(Duration time) { return 1e3 * seconds(time); }

void show_frames(const Robot& robot) {
  say("frame", "COB-ID  bytes   every         bits   there at worst after");
  for (const drivers::ResponseTime& time :
       drivers::response_times(drivers::schedule_of(robot), robot.bit_rate_bps).span()) {
    const drivers::PeriodicFrame& frame = time.frame;
    const std::string response = time.worst ? format("%.3f ms", ms(*time.worst)) : "never: the bus is too full";
    say(name_of(frame.id),
        format("  %03X     %d  %5g ms   %3d to %3d   ", unsigned{frame.id}, int{frame.bytes}, ms(frame.period),
               drivers::unstuffed_bits(frame.bytes), drivers::longest_bits(frame.bytes)) +
            response);
  }
}

void show_computed(const Robot& robot) {
  say("robot", robot.name + format(": %g kbit/s, %s, a cycle of %g ms", robot.bit_rate_bps / 1e3,
                                   robot.pdo_layout == PdoLayout::kOwn ? "an RPDO a drive" : "two drives to an RPDO",
                                   ms(robot.cycle)));
  show_frames(robot);
  const drivers::BusLoad load = drivers::load_of(drivers::schedule_of(robot).span(), robot.bit_rate_bps);
  say("load", format("%.1f %% without stuff bits, %.1f %% at worst", 100 * load.unstuffed, 100 * load.worst));
  const double sdo =
      drivers::load_of(drivers::sdo_transfer_every(kSdoEvery, robot.drives[0].node_id), robot.bit_rate_bps).worst;
  say("", format("an SDO transfer every %g ms would be %.1f %% more at worst; none is made while the robot drives",
                 ms(kSdoEvery), 100 * sdo));
}

Result<void> show_measured(const Robot& robot, const std::string& path) {
  drivers::LoadMeter meter(robot.bit_rate_bps);
  const Result<CandumpContents> read =
      read_candump(path, [&](Instant at, const hal::CanFrame& frame) { meter.add(at, frame); });
  if (!read) {
    return read.error();
  }
  const CandumpContents& contents = read.value();
  if (contents.frames == 0) {
    return Error{path + ": holds no frame; expected a record as ivo run --record writes it"};
  }
  const drivers::LoadMeter::Figures figures = meter.figures();
  say("record", format("%llu frames of %s in %.3f s", static_cast<unsigned long long>(contents.frames),
                       contents.interface.c_str(), seconds(figures.time)));
  say("load", format("%.1f %% on average, %.1f %% in the worst 10 ms, %.1f %% in the worst 100 ms", 100 * figures.mean,
                     100 * figures.worst_10ms, 100 * figures.worst_100ms));
  for (std::size_t kind = 0; kind < drivers::kFrameKinds; ++kind) {
    const drivers::LoadMeter::Share& share = figures.kinds[kind];
    if (share.frames > 0) {
      say("", format("%-9s  %9llu frames  %6.2f %%", kFrameKindNames[kind],
                     static_cast<unsigned long long>(share.frames), 100 * share.load));
    }
  }
  if (contents.others > 0) {
    say("", format("not counted: %llu with 29 bits, remote, of an error or of CAN FD",
                   static_cast<unsigned long long>(contents.others)));
  }
  if (contents.elsewhere > 0) {
    say("", format("not counted: %llu of other interfaces", static_cast<unsigned long long>(contents.elsewhere)));
  }
  return {};
}

}  // namespace

int load(const LoadOptions& options) {
  const Result<Robot> robot = read_robot(options.robot);
  if (!robot) {
    return refuse(robot.error());
  }
  show_computed(robot.value());
  if (!options.log.empty()) {
    if (const Result<void> shown = show_measured(robot.value(), options.log); !shown) {
      return refuse(shown.error());
    }
  }
  return exit_status::kEnded;
}

}  // namespace ivo::firmware
