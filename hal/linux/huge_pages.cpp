#include "hal/linux/huge_pages.hpp"

#include <sys/mman.h>

#include <memory>

namespace ivo::hal {

void prefer_huge_pages(void* object, std::size_t bytes) noexcept {
  constexpr std::size_t kPage = std::size_t{2} << 20U;
  void* begin = object;
  if (std::align(kPage, kPage, begin, bytes) != nullptr) {
    (void)madvise(begin, bytes / kPage * kPage, MADV_HUGEPAGE);
  }
}

}  // namespace ivo::hal
