// The errors of a simulated device: error register 1001h, history 1003h and the emergency messages that tell of them,
// not faster than 1015h (CiA 301, 7.2.7).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "drivers/sim/object_dictionary.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

class SimEmergencies {
 public:
  enum class Source : std::uint8_t { kDrive, kHeartbeat, kRpdoLate, kRpdoLength, kSyncLength };
  using Vendor = std::array<std::uint8_t, 5>;

  /// An error came; one that is there already is not told again. `vendor` goes into the message.
  void raise(Source source, std::uint16_t code, const Vendor& vendor, ObjectDictionary& objects) noexcept;
  /// An error went; when it was the last one a message with code 0 says so.
  void clear(Source source, const Vendor& vendor, ObjectDictionary& objects) noexcept;
  [[nodiscard]] bool active(Source source) const noexcept { return codes_[index(source)] != 0; }
  /// A message without an error.
  void say(std::uint16_t code, const Vendor& vendor, ObjectDictionary& objects) noexcept;

  /// The next message that may go out now.
  [[nodiscard]] std::optional<hal::CanFrame> next(Instant now, const ObjectDictionary& objects) noexcept;
  void reset() noexcept { *this = SimEmergencies(); }

 private:
  static constexpr std::size_t kSources = 5;
  static constexpr std::size_t kWaiting = 8;  // messages; when full the oldest is lost
  [[nodiscard]] static std::size_t index(Source source) noexcept { return static_cast<std::size_t>(source); }
  void refresh_register(ObjectDictionary& objects) const noexcept;

  std::array<std::uint16_t, kSources> codes_{};  // 0: no error
  StaticVector<hal::CanFrame, kWaiting> waiting_;
  std::optional<Instant> last_;
};

}  // namespace ivo::drivers
