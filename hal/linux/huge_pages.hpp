// Pages of 2 MB for a large object: the planner's tables are read here and there, and a processor remembers where a
// thousand or two pages are.
#pragma once

#include <cstddef>

namespace ivo::hal {

/// Asks the kernel for them, once and before the object is first written; a kernel that has none says nothing and goes
/// on with small ones. What does not fill a large page keeps small ones.
void prefer_huge_pages(void* object, std::size_t bytes) noexcept;

}  // namespace ivo::hal
