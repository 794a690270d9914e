#include "firmware/record/mcap_chunk.hpp"

#include <algorithm>
#include <utility>

#include "firmware/record/crc32.hpp"
#include "firmware/record/mcap_records.hpp"

namespace ivo::firmware {
namespace {

constexpr std::string_view kNotCompressed;

}  // namespace

void McapChunk::add(std::uint16_t channel, std::uint64_t at_ns, std::string_view message) {
  first_ns_ = empty() ? at_ns : std::min(first_ns_, at_ns);
  last_ns_ = empty() ? at_ns : std::max(last_ns_, at_ns);
  std::string& places = places_[channel];
  mcap::put(places, at_ns);
  mcap::put(places, std::uint64_t{messages_.size()});
  messages_ += message;
  ++holds_;
}

McapChunk::Written McapChunk::take(std::uint64_t at) {
  const std::uint64_t size = messages_.size();
  std::string chunk;
  mcap::put(chunk, first_ns_);
  mcap::put(chunk, last_ns_);
  mcap::put(chunk, size);
  mcap::put(chunk, crc32(messages_));
  mcap::put(chunk, kNotCompressed);
  mcap::put(chunk, size);
  chunk += messages_;
  Written written{.data = mcap::record(mcap::Op::kChunk, chunk), .index = {}, .holds = holds_};
  const std::uint64_t chunk_size = written.data.size();

  std::string indexes;  // where the file has each channel's
  for (const auto& [channel, places] : places_) {
    mcap::put(indexes, channel);
    mcap::put(indexes, at + written.data.size());
    std::string content;
    mcap::put(content, channel);
    mcap::put(content, std::string_view(places));
    written.data += mcap::record(mcap::Op::kMessageIndex, content);
  }

  std::string index;
  mcap::put(index, first_ns_);
  mcap::put(index, last_ns_);
  mcap::put(index, at);
  mcap::put(index, chunk_size);
  mcap::put(index, std::string_view(indexes));
  mcap::put(index, written.data.size() - chunk_size);
  mcap::put(index, kNotCompressed);
  mcap::put(index, size);
  mcap::put(index, size);
  written.index = mcap::record(mcap::Op::kChunkIndex, index);
  *this = McapChunk();
  return written;
}

}  // namespace ivo::firmware
