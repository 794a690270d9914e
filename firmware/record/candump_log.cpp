#include "firmware/record/candump_log.hpp"

#include <array>
#include <cstdio>
#include <string_view>

namespace ivo::firmware {

std::string candump_line(const RecordedFrame& recorded, const std::string& interface, Duration epoch) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  constexpr long long kSecond = 1'000'000;
  const long long us = (epoch + recorded.at.time_since_epoch()).count() / 1000;
  std::array<char, 64> stamp{};
  (void)std::snprintf(stamp.data(), stamp.size(), "(%010lld.%06lld) ", us / kSecond, us % kSecond);
  std::string line = stamp.data() + interface + ' ';
  const hal::CanFrame& frame = recorded.frame;
  for (const int shift : {8, 4, 0}) {
    line += kDigits[frame.id >> shift & 0xF];
  }
  line += '#';
  for (std::size_t i = 0; i < frame.size; ++i) {
    line += kDigits[frame.data[i] >> 4];
    line += kDigits[frame.data[i] & 0xF];
  }
  return line + '\n';
}

Result<CandumpLog> CandumpLog::create(const std::string& path, const std::string& interface, Duration epoch,
                                      RecordFile::Earlier earlier) {
  Result<RecordFile> file = RecordFile::create(path, "(", {.record = "record", .of = "frames"}, earlier);
  if (!file) {
    return file.error();
  }
  return CandumpLog(std::move(file).value(), interface, epoch);
}

void CandumpLog::drain(FrameRing& ring) {
  for (RecordedFrame recorded; ring.pop(recorded);) {
    file_.append(candump_line(recorded, interface_, epoch_));
  }
  file_.write_out();
}

}  // namespace ivo::firmware
