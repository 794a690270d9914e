// The client end of one node's SDO channel: expedited and segmented transfers, both ways (CiA 301, 7.2.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

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
  kAborted,   ///< by the node, or by us because of what it answered; abort_code() says why
  kTimedOut,  ///< no answer to any of rates::kSdoAttempts transfers
};

/// One transfer at a time, in static memory; nothing waits. Each cycle: on_frame for what arrived, then poll for what
/// is to be sent.
///
/// Nodes answer numbers in many ways (expedited with or without a size, in segments with or without one): all are
/// taken. An answer longer than the number is truncated, a shorter one is an error. An answer of a wrong length, to
/// another object, of another service or after the end is late or not for us, and dropped. We abort: when nothing comes
/// within rates::kSdoTimeout (then the transfer begins anew, rates::kSdoAttempts times in all), a toggle bit does not
/// alternate, a segment is of an unknown service, data is more than kMostBytes, or more or less than was announced. So
/// no channel is left open; and after an abort of the node nothing more is sent.
class SdoClient {
 public:
  static constexpr std::size_t kMostBytes = 64;  ///< of one transfer; a longer object is aborted: out of memory

  explicit SdoClient(std::uint8_t node_id) noexcept : node_id_(node_id) {}

  /// Begins to read a number of `bytes`, 1 to 4, from `address`: value(). What was under way is aborted.
  void start_upload(ObjectAddress address, std::uint8_t bytes) noexcept;
  /// Begins to read whatever `address` holds, as a name: bytes(), text().
  void start_upload(ObjectAddress address) noexcept;
  /// Begins to write the lowest `bytes`, 1 to 4, of `value` to `address`.
  void start_download(ObjectAddress address, std::uint8_t bytes, std::uint32_t value) noexcept;
  /// Begins to write `data`, which is copied, to `address`. Programmer's contract: at most kMostBytes.
  void start_download(ObjectAddress address, std::span<const std::uint8_t> data) noexcept;
  /// The node was reset: its channel is closed, nothing needs to be said.
  void forget() noexcept;

  /// A frame with the node's COB-ID 580h + node-id; others are dropped.
  void on_frame(const hal::CanFrame& frame) noexcept;
  /// The frame to send now, if any: a request, its repetition, or the abort that closes a transfer.
  [[nodiscard]] std::optional<hal::CanFrame> poll(Instant now) noexcept;

  [[nodiscard]] SdoStatus status() const noexcept { return status_; }
  /// Of an upload of a number that is done.
  [[nodiscard]] std::uint32_t value() const noexcept { return value_; }
  /// Of an upload that is done; valid until the next start.
  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept { return std::span(buffer_).first(size_); }
  /// bytes() to the first NUL, which some nodes fill up with.
  [[nodiscard]] std::string_view text() const noexcept;
  [[nodiscard]] SdoAbort abort_code() const noexcept { return abort_code_; }  ///< when aborted or timed out
  /// True while a request is on its way and neither answered nor timed out.
  [[nodiscard]] bool awaiting_answer() const noexcept { return status_ == SdoStatus::kBusy && sent_; }

 private:
  enum class Stage : std::uint8_t { kInitiate, kSegments };

  void start(const SdoMessage& request, std::uint8_t bytes) noexcept;
  void begin() noexcept;
  void on_initiated(const hal::CanFrame& frame) noexcept;
  void on_segment(const hal::CanFrame& frame) noexcept;
  void take_upload(const SdoMessage& answer) noexcept;
  void take_segment(const hal::CanFrame& frame) noexcept;
  void confirm_segment() noexcept;
  void next_segment() noexcept;
  void finish_upload() noexcept;
  void abort(SdoAbort code) noexcept;
  [[nodiscard]] bool uploads() const noexcept { return request_.command == sdo_command::kUpload; }
  [[nodiscard]] bool answers_this(const hal::CanFrame& frame) const noexcept;
  [[nodiscard]] hal::CanFrame request_frame() const noexcept;
  [[nodiscard]] hal::CanFrame frame(const SdoMessage& message) const noexcept;
  [[nodiscard]] SdoMessage abort_message(SdoAbort code) const noexcept;

  std::uint8_t node_id_;
  SdoStatus status_ = SdoStatus::kIdle;
  Stage stage_ = Stage::kInitiate;
  SdoMessage request_;                       // that initiates the transfer
  std::uint8_t number_bytes_ = 0;            // of the number to read, 0 when it is none
  std::optional<std::uint32_t> size_given_;  // by the node, of an upload in segments
  std::array<std::uint8_t, kMostBytes> buffer_{};
  std::size_t size_ = 0;  // bytes in buffer_: read so far, or to write
  std::size_t done_ = 0;  // of them, written and confirmed
  bool toggle_ = false;   // of the segment under way
  std::uint32_t value_ = 0;
  SdoAbort abort_code_{};
  std::optional<SdoMessage> closing_;  // the abort that is still to be sent
  bool sent_ = false;
  int attempts_ = 0;
  Instant deadline_{};
};

}  // namespace ivo::drivers
