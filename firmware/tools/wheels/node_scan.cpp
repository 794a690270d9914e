#include "firmware/tools/wheels/node_scan.hpp"

#include <algorithm>

#include "drivers/canopen/bus_ids.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::firmware {
namespace {

namespace cob_id = drivers::cob_id;
namespace object = drivers::object;

struct Reading {
  drivers::ObjectAddress address;
  std::uint8_t bytes = 0;
};

constexpr std::array<Reading, kScanObjects> kReadings{{{object::kDeviceType, 4},
                                                       {object::kVendorId, 4},
                                                       {object::kProductCode, 4},
                                                       {{0x1018, 3}, 4},
                                                       {{0x1018, 4}, 4},
                                                       {object::kSupportedModes, 4},
                                                       {object::kStatusword, 2},
                                                       {object::kErrorCode, 2}}};

constexpr drivers::ObjectAddress kDeviceName{0x1008, 0};
constexpr std::size_t kAllRead = kScanObjects + 1;

}  // namespace

NodeScan::NodeIds NodeScan::everyone() noexcept {
  NodeIds all;
  all.set();
  all.reset(0);
  return all;
}

NodeScan::NodeScan(hal::CanBus& bus, const Robot& robot, const NodeIds& asked) noexcept
    : bus_(bus), asked_(asked), master_node_id_(robot.master_node_id) {
  std::ranges::transform(robot.drives, ours_.begin(), &DriveParameters::node_id);
  for (std::size_t id = 1; id <= kNodes; ++id) {
    nodes_[id].sdo = drivers::SdoClient(static_cast<std::uint8_t>(id));
  }
}

void NodeScan::cycle(Instant now) noexcept {
  begin_ = begin_.value_or(now);
  const std::size_t received = bus_.receive(frames_, now);
  const bool listening = now - *begin_ < kListen;
  for (std::size_t i = 0; i < received; ++i) {
    if (listening) {
      listen_for_controller(frames_[i].frame.id);
    }
    take(frames_[i].frame);
  }
  if (listening) {
    return;
  }
  if (controller_.has_value()) {
    done_ = now - *begin_ >= kListen + kPatience;
    return;
  }
  ask(now);
}

void NodeScan::listen_for_controller(std::uint16_t id) noexcept {
  if (drivers::only_a_master_sends(id, ours_, master_node_id_)) {
    controller_ = controller_.value_or(id);
  }
}

void NodeScan::take(const hal::CanFrame& frame) noexcept {
  const std::uint8_t id = cob_id::node_of(frame.id);
  if (id == 0) {
    return;
  }
  Node& node = nodes_[id];
  if (const auto state = drivers::parse_heartbeat(frame)) {
    if (*state == drivers::NmtState::kBootUp) {
      node.seen.booted = true;
    } else {
      node.seen.state = state;
    }
  } else if (frame.id == cob_id::sdo_answer(id) && frame.size == 8 && node.asked) {
    if (node.seen.answered) {
      node.sdo.on_frame(frame);
    } else {  // whatever it says: it is there
      node.seen.answered = true;
      node.silent = false;
      start(node);
    }
  }
}

void NodeScan::ask(Instant now) noexcept {
  int requests = 0;
  bool busy = false;
  for (std::size_t id = 1; id <= kNodes; ++id) {
    Node& node = nodes_[id];
    if (!asked_.test(id) || node.silent) {
      continue;
    }
    if (node.seen.answered) {
      read_on(node, now);
    } else if (requests < kRequestsPerCycle && ask_first(node, static_cast<std::uint8_t>(id), now)) {
      ++requests;
    }
    busy = busy || (node.seen.answered ? node.object < kAllRead : !node.silent);
  }
  done_ = !busy;
}

bool NodeScan::ask_first(Node& node, std::uint8_t node_id, Instant now) noexcept {
  const bool again = node.asked && !node.asked_again && now - node.asked_at >= kPatience / 2;
  node.silent = node.asked && now - node.asked_at >= kPatience;
  if (node.silent || (node.asked && !again)) {
    return false;
  }
  node.asked_at = node.asked ? node.asked_at : now;
  node.asked_again = again;
  node.asked = true;
  const hal::CanFrame request =
      drivers::sdo_frame(cob_id::sdo_request(node_id), {drivers::sdo_command::kUpload, kReadings[0].address, 0});
  (void)bus_.send({&request, 1}, now);
  return true;
}

void NodeScan::start(Node& node) noexcept {
  if (node.object < kScanObjects) {
    node.sdo.start_upload(kReadings[node.object].address, kReadings[node.object].bytes);
  } else {
    node.sdo.start_upload(kDeviceName);
  }
}

void NodeScan::keep(Node& node) noexcept {
  if (node.object < kScanObjects) {
    node.seen.values[node.object] = node.sdo.value();
  } else {
    node.seen.name = NodeName(node.sdo.text());
  }
}

void NodeScan::read_on(Node& node, Instant now) noexcept {
  if (node.object == kAllRead) {
    return;
  }
  const drivers::SdoStatus status = node.sdo.status();
  if (status == drivers::SdoStatus::kDone) {
    keep(node);
  }
  if (status == drivers::SdoStatus::kTimedOut) {
    node.object = kAllRead;  // it went away
  } else if (status != drivers::SdoStatus::kBusy && ++node.object < kAllRead) {
    start(node);
  }
  if (const auto frame = node.sdo.poll(now)) {
    (void)bus_.send({&*frame, 1}, now);
  }
}

}  // namespace ivo::firmware
