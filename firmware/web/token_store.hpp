// Who is paired: of each only a hash of its token, in a file that outlives the server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.hpp"

namespace ivo::firmware::web {

enum class Role : std::uint8_t { kViewer, kOperator };
[[nodiscard]] std::string_view name_of(Role role) noexcept;  ///< "viewer"
[[nodiscard]] std::optional<Role> role_of(std::string_view name) noexcept;

struct Paired {
  std::string hash;  ///< SHA-256 of the token, hexadecimal
  Role role{};
  std::string name;  ///< as tidy_name() makes it
};

/// What a person may call a screen: printable, on one line, at most 40 bytes, never empty.
[[nodiscard]] std::string tidy_name(std::string_view name);

class TokenStore {
 public:
  static constexpr std::size_t kMost = 64;
  static constexpr std::size_t kIdDigits = 8;  ///< of a hash, to name it by

  /// `folder`/tokens, made when it is not there. A file that is damaged is refused by name: whoever is paired would
  /// be forgotten with the next write.
  [[nodiscard]] static Result<TokenStore> open(const std::string& folder);

  /// A new token, 64 hexadecimal digits, kept nowhere but with whom it is given to. The oldest goes when there are too
  /// many. Waits for the disk, and for another process that adds one.
  [[nodiscard]] Result<std::string> add(std::string_view name, Role role);
  /// Whose it is. A token that another process has added is known at once.
  [[nodiscard]] std::optional<Paired> find(const std::string& token);
  /// The token whose hash begins with `id`, at least kIdDigits of it, counts no more. Fails when there is none.
  [[nodiscard]] Result<Paired> forget(std::string_view id);
  /// Is it still paired? Also when another process has changed the list, or removed the file.
  [[nodiscard]] bool holds(const Paired& paired);
  [[nodiscard]] const std::vector<Paired>& all() const noexcept { return paired_; }  ///< oldest first
  [[nodiscard]] std::size_t size() const noexcept { return paired_.size(); }

 private:
  explicit TokenStore(const std::string& folder) : path_(folder + "/tokens"), lock_path_(folder + "/tokens.lock") {}
  [[nodiscard]] Result<void> read();
  [[nodiscard]] Result<void> write(std::vector<Paired> after);
  void heed_others();

  std::string path_;
  std::string lock_path_;
  std::string version_;         // of the file as it was read
  std::vector<Paired> paired_;  // oldest first
};

}  // namespace ivo::firmware::web
