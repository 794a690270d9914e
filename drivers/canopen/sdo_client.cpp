#include "drivers/canopen/sdo_client.hpp"

#include "config/base/contract.hpp"
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"

namespace ivo::drivers {

void SdoClient::start_upload(ObjectAddress address, std::uint8_t bytes) noexcept {
  start({sdo_command::kUpload, address, 0}, bytes);
}

void SdoClient::start_download(ObjectAddress address, std::uint8_t bytes, std::uint32_t value) noexcept {
  start({sdo_command::expedited(sdo_command::kDownload, bytes), address, low_bytes(value, bytes)}, bytes);
}

void SdoClient::start(const SdoMessage& request, std::uint8_t bytes) noexcept {
  IVO_CONTRACT(bytes >= 1 && bytes <= 4);
  request_ = request;
  bytes_ = bytes;
  status_ = SdoStatus::kBusy;
  abort_unsent_ = false;
  sent_ = false;
  attempts_ = 0;
}

void SdoClient::on_frame(const hal::CanFrame& frame) noexcept {
  if (!awaiting_answer()) {
    return;
  }
  const std::optional<SdoMessage> answer = parse_sdo(frame);
  if (!answer.has_value() || answer->address != request_.address) {
    return;
  }
  const std::uint8_t service = answer->command & sdo_command::kServiceMask;
  const bool upload = request_.command == sdo_command::kUpload;
  if (service == sdo_command::kAbort) {
    status_ = SdoStatus::kAborted;
    abort_code_ = SdoAbort{answer->data};
  } else if (service == sdo_command::kUpload && upload) {
    finish_upload(*answer);
  } else if (service == sdo_command::kDownloaded && !upload) {
    status_ = SdoStatus::kDone;
  }
}

void SdoClient::finish_upload(const SdoMessage& answer) noexcept {
  if ((answer.command & sdo_command::kExpedited) == 0) {
    abort(SdoAbort::kCommandSpecifier);
  } else if (sdo_command::bytes_in(answer.command).value_or(bytes_) < bytes_) {
    abort(SdoAbort::kLengthTooLow);
  } else {
    value_ = low_bytes(answer.data, bytes_);
    status_ = SdoStatus::kDone;
  }
}

void SdoClient::abort(SdoAbort code) noexcept {
  status_ = SdoStatus::kAborted;
  abort_code_ = code;
  abort_unsent_ = true;
}

std::optional<hal::CanFrame> SdoClient::poll(Instant now) noexcept {
  if (abort_unsent_) {
    abort_unsent_ = false;
    return abort_frame(abort_code_);
  }
  if (status_ != SdoStatus::kBusy) {
    return std::nullopt;
  }
  if (!sent_) {
    sent_ = true;
    ++attempts_;
    deadline_ = now + rates::kSdoTimeout;
    return frame(request_);
  }
  if (now < deadline_) {
    return std::nullopt;
  }
  sent_ = false;
  if (attempts_ == rates::kSdoAttempts) {
    status_ = SdoStatus::kTimedOut;
    abort_code_ = SdoAbort::kTimeout;
  }
  return abort_frame(SdoAbort::kTimeout);
}

hal::CanFrame SdoClient::frame(const SdoMessage& message) const noexcept {
  return sdo_frame(cob_id::sdo_request(node_id_), message);
}

hal::CanFrame SdoClient::abort_frame(SdoAbort code) const noexcept {
  return frame({sdo_command::kAbort, request_.address, static_cast<std::uint32_t>(code)});
}

}  // namespace ivo::drivers
