#include "firmware/tools/bench/guest.hpp"

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

/// A folder that the guest writes to and the host reads, gone with this.
class SharedFolder {
 public:
  SharedFolder() : made_(mkdtemp(path_.data()) != nullptr) {}
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  ~SharedFolder() {
    if (made_) {
      std::error_code ignored;
      fs::remove_all(path_, ignored);
    }
  }
  [[nodiscard]] bool made() const noexcept { return made_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  std::string path_ = "/var/tmp/ivo-bench.XXXXXX";
  bool made_;
};

/// Empty when it is in no folder above `program`.
fs::path script_above(const fs::path& program, const char* name) {
  for (fs::path folder = program.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    if (fs::path script = folder / "toolchain" / name; access(script.c_str(), X_OK) == 0) {
      return script;
    }
    if (folder == folder.root_path()) {
      break;
    }
  }
  return {};
}

}  // namespace

bool owns_network() { return std::getenv("IVO_OWN_NETWORK") != nullptr; }

bool counts_instructions() {
  return std::getenv("IVO_OWN_CLOCK") != nullptr && access("/sys/kernel/realtime", F_OK) == 0;
}

const char* clock_of_this_kernel() noexcept {
  if (counts_instructions()) {
    return "a model of time (PREEMPT_RT guest, 2 ns an instruction)";
  }
  return std::getenv("IVO_OWN_CLOCK") != nullptr ? "CLOCK_MONOTONIC of a user-mode Linux guest"
                                                 : "CLOCK_MONOTONIC of this machine";
}

Result<std::vector<Record>> records_from_guest(Guest guest, const std::string& bench, const Options& options) {
  const char* const name = guest == Guest::kVcan ? "vcan" : "rt";
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path script = script_above(self, name);
  if (script.empty()) {
    return Error{"no toolchain/" + std::string(name) +
                 " in a folder above this program, which would give it a guest of its own"};
  }
  const SharedFolder folder;
  if (!folder.made()) {
    return Error{folder.path() + " cannot be made"};
  }
  const std::string kept = folder.path() + "/records.json";
  std::vector<std::string> words;
  if (guest == Guest::kRealTime) {  // its files are its own; it hands back those of the folder that it starts in
    words = {"-t", "900", "-o", folder.path()};
  }
  const std::string written = guest == Guest::kRealTime ? "records.json" : kept;
  words.insert(words.end(), {self.string(), "bench", bench, "--json", written});
  if (options.quick) {
    words.emplace_back("--quick");
  }
  if (const Result<std::string> ran = output_of(script.string(), words, SIGTERM); !ran) {
    return Error{ran.error().message + ", what it said is above; expected a guest of its own by it"};
  }
  const Result<std::string> text = read_file(kept);
  return text ? records_of(text.value(), kept) : Result<std::vector<Record>>(text.error());
}

}  // namespace ivo::firmware::bench
