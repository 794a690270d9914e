// One fault in a file that is otherwise right, and what a reader says about it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "config/base/result.hpp"

namespace ivo::firmware {

/// `text` with the first `from` replaced; a test whose `from` does not occur is wrong.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "no \"" << from << "\" in the text";
    return text;
  }
  return text.replace(at, from.size(), to);
}

template <class T>
std::string message_of(const Result<T>& result) {
  return result.ok() ? "fine" : result.error().message;
}

}  // namespace ivo::firmware
