#include "hal/linux/huge_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace ivo::hal {

void prefer_huge_pages(void* object, std::size_t bytes) noexcept {
  constexpr std::uintptr_t kPage = 4096;
  const auto first = reinterpret_cast<std::uintptr_t>(object);
  const std::uintptr_t begin = (first + kPage - 1) / kPage * kPage;
  const std::uintptr_t end = (first + bytes) / kPage * kPage;
  if (begin < end) {
    (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  }
}

}  // namespace ivo::hal
