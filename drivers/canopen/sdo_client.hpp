// The client end of one node's SDO channel: expedited transfers of objects of up to four bytes (CiA 301, 7.2.4).
#pragma once

#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

enum class SdoStatus : std::uint8_t {
  kIdle,
  kBusy,
  kDone,
  kAborted,   ///< by the node, abort_code() says why; or by us, when its answer has no expedited data of the right
              ///< length
  kTimedOut,  ///< no answer to any of rates::kSdoAttempts requests
};

/// One transfer at a time; nothing waits. Each cycle: on_frame for what arrived, then poll for what is to be sent.
/// An answer to another object, of another service or after the end is late and dropped. An answer longer than the
/// object (some nodes always send four bytes, some do not say: 42h) is truncated, a shorter one is an error.
class SdoClient {
 public:
  explicit SdoClient(std::uint8_t node_id) noexcept : node_id_(node_id) {}

  /// Begins to read `bytes`, 1 to 4, of `address`. What was under way is forgotten.
  void start_upload(ObjectAddress address, std::uint8_t bytes) noexcept;
  /// Begins to write the lowest `bytes`, 1 to 4, of `value` to `address`.
  void start_download(ObjectAddress address, std::uint8_t bytes, std::uint32_t value) noexcept;

  /// A frame with the node's COB-ID 580h + node-id.
  void on_frame(const hal::CanFrame& frame) noexcept;
  /// The frame to send now, if any: the request, its repetition, or the abort that closes a transfer that timed out.
  [[nodiscard]] std::optional<hal::CanFrame> poll(Instant now) noexcept;

  [[nodiscard]] SdoStatus status() const noexcept { return status_; }
  [[nodiscard]] std::uint32_t value() const noexcept { return value_; }       ///< of an upload that is done
  [[nodiscard]] SdoAbort abort_code() const noexcept { return abort_code_; }  ///< when aborted or timed out
  /// True while a request is on its way and neither answered nor timed out.
  [[nodiscard]] bool awaiting_answer() const noexcept { return status_ == SdoStatus::kBusy && sent_; }

 private:
  void start(const SdoMessage& request, std::uint8_t bytes) noexcept;
  void finish_upload(const SdoMessage& answer) noexcept;
  void abort(SdoAbort code) noexcept;
  [[nodiscard]] hal::CanFrame frame(const SdoMessage& message) const noexcept;
  [[nodiscard]] hal::CanFrame abort_frame(SdoAbort code) const noexcept;

  std::uint8_t node_id_;
  SdoStatus status_ = SdoStatus::kIdle;
  SdoMessage request_;
  std::uint8_t bytes_ = 0;
  std::uint32_t value_ = 0;
  SdoAbort abort_code_{};
  bool abort_unsent_ = false;
  bool sent_ = false;
  int attempts_ = 0;
  Instant deadline_{};
};

}  // namespace ivo::drivers
