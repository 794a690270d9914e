// peer_master INTERFACE NODE: the product's drivers as master of one CANopen node that somebody else wrote. Reads it by
// SDO, starts it up as a wheel drive, moves it through NMT's states; says what it found and sent, a line each, for a
// test to compare with what the node says. Every wait is for an event; one that does not come ends the program with
// status 1.
#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/canopen/heartbeat.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/canopen/sdo_client.hpp"
#include "drivers/canopen/sync.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/drive_fault_text.hpp"
#include "drivers/wheel_drive.hpp"
#include "hal/linux/monotonic_clock.hpp"
#include "hal/linux/socketcan_bus.hpp"

namespace {

using namespace ivo;
using namespace std::chrono_literals;

constexpr Duration kPatience = 60s;
constexpr int kCommands = 100;

class PeerMaster {
 public:
  PeerMaster(hal::SocketCanBus& bus, std::uint8_t node_id) : bus_(bus), robot_(robot_with(node_id)), sdo_(node_id) {}

  void run() {
    std::cout << "listening" << std::endl;
    wait_for_state(drivers::NmtState::kBootUp, "boot-up message");
    read_by_sdo();
    start_up();
    command();
    change_states();
  }

 private:
  static Robot robot_with(std::uint8_t node_id) {
    Robot robot;
    robot.drives.front().node_id = node_id;
    return robot;
  }
  [[nodiscard]] std::uint8_t node_id() const { return robot_.drives.front().node_id; }

  /// One cycle: what arrived is looked at, what is due goes out.
  void turn() {
    (void)bus_.wait_readable(5ms);
    now_ = clock_.now();
    const std::size_t count = bus_.receive(received_, now_);
    for (const hal::ReceivedFrame& received : std::span(received_).first(count)) {
      take(received);
    }
    hal::CanFrame heartbeat = drivers::heartbeat_frame(robot_.master_node_id, drivers::NmtState::kOperational);
    if (heartbeat_.due(now_)) {
      (void)bus_.send({&heartbeat, 1}, now_);
    }
  }

  void take(const hal::ReceivedFrame& received) {
    const hal::CanFrame& frame = received.frame;
    if (drivers::cob_id::node_of(frame.id) == node_id()) {
      drive_.on_frame(received);
    }
    sdo_.on_frame(frame);
    if (frame.id == drivers::cob_id::heartbeat(node_id())) {
      heard_ = drivers::parse_heartbeat(frame);
    } else if (frame.id == drivers::cob_id::tpdo1(node_id())) {
      status_ = drivers::parse_status(frame);
    }
  }

  template <class Condition>
  void wait_for(const Condition& condition, std::string_view what) {
    const Instant begin = clock_.now();
    while (!condition()) {
      if (clock_.now() - begin > kPatience) {
        std::cerr << "peer_master: waited in vain for " << what << '\n';
        std::exit(1);
      }
      turn();
    }
  }

  void wait_for_state(drivers::NmtState state, const char* what) {
    wait_for([&] { return heard_ == state; }, what);
    std::cout << "heard " << what << '\n';
  }

  void send(const hal::CanFrame& frame) {
    if (bus_.send({&frame, 1}, now_) != 1) {
      std::cerr << "peer_master: the bus takes no frame\n";
      std::exit(1);
    }
  }

  void transfer() {
    wait_for(
        [this] {
          if (const auto frame = sdo_.poll(clock_.now())) {
            send(*frame);
          }
          return sdo_.status() != drivers::SdoStatus::kBusy;
        },
        "an SDO answer");
  }

  void read(drivers::ObjectAddress object, std::uint8_t bytes) {
    sdo_.start_upload(object, bytes);
    transfer();
    say_object(object);
    std::cout << (sdo_.status() == drivers::SdoStatus::kDone ? sdo_.value() : abort_code()) << std::dec << '\n';
  }

  void read_text(drivers::ObjectAddress object) {
    sdo_.start_upload(object);
    transfer();
    say_object(object);
    std::cout << sdo_.text() << '\n';
  }

  void write(drivers::ObjectAddress object, std::string_view text) {
    std::array<std::uint8_t, drivers::SdoClient::kMostBytes> bytes{};
    std::copy(text.begin(), text.end(), bytes.begin());
    sdo_.start_download(object, std::span(bytes).first(text.size()));
    transfer();
    std::cout << "write ";
    say_object(object);
    std::cout << (sdo_.status() == drivers::SdoStatus::kDone ? 0U : abort_code()) << std::dec << '\n';
  }

