#include "firmware/web/random.hpp"

#include <openssl/evp.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace ivo::firmware::web {

std::string random_bytes(std::size_t count) {
  std::string bytes(count, '\0');
  std::size_t got = 0;
  while (got < count) {
    const ssize_t more = ::getrandom(bytes.data() + got, count - got, 0);
    if (more < 0 && errno != EINTR) {
      throw std::runtime_error("the kernel gives no random numbers; expected getrandom() to work");
    }
    got += more > 0 ? static_cast<std::size_t>(more) : 0;
  }
  return bytes;
}

bool same_secret(const std::string& one, const std::string& other) noexcept {
  if (one.size() != other.size()) {
    return false;
  }
  unsigned different = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    different |= static_cast<unsigned>(one[i] ^ other[i]);
  }
  return different == 0;
}

std::string hexadecimal(const std::string& bytes) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<std::uint8_t>(c);
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

std::string digest_of(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("OpenSSL gives no SHA-256; expected it to");
  }
  return hexadecimal(std::string(digest.begin(), digest.begin() + size));
}

}  // namespace ivo::firmware::web
