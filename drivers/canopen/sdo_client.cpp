#include "drivers/canopen/sdo_client.hpp"

#include <algorithm>

#include "config/base/contract.hpp"
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/sdo_segment.hpp"

namespace ivo::drivers {
namespace {

constexpr std::size_t kExpeditedBytes = 4;

std::uint8_t service_of(const hal::CanFrame& frame) noexcept { return frame.data[0] & sdo_command::kServiceMask; }

}  // namespace

void SdoClient::start_upload(ObjectAddress address, std::uint8_t bytes) noexcept {
  IVO_CONTRACT(bytes >= 1 && bytes <= kExpeditedBytes);
  start({sdo_command::kUpload, address, 0}, bytes);
}

void SdoClient::start_upload(ObjectAddress address) noexcept { start({sdo_command::kUpload, address, 0}, 0); }

void SdoClient::start_download(ObjectAddress address, std::uint8_t bytes, std::uint32_t value) noexcept {
  IVO_CONTRACT(bytes >= 1 && bytes <= kExpeditedBytes);
  start({sdo_command::expedited(sdo_command::kDownload, bytes), address, low_bytes(value, bytes)}, 0);
}

void SdoClient::start_download(ObjectAddress address, std::span<const std::uint8_t> data) noexcept {
  IVO_CONTRACT(data.size() <= kMostBytes);
  if (!data.empty() && data.size() <= kExpeditedBytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < data.size(); ++i) {
      value |= std::uint32_t{data[i]} << (8 * i);
    }
    start_download(address, static_cast<std::uint8_t>(data.size()), value);
    return;
  }
  start({sdo_command::kSegmentedDownload, address, static_cast<std::uint32_t>(data.size())}, 0);
  std::copy(data.begin(), data.end(), buffer_.begin());
  size_ = data.size();
}

void SdoClient::start(const SdoMessage& request, std::uint8_t bytes) noexcept {
  if (awaiting_answer()) {
    closing_ = abort_message(SdoAbort::kGeneral);
  }
  request_ = request;
  number_bytes_ = bytes;
  status_ = SdoStatus::kBusy;
  size_ = 0;
  attempts_ = 0;
  begin();
}

void SdoClient::begin() noexcept {
  stage_ = Stage::kInitiate;
  size_given_.reset();
  size_ = uploads() ? 0 : size_;
  done_ = 0;
  toggle_ = false;
  sent_ = false;
}

void SdoClient::forget() noexcept {
  status_ = SdoStatus::kIdle;
  closing_.reset();
  sent_ = false;
}

bool SdoClient::answers_this(const hal::CanFrame& frame) const noexcept {
  const std::optional<SdoMessage> answer = parse_sdo(frame);
  return answer.has_value() && answer->address == request_.address;
}

void SdoClient::on_frame(const hal::CanFrame& frame) noexcept {
  if (!awaiting_answer() || frame.id != cob_id::sdo_answer(node_id_) || frame.size != 8) {
    return;
  }
  if (service_of(frame) == sdo_command::kAbort) {
    if (answers_this(frame)) {
      status_ = SdoStatus::kAborted;
      abort_code_ = SdoAbort{parse_sdo(frame)->data};
    }
  } else if (stage_ == Stage::kInitiate) {
    on_initiated(frame);
  } else {
    on_segment(frame);
  }
}

void SdoClient::on_initiated(const hal::CanFrame& frame) noexcept {
  if (!answers_this(frame)) {
    return;
  }
  const std::uint8_t service = service_of(frame);
  if (service == sdo_command::kUpload && uploads()) {
    take_upload(*parse_sdo(frame));
  } else if (service == sdo_command::kDownloaded && !uploads()) {
    if (request_.command != sdo_command::kSegmentedDownload) {
      status_ = SdoStatus::kDone;
      return;
    }
    stage_ = Stage::kSegments;
    sent_ = false;
  }
}

void SdoClient::take_upload(const SdoMessage& answer) noexcept {
  if ((answer.command & sdo_command::kExpedited) != 0) {
    size_ = sdo_command::bytes_in(answer.command).value_or(std::uint8_t{kExpeditedBytes});
    store(std::span(buffer_), answer.data);
    finish_upload();
    return;
  }
  if ((answer.command & sdo_command::kSizeGiven) != 0) {
    size_given_ = answer.data;
  }
  if (size_given_.value_or(0) > kMostBytes) {
    abort(SdoAbort::kMemory);
    return;
  }
  stage_ = Stage::kSegments;
  sent_ = false;
}

