// A file that grows by whole records: lines, packets. What every record of a run has in common.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.hpp"

namespace ivo::firmware {

/// Outside the loop: every call may wait for the disk. A program that is killed loses only what was not written out.
/// When the disk refuses, the file ends with the last whole record that it took; close() says so.
class RecordFile {
 public:
  struct Kind {
    const char* record;  ///< "record": what the file is
    const char* of;      ///< "frames": what it holds
  };

  /// What becomes of a file of the same kind that is there already.
  enum class Earlier : std::uint8_t {
    kReplaced,
    kSetAside,  ///< run.log goes to run.previous.log, or run.previous-2.log where that is taken; an empty one is
                ///< replaced
  };

  /// A new file at `path`, held from now on; what is there and begins otherwise is refused: a slip of the keyboard must
  /// not cost a mission. What is there is replaced by the first write_out(); without one it stays as it was.
  /// `begins`: the first bytes of every such file, which the caller appends.
  [[nodiscard]] static Result<RecordFile> create(const std::string& path, std::string_view begins, const Kind& kind,
                                                 Earlier earlier);
  RecordFile(RecordFile&& other) noexcept;
  RecordFile& operator=(RecordFile&&) = delete;
  ~RecordFile();

  /// One record, kept whole; it holds so many of what the file holds. Written out when enough has come together.
  void append(std::string_view record, std::uint64_t holds = 1);
  /// Hands all to the system.
  void write_out();

  /// Fails when something is not in the file, and says how much. `lost_before`: what never got here. Nothing may be
  /// appended after it.
  [[nodiscard]] Result<void> close(std::uint64_t lost_before);

  /// What the file holds, of what is written out.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Bytes handed in since the beginning.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  /// "run.log", or "run.log, the one before in run.previous.log"
  [[nodiscard]] std::string where() const;

 private:
  struct End {
    std::size_t at;       // in buffer_
    std::uint64_t holds;  // the record that ends here
  };

  RecordFile(int fd, std::string path, const Kind& kind, Earlier earlier)
      : fd_(fd), path_(std::move(path)), kind_(kind), earlier_(earlier) {}
  [[nodiscard]] bool begin();
  void cut(std::size_t taken);
  bool close_file() noexcept;

  int fd_;
  std::string path_;
  std::string set_aside_;  // where the earlier one is; empty: there was none, or it was replaced
  Kind kind_;
  Earlier earlier_;
  bool is_new_ = false;    // nothing was there
  bool begun_ = false;     // what was there is replaced
  std::string buffer_;     // not written yet
  std::vector<End> ends_;  // of the records in it
  std::uint64_t count_ = 0;
  std::uint64_t missing_ = 0;
  std::uint64_t bytes_ = 0;
  int failure_ = 0;  // errno of the write that ended the record
};

}  // namespace ivo::firmware
