#include "firmware/safety/stop_inputs.hpp"

#include <bit>
#include <cstddef>

#include "config/rates.hpp"

namespace ivo::firmware {

StopInputs::StopInputs(const InputParameters& inputs) noexcept {
  unsigned fitted = inputs.emergency_stop ? 1U : 0U;
  for (std::size_t i = 0; i < inputs.bumpers.size(); ++i) {
    fitted |= inputs.bumpers[i] ? 1U << (i + 1) : 0U;
  }
  fitted_ = static_cast<std::uint8_t>(fitted);
}

std::optional<drivers::DriveFault> StopInputs::judge(const hal::DigitalSnapshot& snapshot) const noexcept {
  if (!fitted()) {
    return std::nullopt;
  }
  drivers::DriveFault fault{.reason = drivers::DriveFaultReason::kStopInput};
  const auto pressed = static_cast<unsigned>(snapshot.pressed & fitted_);
  if (snapshot.valid && pressed != 0) {
    fault.code = static_cast<std::uint32_t>(std::countr_zero(pressed));
    return fault;
  }
  // Asked this way round, an age that makes no sense is too old.
  if (snapshot.valid && snapshot.age >= Duration::zero() && snapshot.age <= rates::kInputsAge) {
    return std::nullopt;
  }
  fault.code = drivers::kStopInputsSilent;
  return fault;
}

}  // namespace ivo::firmware
