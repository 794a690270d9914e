// What nobody can guess.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace ivo::firmware::web {

/// So many bytes of the kernel's randomness. Waits for it only in the first seconds of a machine's life.
[[nodiscard]] std::string random_bytes(std::size_t count);
/// A source of them that a test can choose.
using RandomSource = std::function<std::string(std::size_t)>;

/// Whether they are the same, in a time that depends on their lengths alone.
[[nodiscard]] bool same_secret(const std::string& one, const std::string& other) noexcept;

/// "09af..", two a byte.
[[nodiscard]] std::string hexadecimal(const std::string& bytes);

/// SHA-256, as hexadecimal.
[[nodiscard]] std::string digest_of(const std::string& bytes);

}  // namespace ivo::firmware::web
