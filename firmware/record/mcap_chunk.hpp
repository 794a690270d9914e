// Messages of an MCAP file that are written together, and where each of them is: what a reader needs to open a file
// that is larger than its memory.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace ivo::firmware {

/// Not compressed.
class McapChunk {
 public:
  /// `message`: its record, whole.
  void add(std::uint16_t channel, std::uint64_t at_ns, std::string_view message);

  struct Written {
    std::string data;         ///< a Chunk and its MessageIndexes, for the file
    std::string index;        ///< its ChunkIndex, for the summary
    std::uint64_t holds = 0;  ///< messages
  };
  /// `at`: where in the file it goes. Empty after that.
  [[nodiscard]] Written take(std::uint64_t at);

  [[nodiscard]] bool empty() const noexcept { return messages_.empty(); }
  [[nodiscard]] std::size_t bytes() const noexcept { return messages_.size(); }
  /// From its first message to its last; messages come in their order of time.
  [[nodiscard]] std::uint64_t lasts_ns() const noexcept { return last_ns_ - first_ns_; }

 private:
  std::string messages_;
  std::map<std::uint16_t, std::string> places_;  // of each channel's messages: time and offset
  std::uint64_t holds_ = 0;
  std::uint64_t first_ns_ = 0;
  std::uint64_t last_ns_ = 0;
};

}  // namespace ivo::firmware
