#include "drivers/canopen/pdo_layout.hpp"

#include "config/base/contract.hpp"
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"

namespace ivo::drivers {

PdoChannels standard_channels(const Robot& robot, Wheel wheel) noexcept {
  const auto drive = static_cast<std::size_t>(wheel);
  const std::uint8_t node_id = robot.drives[drive].node_id;
  PdoChannels channels{.command_id = cob_id::rpdo1(node_id), .targets_id = 0, .feedback_id = cob_id::tpdo1(node_id)};
  if (robot.pdo_layout == PdoLayout::kShared) {
    channels.targets_id = cob_id::rpdo(2, robot.drives[first_of_pair(drive)].node_id);
  }
  return channels;
}

CommandFrames command_frames(PdoLayout layout, const GroupChannels& channels, const GroupCommands& commands,
                             const ControlwordsDue& due) noexcept {
  CommandFrames frames;
  const auto add = [&frames](const hal::CanFrame& frame) { IVO_CONTRACT(frames.push_back(frame)); };
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (layout == PdoLayout::kOwn) {
      add(command_frame(channels[i].command_id, commands[i]));
    } else if (due[i]) {
      add(controlword_frame(channels[i].command_id, commands[i].controlword));
    }
  }
  if (layout == PdoLayout::kShared) {
    for (std::size_t i = 0; i < channels.size(); i += 2) {
      add(target_pair_frame(channels[i].targets_id, {commands[i].target_velocity, commands[i + 1].target_velocity}));
    }
  }
  return frames;
}

ControlwordsDue ControlwordSchedule::due(const GroupCommands& commands, Instant now) noexcept {
  ControlwordsDue due{};
  for (std::size_t i = 0; i < due.size(); ++i) {
    const bool changed = !known_ || commands[i].controlword != words_[i];
    due[i] = changed || now >= refresh_[i];
    if (!due[i]) {
      continue;
    }
    words_[i] = commands[i].controlword;
    // All four change together: a first refresh that differs a quarter each keeps them apart from then on.
    const auto share = static_cast<Duration::rep>(changed ? i + 1 : due.size());
    refresh_[i] = now + rates::kControlwordRefresh * share / kWheels;
  }
  known_ = true;
  return due;
}

}  // namespace ivo::drivers
