#include "firmware/tools/wheels/bus_listener.hpp"

#include <algorithm>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/frame_bits.hpp"
#include "drivers/canopen/pdo_layout.hpp"
#include "firmware/tools/wheels/turn_measure.hpp"

namespace ivo::firmware {
namespace {

namespace cob_id = drivers::cob_id;

constexpr Duration kCount = std::chrono::seconds(1);
constexpr Duration kStale = std::chrono::milliseconds(200);

std::array<drivers::WheelEncoder, kWheels> encoders_of(const Robot& robot) noexcept {
  const double radius_m = robot.base.wheel_radius_m;
  return {drivers::WheelEncoder(robot.drives[0], radius_m), drivers::WheelEncoder(robot.drives[1], radius_m),
          drivers::WheelEncoder(robot.drives[2], radius_m), drivers::WheelEncoder(robot.drives[3], radius_m)};
}

/// Which PDO of the node this is, by the predefined connection set; 0: none. `first` is the COB-ID of its PDO 1.
int pdo_number(std::uint16_t id, std::uint16_t first) noexcept {
  const int above = id - first;
  return above >= 0 && above % 0x100 == 0 && above / 0x100 < cob_id::kPdos ? above / 0x100 + 1 : 0;
}

}  // namespace

BusListener::BusListener(const Robot& robot) noexcept : robot_(robot), encoders_(encoders_of(robot)) {}

void BusListener::on_frame(const hal::ReceivedFrame& received) noexcept {
  const hal::CanFrame& frame = received.frame;
  ++frames_;
  ++counted_frames_;
  counted_bits_ += static_cast<std::uint64_t>(drivers::bits_on_wire(frame));
  if (frame.id == cob_id::kSync) {
    ++counted_syncs_;
    return;
  }
  const std::uint8_t node_id = cob_id::node_of(frame.id);
  if (frame.id == cob_id::heartbeat(robot_.master_node_id)) {
    controller_at_ = received.at;
  }
  take_targets(frame);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (robot_.drives[i].node_id == node_id) {
      take(i, received);
    }
  }
}

void BusListener::take(std::size_t wheel, const hal::ReceivedFrame& received) noexcept {
  const hal::CanFrame& frame = received.frame;
  HeardNode& node = nodes_[wheel];
  if (const auto state = drivers::parse_heartbeat(frame)) {
    node.state = state;
    node.heartbeat_at = received.at;
    if (*state == drivers::NmtState::kBootUp) {
      ++node.boot_ups;
      node.status_tpdo = 0;  // it may be mapped otherwise from now on
      encoders_[wheel].rebase();
    }
  } else if (const auto emergency = drivers::parse_emergency(frame)) {
    node.emergency = emergency;
    node.emergency_at = received.at;
    ++node.emergencies;
  } else {
    take_status(wheel, received);
  }
}

void BusListener::take_status(std::size_t wheel, const hal::ReceivedFrame& received) noexcept {
  HeardNode& node = nodes_[wheel];
  const int number = pdo_number(received.frame.id, cob_id::tpdo1(robot_.drives[wheel].node_id));
  const auto status = drivers::parse_status(received.frame);
  if (number == 0 || !status || (node.status_tpdo != 0 && number > node.status_tpdo)) {
    return;
  }
  if (number != node.status_tpdo) {
    encoders_[wheel].rebase();  // what another PDO carried may have been something else
  }
  node.status = status;
  node.status_tpdo = number;
  node.status_at = received.at;
  encoders_[wheel].sample(status->position, received.at);
}

void BusListener::take_targets(const hal::CanFrame& frame) noexcept {
  if (robot_.pdo_layout == PdoLayout::kOwn) {
    for (std::size_t i = 0; i < nodes_.size() && frame.size == drivers::kPdoBytes; ++i) {
      if (pdo_number(frame.id, cob_id::rpdo1(robot_.drives[i].node_id)) != 0) {
        told(i, static_cast<std::int32_t>(drivers::load<std::uint32_t>(std::span(frame.data).subspan(2))));
      }
    }
    return;
  }
  const auto pair = drivers::parse_target_pair(frame);
  for (std::size_t i = 0; i < nodes_.size() && pair; ++i) {
    if (frame.id == drivers::standard_channels(robot_, static_cast<Wheel>(i)).targets_id) {
      told(i, i == drivers::first_of_pair(i) ? pair->first : pair->second);
    }
  }
}

void BusListener::told(std::size_t wheel, std::int32_t target) noexcept {
  nodes_[wheel].told_radps = target / TurnMeasure::scale_of(robot_.drives[wheel]).units_per_radps;
}

void BusListener::update(Instant now) noexcept {
  counting_since_ = counting_since_.value_or(now);
  const Duration time = now - *counting_since_;
  if (time < kCount) {
    return;
  }
  traffic_ = {.load = static_cast<double>(counted_bits_) / (seconds(time) * robot_.bit_rate_bps),
              .frames_per_s = static_cast<double>(counted_frames_) / seconds(time),
              .syncs_per_s = static_cast<double>(counted_syncs_) / seconds(time)};
  counting_since_ = now;
  counted_frames_ = 0;
  counted_syncs_ = 0;
  counted_bits_ = 0;
}

double BusListener::radps(Wheel wheel, Instant now) const noexcept {
  const auto index = static_cast<std::size_t>(wheel);
  return now - nodes_[index].status_at > kStale ? 0.0 : encoders_[index].radps();
}

}  // namespace ivo::firmware
