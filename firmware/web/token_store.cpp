#include "firmware/web/token_store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "firmware/files/text_file.hpp"
#include "firmware/web/random.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::string_view kFirstLine = "ivo-console tokens 1";
constexpr std::size_t kHashDigits = 64;
constexpr std::size_t kLongestName = 40;
constexpr std::array<std::string_view, 2> kRoles{"viewer", "operator"};

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return line;
}

std::optional<Paired> paired_of(std::string_view line) {
  const std::size_t one = line.find(' ');
  const std::size_t two = one == std::string_view::npos ? one : line.find(' ', one + 1);
  if (one != kHashDigits || two == std::string_view::npos ||
      line.substr(0, one).find_first_not_of("0123456789abcdef") != std::string_view::npos) {
    return std::nullopt;
  }
  const std::optional<Role> role = role_of(line.substr(one + 1, two - one - 1));
  const std::string_view name = line.substr(two + 1);
  return role && tidy_name(name) == name
             ? std::optional(Paired{std::string(line.substr(0, one)), *role, std::string(name)})
             : std::nullopt;
}

Result<std::vector<Paired>> paired_in(const std::string& text, const std::string& path) {
  std::string_view rest = text;
  std::vector<Paired> all;
  const Error damaged{path + ":1: no list of tokens; expected the line \"" + std::string(kFirstLine) +
                      "\"; remove the file to pair every screen anew"};
  if (next_line(rest) != kFirstLine) {
    return damaged;
  }
  for (int line = 2; !rest.empty(); ++line) {
    const std::optional<Paired> paired = paired_of(next_line(rest));
    if (!paired || all.size() == TokenStore::kMost) {
      return Error{path + ":" + std::to_string(line) +
                   ": damaged; expected a hash, viewer or operator, and a name, on at most " +
                   std::to_string(TokenStore::kMost) + " lines; remove the file to pair every screen anew"};
    }
    all.push_back(*paired);
  }
  return all;
}

/// Until it is closed, no other process changes the list.
Result<hal::FileDescriptor> locked(const std::string& path) {
  hal::FileDescriptor lock(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (!lock.valid() || ::flock(lock.get(), LOCK_EX) != 0) {
    return Error{path + ": cannot be locked: " + std::strerror(errno)};
  }
  return lock;
}

std::string version_of(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) != 0
             ? ""
             : std::to_string(status.st_ino) + "." + std::to_string(status.st_mtim.tv_sec) + "." +
                   std::to_string(status.st_mtim.tv_nsec) + "." + std::to_string(status.st_size);
}

}  // namespace

std::string_view name_of(Role role) noexcept { return kRoles[static_cast<std::size_t>(role)]; }

std::optional<Role> role_of(std::string_view name) noexcept {
  const auto* const found = std::find(kRoles.begin(), kRoles.end(), name);
  return found == kRoles.end() ? std::nullopt : std::optional(static_cast<Role>(found - kRoles.begin()));
}

std::string tidy_name(std::string_view name) {
  std::string tidy;
  for (const char c : name) {
    const bool control = static_cast<unsigned char>(c) < ' ' || c == '\x7f';
    tidy += control ? ' ' : c;
  }
  if (tidy.size() > kLongestName) {
    std::size_t end = kLongestName;
    while (end > 0 && (static_cast<unsigned char>(tidy[end]) & 0xC0U) == 0x80U) {
      --end;  // no half of a character
    }
    tidy.resize(end);
  }
  tidy.erase(0, std::min(tidy.find_first_not_of(' '), tidy.size()));
  tidy.erase(tidy.find_last_not_of(' ') + 1);
  return tidy.empty() ? "a screen" : tidy;
}

Result<TokenStore> TokenStore::open(const std::string& folder) {
  if (const Result<void> made = make_folder(folder); !made) {
    return made.error();
  }
  TokenStore store(folder);
  if (const Result<void> read = store.read(); !read) {
    return read.error();
  }
  return store;
}

Result<void> TokenStore::read() {
  version_ = version_of(path_);
  if (version_.empty()) {
    paired_.clear();
    return {};
  }
  const Result<std::string> text = read_file(path_);
  if (!text) {
    return text.error();
  }
  Result<std::vector<Paired>> paired = paired_in(text.value(), path_);
  if (!paired) {
    return paired.error();
  }
  paired_ = std::move(paired).value();
  return {};
}

void TokenStore::heed_others() {
  if (version_of(path_) != version_) {
    (void)read();  // damaged meanwhile: who was known stays known
  }
}

Result<void> TokenStore::write(std::vector<Paired> after) {
  std::string text = std::string(kFirstLine) + "\n";
  for (const Paired& paired : after) {
    text += paired.hash + " " + std::string(name_of(paired.role)) + " " + paired.name + "\n";
  }
  if (const Result<void> written = write_private_file(path_, text); !written) {
    return written.error();
  }
  version_ = version_of(path_);
  paired_ = std::move(after);
  return {};
}

Result<std::string> TokenStore::add(std::string_view name, Role role) {
  const Result<hal::FileDescriptor> lock = locked(lock_path_);
  if (!lock) {
    return lock.error();
  }
  if (const Result<void> again = read(); !again) {
    return again.error();
  }
  constexpr std::size_t kTokenBytes = 32;
  const std::string token = hexadecimal(random_bytes(kTokenBytes));
  std::vector<Paired> after = paired_;
  if (after.size() == kMost) {
    after.erase(after.begin());
  }
  after.push_back({digest_of(token), role, tidy_name(name)});
  if (const Result<void> written = write(std::move(after)); !written) {
    return written.error();
  }
  return token;
}

Result<Paired> TokenStore::forget(std::string_view id) {
  const Result<hal::FileDescriptor> lock = locked(lock_path_);
  if (!lock) {
    return lock.error();
  }
  if (const Result<void> again = read(); !again) {
    return again.error();
  }
  std::vector<Paired> after = paired_;
  const auto found = std::find_if(after.begin(), after.end(), [id](const Paired& each) {
    return id.size() >= kIdDigits && each.hash.starts_with(id);
  });
  if (found == after.end()) {
    return Error{"\"" + std::string(id) + "\" is nobody's; expected the " + std::to_string(kIdDigits) +
                 " digits that ivo-console --paired shows"};
  }
  const Paired forgotten = *found;
  after.erase(found);
  if (const Result<void> written = write(std::move(after)); !written) {
    return written.error();
  }
  return forgotten;
}

bool TokenStore::holds(const Paired& paired) {
  heed_others();
  return std::any_of(paired_.begin(), paired_.end(), [&](const Paired& each) { return each.hash == paired.hash; });
}

std::optional<Paired> TokenStore::find(const std::string& token) {
  heed_others();
  const std::string hash = digest_of(token);
  std::optional<Paired> found;
  for (const Paired& paired : paired_) {
    found = same_secret(paired.hash, hash) ? std::optional(paired) : found;
  }
  return found;
}

}  // namespace ivo::firmware::web