void SdoClient::on_segment(const hal::CanFrame& frame) noexcept {
  const std::uint8_t service = service_of(frame);
  if (service == (uploads() ? sdo_command::kUploadedSegment : sdo_command::kDownloadedSegment)) {
    const bool toggle = (frame.data[0] & sdo_command::kToggle) != 0;
    if (toggle != toggle_) {
      abort(SdoAbort::kToggle);
    } else if (uploads()) {
      take_segment(frame);
    } else {
      confirm_segment();
    }
    return;
  }
  // A slow node may answer the request that initiates twice, when we had asked twice.
  const bool initiated_again =
      service == (uploads() ? sdo_command::kUpload : sdo_command::kDownloaded) && answers_this(frame);
  if (!initiated_again) {
    abort(SdoAbort::kCommandSpecifier);
  }
}

void SdoClient::take_segment(const hal::CanFrame& frame) noexcept {
  const SdoSegment segment = parse_sdo_segment(frame);
  const std::size_t size = size_ + segment.bytes;
  if (size > size_given_.value_or(kMostBytes)) {
    abort(size_given_.has_value() ? SdoAbort::kLengthTooHigh : SdoAbort::kMemory);
    return;
  }
  std::copy_n(segment.data.begin(), segment.bytes, buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ = size;
  if (segment.last) {
    finish_upload();
  } else if (segment.bytes == 0) {
    abort(SdoAbort::kLengthTooLow);  // it could go on like this for ever
  } else {
    next_segment();
  }
}

void SdoClient::confirm_segment() noexcept {
  done_ = std::min(done_ + kSegmentBytes, size_);
  if (done_ == size_) {
    status_ = SdoStatus::kDone;
  } else {
    next_segment();
  }
}

void SdoClient::next_segment() noexcept {
  toggle_ = !toggle_;
  sent_ = false;
}

void SdoClient::finish_upload() noexcept {
  if (size_ < number_bytes_ || size_ < size_given_.value_or(0)) {
    abort(SdoAbort::kLengthTooLow);
    return;
  }
  value_ = low_bytes(load<std::uint32_t>(buffer_), number_bytes_);
  status_ = SdoStatus::kDone;
}

void SdoClient::abort(SdoAbort code) noexcept {
  status_ = SdoStatus::kAborted;
  abort_code_ = code;
  closing_ = abort_message(code);
}

std::string_view SdoClient::text() const noexcept {
  const auto* const end = std::find(buffer_.begin(), buffer_.begin() + size_, std::uint8_t{0});
  return {reinterpret_cast<const char*>(buffer_.data()), static_cast<std::size_t>(end - buffer_.begin())};
}

std::optional<hal::CanFrame> SdoClient::poll(Instant now) noexcept {
  if (closing_.has_value()) {
    const hal::CanFrame closing = frame(*closing_);
    closing_.reset();
    return closing;
  }
  if (status_ != SdoStatus::kBusy) {
    return std::nullopt;
  }
  if (!sent_) {
    sent_ = true;
    attempts_ += stage_ == Stage::kInitiate ? 1 : 0;
    deadline_ = now + rates::kSdoTimeout;
    return request_frame();
  }
  if (now < deadline_) {
    return std::nullopt;
  }
  if (attempts_ == rates::kSdoAttempts) {
    status_ = SdoStatus::kTimedOut;
    abort_code_ = SdoAbort::kTimeout;
  }
  begin();
  return frame(abort_message(SdoAbort::kTimeout));
}

hal::CanFrame SdoClient::request_frame() const noexcept {
  if (stage_ == Stage::kInitiate) {
    return frame(request_);
  }
  const std::uint16_t id = cob_id::sdo_request(node_id_);
  if (uploads()) {
    return sdo_segment_frame(id, sdo_command::kUploadSegment, toggle_);
  }
  const std::size_t bytes = std::min(size_ - done_, kSegmentBytes);
  SdoSegment segment{
      .toggle = toggle_, .last = done_ + bytes == size_, .bytes = static_cast<std::uint8_t>(bytes), .data = {}};
  std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(done_), bytes, segment.data.begin());
  return sdo_segment_frame(id, segment);
}

hal::CanFrame SdoClient::frame(const SdoMessage& message) const noexcept {
  return sdo_frame(cob_id::sdo_request(node_id_), message);
}

SdoMessage SdoClient::abort_message(SdoAbort code) const noexcept {
  return {sdo_command::kAbort, request_.address, static_cast<std::uint32_t>(code)};
}

}  // namespace ivo::drivers
