// The SDO server of a simulated device: expedited and segmented transfers (CiA 301, 7.2.4), and what scripts make it do
// wrong.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/sim/object_dictionary.hpp"
#include "drivers/sim/sim_fault.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

/// What an object holds.
struct SdoContent {
  std::array<std::uint8_t, ObjectDictionary::kLongBytes> bytes{};
  std::size_t size = 0;
};

/// One request at a time: on_request says what is to be done with the object; the device does it and answers.
class SimSdoServer {
 public:
  enum class Action : std::uint8_t {
    kNothing,
    kRead,    ///< of object(): then read() or abort()
    kWrite,   ///< content() into object(): then written() or abort()
    kAnswer,  ///< answer() is ready
  };

  [[nodiscard]] Action on_request(const hal::CanFrame& request, const SimFaults& faults) noexcept;
  [[nodiscard]] ObjectAddress object() const noexcept { return object_; }
  [[nodiscard]] const SdoContent& content() const noexcept { return content_; }
  /// The size that the client said it writes; none when it did not say.
  [[nodiscard]] bool size_given() const noexcept { return size_given_; }

  void read(const SdoContent& content, const SimFaults& faults) noexcept;
  void written() noexcept;
  void abort(SdoAbort code) noexcept;
  /// The frame to send, without its COB-ID.
  [[nodiscard]] const hal::CanFrame& answer() const noexcept { return answer_; }
  void reset() noexcept { *this = SimSdoServer(); }

 private:
  enum class Transfer : std::uint8_t { kNone, kUpload, kDownload };

  Action initiate_download(const SdoMessage& request) noexcept;
  Action upload_segment(const hal::CanFrame& request, const SimFaults& faults) noexcept;
  Action download_segment(const hal::CanFrame& request, const SimFaults& faults) noexcept;
  Action refuse(SdoAbort code) noexcept;
  void say(std::uint8_t command, std::uint32_t data) noexcept;

  Transfer transfer_ = Transfer::kNone;
  ObjectAddress object_;
  SdoContent content_;
  std::size_t done_ = 0;      // bytes of an upload
  std::size_t expected_ = 0;  // bytes of a download
  bool size_given_ = true;
  bool toggle_ = false;
  bool expedited_ = true;
  hal::CanFrame answer_;
};

}  // namespace ivo::drivers
