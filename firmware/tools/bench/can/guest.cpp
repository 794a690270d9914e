#include "firmware/tools/bench/can/guest.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "firmware/files/text_file.hpp"
#include "firmware/tools/bench/bench_report.hpp"
#include "firmware/tools/bench/neighbour.hpp"

namespace ivo::firmware::bench {
namespace {

namespace fs = std::filesystem;

/// A file that guest and host both see, gone with this.
class SharedFile {
 public:
  SharedFile() {
    const int file = mkstemp(path_.data());
    made_ = file >= 0;
    if (made_) {
      (void)close(file);
    }
  }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;
  ~SharedFile() {
    if (made_) {
      (void)unlink(path_.c_str());
    }
  }
  [[nodiscard]] bool made() const noexcept { return made_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  std::string path_ = "/var/tmp/ivo-bench.XXXXXX";
  bool made_ = false;
};

}  // namespace

bool owns_network() { return std::getenv("IVO_OWN_NETWORK") != nullptr; }

Result<std::vector<Record>> records_from_guest(const Options& options) {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  fs::path folder = self;
  fs::path vcan;
  do {
    folder = folder.parent_path();
    vcan = folder / "toolchain" / "vcan";
  } while (!error && access(vcan.c_str(), X_OK) != 0 && folder != folder.root_path());
  if (error || access(vcan.c_str(), X_OK) != 0) {
    return Error{"no toolchain/vcan in a folder above this program, which would give it a bus of its own"};
  }
  const SharedFile file;
  if (!file.made()) {
    return Error{file.path() + " cannot be made"};
  }
  std::vector<std::string> words = {self.string(), "bench", "can", "--json", file.path()};
  if (options.quick) {
    words.emplace_back("--quick");
  }
  if (const Result<std::string> ran = output_of(vcan.string(), words, SIGTERM); !ran) {
    return Error{ran.error().message + ", what it said is above; expected a bus of its own by it"};
  }
  const Result<std::string> text = read_file(file.path());
  return text ? records_of(text.value(), file.path()) : Result<std::vector<Record>>(text.error());
}

}  // namespace ivo::firmware::bench
