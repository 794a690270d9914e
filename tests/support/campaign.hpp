// A robot's hard life at random: drives that fail, a bus that fails, people who press buttons at the wrong time; a
// shadow model watches every frame. The same seed gives the same life.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "drivers/drive_fault.hpp"
#include "firmware/loop/control_loop.hpp"
#include "hal/sim/digital_inputs.hpp"
#include "tests/support/rough_bus.hpp"
#include "tests/support/search_rig.hpp"
#include "tests/support/shadow_model.hpp"

namespace ivo::test {

struct CampaignFigures {
  std::uint64_t cycles = 0;
  std::uint64_t frames = 0;
  std::uint64_t certain_events = 0;
  int lives = 0;
  int shared_lives = 0;  ///< of them, with shared targets at 1 kHz
  int starts = 0;        ///< times the wheels were set in motion
  int faults = 0;
  int pauses = 0;      ///< in motion
  int beats_lost = 0;  ///< of them, because nobody was there
  int new_plans = 0;   ///< made anew and taken up by the loop
  std::map<drivers::DriveFaultReason, int> reasons;
  std::map<std::string, int> violations;
};

/// One life after another, until `cycles` have run.
class Campaign {
 public:
  using OperatorCommand = firmware::OperatorCommand;
  using Plant = ShadowedBus::Plant;

  /// Without a layout each life has one of its own.
  explicit Campaign(std::uint64_t seed, Plant plant = nullptr, std::optional<PdoLayout> layout = std::nullopt)
      : random_(seed), plant_(std::move(plant)), layout_(layout) {}

  CampaignFigures run(std::uint64_t cycles) {
    while (figures_.cycles < cycles) {
      Life life(*this);
      life.live(cycles);
    }
    return figures_;
  }

 private:
  class Life {
   public:
    explicit Life(Campaign& campaign)
        : campaign_(campaign),
          random_(campaign.random_),
          layout_(campaign.layout_ ? *campaign.layout_
                  : chance(3) > 0  ? PdoLayout::kOwn
                                   : PdoLayout::kShared),
          shadow_(SearchRig::robot(layout_)),
          fault_every_(100U << chance(5)),
          consent_every_(10U << chance(4)) {
      SearchRig::Options options{.object = std::nullopt, .generations = 1, .fault_waits = true};
      options.inputs = &inputs_;
      options.layout = layout_;
      options.person = chance(2) == 0 ? PersonMotion::kSimulated : PersonMotion::kReported;
      options.between = [this](hal::CanBus& port) -> hal::CanBus& {
        rough_.emplace(port, random_);
        shadowed_.emplace(*rough_, shadow_);
        shadowed_->plant = campaign_.plant_;
        return *shadowed_;
      };
      rig_.emplace(options);
    }

    void live(std::uint64_t cycles) {
      constexpr int kLongest = 5000;
      constexpr int kLongestStuck = 1500;  // nobody has cleared it, or it is to be mended
      for (int i = 0; i < kLongest && stuck_ < kLongestStuck && campaign_.figures_.cycles < cycles &&
                      !rig_->loop().status().finished;
           ++i) {
        cycle();
      }
      CampaignFigures& figures = campaign_.figures_;
      ++figures.lives;
      figures.shared_lives += layout_ == PdoLayout::kShared ? 1 : 0;
      figures.frames += shadow_.frames();
      figures.certain_events += shadow_.certain_events();
      figures.starts += shadow_.starts();
      figures.faults += shadow_.faults();
      figures.pauses += shadow_.pauses();
      figures.beats_lost += shadow_.beats_lost();
      figures.new_plans += static_cast<int>(rig_->loop().status().plan_number) - 1;
      for (const auto& [rule, count] : shadow_.violations()) {
        figures.violations[rule] += count;
      }
    }

   private:
    unsigned chance(unsigned of) { return static_cast<unsigned>(random_() % of); }
    Wheel any_wheel() { return static_cast<Wheel>(chance(kWheels)); }

    void cycle() {
      recover();
      if (chance(fault_every_) == 0) {
        go_wrong();
      }
      ShadowModel::Outside outside;
      press_buttons(outside);
      talk(outside);
      press_inputs(outside);
      if (late_ > 0) {
        rig_->be_late(late_);
      }
      outside.now = rig_->now();
      outside.skipped = std::exchange(late_, 0);
      outside.bus_lost = hal::lost(rough_->state());
      outside.receive_dropped = rough_->counters().receive_dropped;
      outside.wheels_turn = rig_->wheels_turn();
      outside.moved_by_others = others_command_;
      shadow_.begin(outside);
      const firmware::LoopStatus& status = rig_->cycle(outside.skipped);
      shadow_.end(status.mode);
      (void)rig_->events();
      ++campaign_.figures_.cycles;
      if (status.mode == firmware::Mode::kFault && !faulty_) {
        ++campaign_.figures_.reasons[status.drive_fault.reason];
      }
      faulty_ = status.mode == firmware::Mode::kFault;
      const bool to_be_mended = status.drive_fault.reason == drivers::DriveFaultReason::kResetLimit;
      stuck_ = !faulty_ ? 0 : stuck_ + (to_be_mended ? 10 : 1);
    }

