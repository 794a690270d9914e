#include "firmware/record/mcap_file.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "firmware/record/mcap_records.hpp"

namespace ivo::firmware {
namespace {

using mcap::Op;
using mcap::put;
using mcap::record;

constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
constexpr std::uint32_t kNoChecksum = 0;
// A chunk is done at the earlier of these.
constexpr std::size_t kChunkBytes = 262'144;
constexpr std::uint64_t kChunkNs = 1'000'000'000;

std::string header() {
  std::string content;
  put(content, std::string_view());  // no profile
  put(content, std::string_view("ivo"));
  return std::string(kMcapMagic) + record(Op::kHeader, content);
}

}  // namespace

Result<McapFile> McapFile::create(const std::string& path, RecordFile::Earlier earlier) {
  const std::string begin = header();
  Result<RecordFile> file = RecordFile::create(path, begin, {.record = "log", .of = "messages"}, earlier);
  if (!file) {
    return file.error();
  }
  McapFile log(std::move(file).value());
  log.file_.append(begin, 0);
  return log;
}

McapFile::Channel McapFile::add_channel(const std::string& topic, const Schema& schema) {
  const auto known = std::find(schema_names_.begin(), schema_names_.end(), schema.name);
  const auto schema_id = static_cast<std::uint16_t>(known - schema_names_.begin() + 1);
  if (known == schema_names_.end()) {
    std::string content;
    put(content, schema_id);
    put(content, std::string_view(schema.name));
    put(content, std::string_view("jsonschema"));
    put(content, std::string_view(schema.text));
    schema_names_.push_back(schema.name);
    schemas_.push_back(record(Op::kSchema, content));
    file_.append(schemas_.back(), 0);
  }
  const auto channel = static_cast<Channel>(channels_.size());
  std::string content;
  put(content, channel);
  put(content, schema_id);
  put(content, std::string_view(topic));
  put(content, std::string_view("json"));
  put(content, std::uint32_t{0});  // no metadata
  channels_.push_back(record(Op::kChannel, content));
  counts_.push_back(0);
  file_.append(channels_.back(), 0);
  return channel;
}

void McapFile::add_message(Channel channel, Duration at, std::string_view json) {
  const auto at_ns = static_cast<std::uint64_t>(std::max<Duration::rep>(at.count(), 0));
  const bool first = std::all_of(counts_.begin(), counts_.end(), [](std::uint64_t count) { return count == 0; });
  first_ns_ = first ? at_ns : std::min(first_ns_, at_ns);
  last_ns_ = std::max(last_ns_, at_ns);
  std::string content;
  put(content, channel);
  put(content, static_cast<std::uint32_t>(counts_[channel]++));
  put(content, at_ns);  // logged
  put(content, at_ns);  // published
  content += json;
  chunk_.add(channel, at_ns, record(Op::kMessage, content));
  if (chunk_.bytes() >= kChunkBytes || chunk_.lasts_ns() >= kChunkNs) {
    end_chunk();
  }
}

void McapFile::end_chunk() {
  const McapChunk::Written written = chunk_.take(file_.bytes());
  file_.append(written.data, written.holds);
  chunk_indexes_ += written.index;
  ++chunks_;
}

std::string McapFile::statistics() const {
  std::string content;
  put(content, std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}));
  put(content, static_cast<std::uint16_t>(schemas_.size()));
  put(content, static_cast<std::uint32_t>(channels_.size()));
  put(content, std::uint32_t{0});  // attachments
  put(content, std::uint32_t{0});  // metadata
  put(content, chunks_);
  put(content, first_ns_);
  put(content, last_ns_);
  put(content, static_cast<std::uint32_t>(counts_.size() * (sizeof(Channel) + sizeof(std::uint64_t))));
  for (std::size_t channel = 0; channel < counts_.size(); ++channel) {
    put(content, static_cast<Channel>(channel));
    put(content, counts_[channel]);
  }
  return record(Op::kStatistics, content);
}

Result<void> McapFile::close(std::uint64_t lost_before) {
  if (!chunk_.empty()) {
    end_chunk();
  }
  std::string end;
  put(end, kNoChecksum);
  std::string tail = record(Op::kDataEnd, end);
  const std::uint64_t summary = file_.bytes() + tail.size();
  std::string offsets;
  const auto add_group = [&](Op op, const std::string& records) {
    if (records.empty()) {
      return;
    }
    std::string offset(1, static_cast<char>(op));
    put(offset, file_.bytes() + tail.size());
    put(offset, std::uint64_t{records.size()});
    offsets += record(Op::kSummaryOffset, offset);
    tail += records;
  };
  add_group(Op::kSchema, std::accumulate(schemas_.begin(), schemas_.end(), std::string()));
  add_group(Op::kChannel, std::accumulate(channels_.begin(), channels_.end(), std::string()));
  add_group(Op::kStatistics, statistics());
  add_group(Op::kChunkIndex, chunk_indexes_);
  std::string footer;
  put(footer, summary);
  put(footer, file_.bytes() + tail.size());
  put(footer, kNoChecksum);
  file_.append(tail + offsets + record(Op::kFooter, footer) + std::string(kMcapMagic), 0);
  return file_.close(lost_before);
}

}  // namespace ivo::firmware
