#include "firmware/tools/bench/neighbour.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>

namespace ivo::firmware::bench {
namespace {

// Between fork and exec only calls that are safe there.
[[noreturn]] void become(const char* path, char* const* argv, int output, pid_t parent, int last_signal) {
  // A signal to this program alone, or its end by anything else, must not leave the child at work.
  const bool tied = prctl(PR_SET_PDEATHSIG, last_signal) == 0 && getppid() == parent;
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (tied && nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0) {
    (void)execv(path, argv);
  }
  _exit(127);
}

std::string read_to_end(int file) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t size = read(file, part.data(), part.size());
    if (size > 0) {
      text.append(part.data(), static_cast<std::size_t>(size));
    } else if (size == 0 || errno != EINTR) {
      return text;
    }
  }
}

}  // namespace

Result<std::string> output_of_neighbour(const std::string& name, const std::vector<std::string>& args) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string path = (self.parent_path() / name).string();
  if (error || access(path.c_str(), X_OK) != 0) {
    return Error{"no " + name + " beside this program"};
  }
  return output_of(path, args, SIGKILL);
}

Result<std::string> output_of(const std::string& path, const std::vector<std::string>& args, int last_signal) {
  const std::string name = std::filesystem::path(path).filename().string();
  std::vector<std::string> words = {path};
  words.insert(words.end(), args.begin(), args.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);

  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    return Error{name + " cannot be started: " + std::generic_category().message(errno)};
  }
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    become(path.c_str(), argv.data(), ends[1], parent, last_signal);
  }
  const int fork_error = errno;
  (void)close(ends[1]);
  if (child < 0) {
    (void)close(ends[0]);
    return Error{name + " cannot be started: " + std::generic_category().message(fork_error)};
  }
  std::string text = read_to_end(ends[0]);
  (void)close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return Error{name + (WIFEXITED(status) ? " ended with status " + std::to_string(WEXITSTATUS(status))
                                           : " was ended by signal " + std::to_string(WTERMSIG(status)))};
  }
  return text;
}

}  // namespace ivo::firmware::bench