    void press_buttons(ShadowModel::Outside& outside) {
      if (chance(consent_every_) == 0) {
        agree(outside);
      }
      if (chance(2000) == 0) {
        rig_->loop().request_pause();
        outside.pause = true;
      }
      if (somebody_is_there_ && chance(200) == 0) {
        rig_->loop().beat();
        outside.beat = true;
      }
      if (chance(100) == 0) {
        outside.clear = rig_->loop().command(OperatorCommand::kClearFault);
      }
      if (chance(20'000) == 0) {
        rig_->loop().request_stop();
      }
      if (chance(50'000) == 0) {
        (void)rig_->loop().command(OperatorCommand::kNoConsent);
      }
    }

    // Who has not heard of the last pause agrees to nothing.
    void agree(ShadowModel::Outside& outside) {
      OperatorCommand consent(OperatorCommand::kConsent);
      const std::uint32_t pauses = rig_->loop().status().pauses;
      const bool knows = pauses == 0 || chance(4) > 0;
      consent.pauses = knows ? pauses : pauses - 1;
      consent.watched = chance(4) > 0;
      const bool told = rig_->loop().command(consent);
      outside.consent = told && knows;
      outside.watched = consent.watched;
      somebody_is_there_ = chance(3) == 0;
    }

    // Another plan, its refusal, reports: what the console's side of the program says to the loop.
    void talk(ShadowModel::Outside& outside) {
      if (!wants_plan_ && chance(4000) == 0) {
        wants_plan_ = rig_->loop().command(OperatorCommand::kPlanAnew);
        outside.pause = outside.pause || wants_plan_;
      } else if (wants_plan_ && chance(300) == 0) {
        const bool stands = !firmware::permissions(rig_->loop().status().mode).may_move;
        const bool made = stands && chance(2) == 0;
        const bool told = made ? rig_->plan_with(1) : rig_->loop().command(OperatorCommand::kPlanAsBefore);
        wants_plan_ = !told;
      }
      if (chance(50) == 0) {
        OperatorCommand report(OperatorCommand::kReport);
        report.agent = static_cast<std::uint8_t>(chance(3));
        report.place = {0.5 + chance(12), 0.5 + chance(12)};
        (void)rig_->loop().command(report);
      }
      if (chance(20'000) == 0) {
        OperatorCommand found(OperatorCommand::kFound);
        found.agent = static_cast<std::uint8_t>(chance(3));
        (void)rig_->loop().command(found);
      }
      if (chance(2000) == 0) {
        (void)rig_->loop().command(OperatorCommand::kEnough);
      }
    }

    // A tap is over before anybody looks; what is pressed, or silent, is so until recover().
    void press_inputs(ShadowModel::Outside& outside) {
      const bool tapped = chance(20 * fault_every_) == 0;
      if (tapped) {
        inputs_.tap(chance(2));
      }
      const bool silent = silent_since_ && rig_->now() - *silent_since_ > rates::kInputsAge;
      outside.stop_input = tapped || pressed_ || silent;
    }

    void touch_inputs() {
      pressed_ = chance(2) == 0;
      if (pressed_) {
        inputs_.press(chance(2));
      } else if (!silent_since_) {
        inputs_.fall_silent(rig_->now());
        silent_since_ = rig_->now();
      }
    }

    void leave_inputs() {
      inputs_.release(0);
      inputs_.release(1);
      inputs_.resume();
      pressed_ = false;
      silent_since_.reset();
    }

    // Of a wheel, of its power and of what its drive tells of them; ended by recover().
    void begin_event(drivers::SimDrive& drive) {
      using drivers::SimFault;
      constexpr std::array<SimFault, 11> kFaults = {
          SimFault::kEncoderStuck, SimFault::kBlocked,       SimFault::kSlip,          SimFault::kStoOpen,
          SimFault::kNotEnabling,  SimFault::kFaultAgain,    SimFault::kStuckTpdo,     SimFault::kLateTpdo,
          SimFault::kShortTpdo,    SimFault::kDuplicateTpdo, SimFault::kEmergencyStorm};
      auto& events = drive.script().events;
      if (std::ranges::all_of(events, &drivers::SimEvent::done)) {
        events.clear();
      }
      if (events.size() + 2 <= drivers::SimScript::kEvents) {
        const SimFault fault = kFaults[chance(kFaults.size())];
        const std::uint32_t value = fault == SimFault::kEmergencyStorm ? 0x8400
                                    : fault == SimFault::kShortTpdo    ? 1 + chance(5)
                                                                       : 1 + chance(1000);
        (void)events.push_back({.at = rig_->now(), .fault = fault, .on = true, .value = value});
        begun_.emplace_back(&drive, fault);
      }
    }

    void end_events() {
      for (const auto& [drive, fault] : begun_) {
        (void)drive->script().events.push_back({.at = rig_->now(), .fault = fault, .on = false});
      }
      begun_.clear();
    }

    // What went wrong ends after a while.
    void recover() {
      if (wrong_until_ && rig_->now() >= *wrong_until_) {
        wrong_until_.reset();
        others_command_ = false;
        leave_inputs();
        end_events();
        rough_->roughness = {};
        rig_->bus().set_state(0, hal::BusState::kActive);
        for (int i = 0; i < kWheels; ++i) {
          drivers::SimScript& script = rig_->drives().drive(static_cast<Wheel>(i)).script();
          script.silent_from = drivers::SimScript::kNever;
          script.feedback_lost_from = drivers::SimScript::kNever;
          script.heartbeat_lost_from = drivers::SimScript::kNever;
        }
      }
    }

    void go_wrong() {
      wrong_until_ = rig_->now() + std::chrono::milliseconds(2 << chance(10));
      drivers::SimDrive& drive = rig_->drives().drive(any_wheel());
      const unsigned which = chance(22);
      switch (which) {
        case 0:
          drive.script().silent_from = rig_->now();
          break;
        case 1:
          drive.script().feedback_lost_from = rig_->now();
          break;
        case 2:
          drive.script().heartbeat_lost_from = rig_->now();
          break;
        case 3:
          drive.script().reboot_at = rig_->now();
          break;
        case 4:
          drive.script().fault_at = rig_->now();
          break;
        case 5:
          late_ = static_cast<int>(1 + chance(12));
          break;
        case 6:
          late_ = static_cast<int>(20 + chance(200));
          break;
        case 7:
          rough_->roughness.lost = 1 + chance(300);
          break;
        case 8:
          rough_->roughness.doubled = 1 + chance(300);
          break;
        case 9:
          rough_->roughness.garbled = 1 + chance(100);
          break;
        case 10:
          rough_->roughness.takes = chance(10);
          break;
        case 11:
          rig_->bus().set_state(0, static_cast<hal::BusState>(1 + chance(6)));
          break;
        case 12:
          flood();
          break;
        case 13:
          touch_inputs();
          break;
        case 14:
        case 15:
        case 16:
          begin_event(drive);
          break;
        default:
          inject(which);
          break;
      }
    }

    void flood() {
      const hal::CanFrame frame{.id = static_cast<std::uint16_t>(0x081 + chance(4)), .size = 8, .data = {}};
      for (unsigned i = chance(1200); i > 0; --i) {
        (void)rig_->bus().port(2).send({&frame, 1}, rig_->now());
      }
    }

    void inject(unsigned which) {
      hal::CanFrame frame{.id = static_cast<std::uint16_t>(random_() % 0x800),
                          .size = static_cast<std::uint8_t>(chance(9)),
                          .data = {}};
      if (which % 2 == 0) {  // on the drives' and the master's own ids
        constexpr std::array<int, 8> kFunctions = {0x000, 0x080, 0x180, 0x200, 0x580, 0x600, 0x700, 0x77F - 4};
        frame.id = static_cast<std::uint16_t>(kFunctions[chance(8)] + static_cast<int>(chance(5)));
      }
      for (std::uint8_t& byte : frame.data) {
        byte = static_cast<std::uint8_t>(chance(2) == 0 ? 0U : chance(256));
      }
      others_command_ = true;
      (void)rig_->bus().port(2).send({&frame, 1}, rig_->now());
    }

    Campaign& campaign_;
    std::mt19937_64& random_;
    PdoLayout layout_;
    ShadowModel shadow_;
    unsigned fault_every_;
    unsigned consent_every_;
    hal::SimDigitalInputs inputs_;
    std::optional<RoughBus> rough_;
    std::optional<ShadowedBus> shadowed_;
    std::optional<SearchRig> rig_;
    std::optional<Instant> wrong_until_;
    std::vector<std::pair<drivers::SimDrive*, drivers::SimFault>> begun_;
    bool pressed_ = false;
    std::optional<Instant> silent_since_;
    bool others_command_ = false;
    bool faulty_ = false;
    bool somebody_is_there_ = true;
    bool wants_plan_ = false;
    int stuck_ = 0;  // cycles in one fault
    int late_ = 0;
  };

  std::mt19937_64 random_;
  Plant plant_;
  std::optional<PdoLayout> layout_;
  CampaignFigures figures_;
};

}  // namespace ivo::test
