// Asks for memory that will be read soon.
#pragma once

namespace ivo::planner {

/// Elements `first` to `first + count - 1`. Cost: a cache line each 64 bytes.
template <class T>
void prefetch(const T* first, int count) noexcept {
  constexpr int kLine = 64;
  const char* const begin = reinterpret_cast<const char*>(first);
  for (int at = 0; at < count * static_cast<int>(sizeof(T)); at += kLine) {
    __builtin_prefetch(begin + at);
  }
}

}  // namespace ivo::planner
