// A log as MCAP (mcap.dev), which Foxglove and PlotJuggler open: messages in JSON, each channel with a JSON schema;
// messages in chunks that are not compressed, with a summary that counts them and says where each chunk is.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "firmware/record/mcap_chunk.hpp"
#include "firmware/record/record_file.hpp"

namespace ivo::firmware {

/// Outside the loop. A chunk is a second of messages, or 256 kB where that is less; whole ones go out with write_out().
/// The file of a killed program has all of those and no summary: the chunk that was under way is lost, so the last
/// second at most. Readers that read along read it to its end, and `mcap recover` makes it whole. The places of chunks
/// are kept for the summary: some 0.6 MB an hour.
class McapFile {
 public:
  using Channel = std::uint16_t;
  struct Schema {
    std::string name;  ///< "foxglove.Grid": those of Foxglove are drawn
    std::string text;  ///< JSON schema
  };

  /// A new file (RecordFile::create); anything there that is no log of ours is refused.
  [[nodiscard]] static Result<McapFile> create(const std::string& path,
                                               RecordFile::Earlier earlier = RecordFile::Earlier::kReplaced);

  /// A topic and what its messages are. `schema`: the text is told once for each name.
  Channel add_channel(const std::string& topic, const Schema& schema);
  void add_message(Channel channel, Duration at, std::string_view json);

  /// Of the chunks that are done.
  void write_out() { file_.write_out(); }
  /// Appends the summary.
  [[nodiscard]] Result<void> close(std::uint64_t lost_before);
  /// Messages in the file.
  [[nodiscard]] std::uint64_t messages() const noexcept { return file_.count(); }
  [[nodiscard]] std::string where() const { return file_.where(); }

 private:
  explicit McapFile(RecordFile file) : file_(std::move(file)) {}
  void end_chunk();
  [[nodiscard]] std::string statistics() const;

  RecordFile file_;
  std::vector<std::string> schemas_;  // their records, for the summary
  std::vector<std::string> schema_names_;
  std::vector<std::string> channels_;
  std::vector<std::uint64_t> counts_;  // messages of each channel, and the next one's number
  McapChunk chunk_;                    // under way
  std::string chunk_indexes_;          // of those that are done, for the summary
  std::uint32_t chunks_ = 0;
  std::uint64_t first_ns_ = 0;
  std::uint64_t last_ns_ = 0;
};

}  // namespace ivo::firmware
