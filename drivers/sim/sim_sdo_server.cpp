#include "drivers/sim/sim_sdo_server.hpp"

#include <algorithm>

namespace ivo::drivers {
namespace {

constexpr std::uint8_t kDownloadSegment = 0x00;    // request; its answer is kSegmentDownloaded
constexpr std::uint8_t kSegmentDownloaded = 0x20;  // answer
constexpr std::uint8_t kUploadSegment = 0x60;      // request; its answer has no service bits
constexpr std::uint8_t kToggle = 0x10;
constexpr std::uint8_t kLastSegment = 0x01;
constexpr std::uint8_t kExpeditedWithoutSize = 0x42;
constexpr std::size_t kSegmentBytes = 7;
constexpr std::size_t kExpeditedBytes = 4;

std::uint8_t toggle_bit(bool toggle) noexcept { return toggle ? kToggle : 0; }

std::uint8_t unused_bits(std::size_t bytes) noexcept { return static_cast<std::uint8_t>((kSegmentBytes - bytes) << 1); }

}  // namespace

void SimSdoServer::say(std::uint8_t command, std::uint32_t data) noexcept {
  answer_ = sdo_frame(0, {command, object_, data});
}

void SimSdoServer::abort(SdoAbort code) noexcept {
  transfer_ = Transfer::kNone;
  say(sdo_command::kAbort, static_cast<std::uint32_t>(code));
}

SimSdoServer::Action SimSdoServer::refuse(SdoAbort code) noexcept {
  abort(code);
  return Action::kAnswer;
}

SimSdoServer::Action SimSdoServer::on_request(const hal::CanFrame& frame, const SimFaults& faults) noexcept {
  const std::optional<SdoMessage> request = parse_sdo(frame);
  if (!request.has_value()) {
    return Action::kNothing;
  }
  switch (request->command & sdo_command::kServiceMask) {
    case sdo_command::kAbort:
      transfer_ = Transfer::kNone;
      return Action::kNothing;
    case sdo_command::kUpload:
      transfer_ = Transfer::kNone;
      object_ = request->address;
      return Action::kRead;
    case sdo_command::kDownload:
      object_ = request->address;
      return initiate_download(*request);
    case kUploadSegment:
      return upload_segment(frame, faults);
    case kDownloadSegment:
      return download_segment(frame, faults);
    default:
      object_ = request->address;
      return refuse(SdoAbort::kCommandSpecifier);
  }
}

SimSdoServer::Action SimSdoServer::initiate_download(const SdoMessage& request) noexcept {
  transfer_ = Transfer::kNone;
  content_ = {};
  expedited_ = (request.command & sdo_command::kExpedited) != 0;
  size_given_ = (request.command & sdo_command::kSizeGiven) != 0;
  if (expedited_) {
    content_.size = sdo_command::bytes_in(request.command).value_or(std::uint8_t{kExpeditedBytes});
    store(std::span(content_.bytes), request.data);
    return Action::kWrite;
  }
  if (size_given_ && request.data > content_.bytes.size()) {
    return refuse(SdoAbort::kLengthTooHigh);
  }
  transfer_ = Transfer::kDownload;
  expected_ = request.data;
  toggle_ = false;
  say(sdo_command::kDownloaded, 0);
  return Action::kAnswer;
}

SimSdoServer::Action SimSdoServer::download_segment(const hal::CanFrame& request, const SimFaults& faults) noexcept {
  if (transfer_ != Transfer::kDownload) {
    object_ = {};
    return refuse(SdoAbort::kCommandSpecifier);
  }
  const std::uint8_t command = request.data[0];
  const std::size_t bytes = kSegmentBytes - ((command >> 1) & 7);
  if ((command & kToggle) != toggle_bit(toggle_)) {
    return refuse(SdoAbort::kToggle);
  }
  if (content_.size + bytes > content_.bytes.size() || (size_given_ && content_.size + bytes > expected_)) {
    return refuse(SdoAbort::kLengthTooHigh);
  }
  std::copy_n(request.data.begin() + 1, bytes, content_.bytes.begin() + static_cast<std::ptrdiff_t>(content_.size));
  content_.size += bytes;
  const bool toggle = toggle_ != faults.on(SimFault::kSdoToggle);
  answer_ = {.id = 0, .size = 8, .data = {static_cast<std::uint8_t>(kSegmentDownloaded | toggle_bit(toggle))}};
  toggle_ = !toggle_;
  if ((command & kLastSegment) == 0) {
    return Action::kAnswer;
  }
  transfer_ = Transfer::kNone;
  if (size_given_ && content_.size < expected_) {
    return refuse(SdoAbort::kLengthTooLow);
  }
  size_given_ = true;
  return Action::kWrite;
}

void SimSdoServer::written() noexcept {
  if (expedited_) {
    say(sdo_command::kDownloaded, 0);
  }
}

void SimSdoServer::read(const SdoContent& content, const SimFaults& faults) noexcept {
  content_ = content;
  if (content.size >= 1 && content.size <= kExpeditedBytes && !faults.on(SimFault::kSdoSegmented)) {
    const auto bytes = static_cast<std::uint8_t>(content.size);
    say(faults.on(SimFault::kSdoNoSize) ? kExpeditedWithoutSize : sdo_command::expedited(sdo_command::kUpload, bytes),
        load<std::uint32_t>(content.bytes));
    return;
  }
  transfer_ = Transfer::kUpload;
  done_ = 0;
  toggle_ = false;
  const bool unsized = faults.on(SimFault::kSdoNoSize);
  say(unsized ? sdo_command::kUpload : sdo_command::kUpload | sdo_command::kSizeGiven,
      unsized ? 0 : static_cast<std::uint32_t>(content.size));
}

SimSdoServer::Action SimSdoServer::upload_segment(const hal::CanFrame& request, const SimFaults& faults) noexcept {
  if (transfer_ != Transfer::kUpload) {
    object_ = {};
    return refuse(SdoAbort::kCommandSpecifier);
  }
  if ((request.data[0] & kToggle) != toggle_bit(toggle_)) {
    return refuse(SdoAbort::kToggle);
  }
  const std::size_t bytes = std::min(content_.size - done_, kSegmentBytes);
  const bool last = done_ + bytes == content_.size;
  const bool toggle = toggle_ != faults.on(SimFault::kSdoToggle);
  answer_ = {.id = 0, .size = 8, .data = {}};
  answer_.data[0] = static_cast<std::uint8_t>(toggle_bit(toggle) | unused_bits(bytes) | (last ? kLastSegment : 0));
  std::copy_n(content_.bytes.begin() + static_cast<std::ptrdiff_t>(done_), bytes, answer_.data.begin() + 1);
  done_ += bytes;
  toggle_ = !toggle_;
  transfer_ = last ? Transfer::kNone : Transfer::kUpload;
  return Action::kAnswer;
}

}  // namespace ivo::drivers