  void say_object(drivers::ObjectAddress object) {
    std::cout << "object " << std::hex << object.index << ':' << int{object.sub} << ' '
              << (sdo_.status() == drivers::SdoStatus::kDone ? "" : "aborted ");
  }
  [[nodiscard]] std::uint32_t abort_code() const { return static_cast<std::uint32_t>(sdo_.abort_code()); }

  void read_by_sdo() {
    read({0x1000, 0}, 4);
    read({0x1001, 0}, 1);
    for (std::uint8_t sub = 0; sub <= 4; ++sub) {
      read({0x1018, sub}, sub == 0 ? 1 : 4);
    }
    read_text({0x1008, 0});
    read({0x2FFF, 0}, 4);                         // not there
    read({0x1018, 9}, 4);                         // no such sub-index
    write({0x1008, 0}, "a name that is longer");  // in segments, to what is constant
    write({0x1017, 0}, std::string_view("\xE8\x03", 2));
    read({0x1017, 0}, 2);
  }

  /// As the control loop does with all four.
  void start_up() {
    drive_.open();
    const auto begin = [this] {
      drive_.update(now_);
      if (const auto frame = drive_.next_frame(now_)) {
        send(*frame);
      }
      if (drive_.phase() == drivers::WheelDrive::Phase::kFailed) {
        std::cerr << "peer_master: " << drivers::describe(drive_.fault()) << '\n';
        std::exit(1);
      }
    };
    wait_for([&] { return begin(), drive_.phase() == drivers::WheelDrive::Phase::kConfigured; }, "configuration");
    drive_.start();
    wait_for([&] { return begin(), drive_.phase() == drivers::WheelDrive::Phase::kOperational; }, "Operational");
    std::cout << "configured and operational\n";
    const drivers::PdoChannels& channels = drive_.channels();
    std::cout << std::hex << "channels " << channels.command_id << ' ' << channels.feedback_id << std::dec << '\n';
  }

  /// SYNC and a command, each after the answer to the one before.
  void command() {
    for (int n = 0; n < kCommands; ++n) {
      const std::uint16_t word =
          n % 2 == 0 ? drivers::cia402::controlword::kDisableVoltage : drivers::cia402::controlword::kShutdown;
      const drivers::DriveCommand command{word, (n - kCommands / 2) * 1'000'003};
      status_.reset();
      send(drivers::command_frame(drive_.channels().command_id, command));
      send(drivers::sync_frame());
      wait_for([this] { return status_.has_value(); }, "a TPDO");
      std::cout << "sent " << command.controlword << ' ' << command.target_velocity << " got " << status_->statusword
                << ' ' << status_->position << '\n';
    }
  }

  void change_states() {
    using drivers::NmtCommand;
    using drivers::NmtState;
    const auto order = [this](NmtCommand command) { send(drivers::nmt_frame({command, node_id()})); };
    order(NmtCommand::kStop);
    wait_for_state(NmtState::kStopped, "heartbeat Stopped");
    order(NmtCommand::kEnterPreOperational);
    wait_for_state(NmtState::kPreOperational, "heartbeat Pre-operational");
    order(NmtCommand::kResetNode);
    wait_for_state(NmtState::kBootUp, "boot-up message");
    std::cout << "end\n";
  }

  hal::SocketCanBus& bus_;
  hal::MonotonicClock clock_;
  Robot robot_;
  drivers::SdoClient sdo_;
  drivers::WheelDrive drive_{robot_, Wheel::kFrontLeft};
  drivers::HeartbeatProducer heartbeat_{rates::kMasterHeartbeat};
  Instant now_{};
  std::array<hal::ReceivedFrame, 64> received_;
  std::optional<drivers::NmtState> heard_;
  std::optional<drivers::DriveStatus> status_;
};

}  // namespace

int main(int argc, char** argv) {
  int node_id = 0;
  if (argc == 3) {
    const std::string_view text(argv[2]);
    (void)std::from_chars(text.data(), text.data() + text.size(), node_id);
  }
  if (node_id < 1 || node_id > 127) {
    std::cerr << "usage: peer_master INTERFACE NODE, a node-id from 1 to 127\n";
    return 2;
  }
  auto bus = hal::SocketCanBus::open(argv[1]);
  if (!bus) {
    std::cerr << "peer_master: " << bus.error().message << '\n';
    return 2;
  }
  PeerMaster(bus.value(), static_cast<std::uint8_t>(node_id)).run();
  return 0;
}
