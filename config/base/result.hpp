// A value, or one line that says why there is none. For start-up only: the loop uses statuses and counters.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "config/base/contract.hpp"

namespace ivo {

/// One line for a person: what was wrong, where, and what was expected. No full stop, no line break.
struct Error {
  std::string message;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : outcome_(std::move(value)) {}      // NOLINT(google-explicit-constructor): `return value;`
  Result(Error error) : outcome_(std::move(error)) {}  // NOLINT(google-explicit-constructor): `return Error{...};`

  [[nodiscard]] bool ok() const noexcept { return outcome_.index() == 0; }
  explicit operator bool() const noexcept { return ok(); }

  [[nodiscard]] T& value() & {
    IVO_CONTRACT(ok());
    return *std::get_if<0>(&outcome_);
  }
  [[nodiscard]] const T& value() const& {
    IVO_CONTRACT(ok());
    return *std::get_if<0>(&outcome_);
  }
  [[nodiscard]] T&& value() && {
    IVO_CONTRACT(ok());
    return std::move(*std::get_if<0>(&outcome_));
  }
  [[nodiscard]] const Error& error() const {
    IVO_CONTRACT(!ok());
    return *std::get_if<1>(&outcome_);
  }

 private:
  std::variant<T, Error> outcome_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor): `return Error{...};`

  [[nodiscard]] bool ok() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return ok(); }
  [[nodiscard]] const Error& error() const {
    IVO_CONTRACT(!ok());
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

}  // namespace ivo
