// How much was refused, of all connections, by cause.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/web/verdict.hpp"

namespace ivo::firmware::web {

class Refusals {
 public:
  void count(Verdict verdict) noexcept { ++by_verdict_[static_cast<std::size_t>(verdict)]; }
  void count_by_controller() noexcept { ++by_controller_; }
  void count_foreign_origin() noexcept { ++foreign_origin_; }
  void count_foreign_host() noexcept { ++foreign_host_; }
  void count_not_paired() noexcept { ++not_paired_; }
  void count_wrong_code() noexcept { ++wrong_code_; }

  [[nodiscard]] std::uint64_t of(Verdict verdict) const noexcept {
    return by_verdict_[static_cast<std::size_t>(verdict)];
  }
  [[nodiscard]] std::uint64_t by_controller() const noexcept { return by_controller_; }
  [[nodiscard]] std::uint64_t foreign_origin() const noexcept { return foreign_origin_; }
  [[nodiscard]] std::uint64_t foreign_host() const noexcept { return foreign_host_; }
  [[nodiscard]] std::uint64_t not_paired() const noexcept { return not_paired_; }
  [[nodiscard]] std::uint64_t wrong_code() const noexcept { return wrong_code_; }
  friend bool operator==(const Refusals&, const Refusals&) = default;

 private:
  std::array<std::uint64_t, kVerdicts> by_verdict_{};
  std::uint64_t by_controller_ = 0;
  std::uint64_t foreign_origin_ = 0;
  std::uint64_t foreign_host_ = 0;
  std::uint64_t not_paired_ = 0;
  std::uint64_t wrong_code_ = 0;
};

}  // namespace ivo::firmware::web
