// malloc and its kin, replaced for the whole program: they hand on to glibc's own, save within a NoHeap of this thread.
#include "tests/support/heap_trap.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <utility>

extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT(bugprone-reserved-identifier): glibc's names
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* memory, std::size_t size);            // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void* memory);                                  // NOLINT(bugprone-reserved-identifier)
}

namespace {

thread_local int trapped = 0;

void refuse_if_trapped(const char* call) {
  if (trapped == 0) {
    return;
  }
  trapped = 0;
  for (const char* text : {"heap trap: ", call, " was called where nothing may use the heap\n"}) {
    if (write(STDERR_FILENO, text, std::strlen(text)) < 0) {
      break;
    }
  }
  std::abort();
}

}  // namespace

namespace ivo::test {

NoHeap::NoHeap() noexcept { ++trapped; }
NoHeap::~NoHeap() { --trapped; }

HeapAgain::HeapAgain() noexcept : held_(std::exchange(trapped, 0)) {}
HeapAgain::~HeapAgain() { trapped = held_; }

}  // namespace ivo::test

extern "C" {

void* malloc(std::size_t size) {
  refuse_if_trapped("malloc");
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  refuse_if_trapped("calloc");
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  refuse_if_trapped("realloc");
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  refuse_if_trapped("memalign");
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  refuse_if_trapped("aligned_alloc");
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  refuse_if_trapped("posix_memalign");
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
// To give memory back is as bounded or unbounded as to take it.
void free(void* memory) {
  if (memory != nullptr) {
    refuse_if_trapped("free");
  }
  __libc_free(memory);
}

}  // extern "C"
