// Between construction and destruction of a NoHeap, whoever asks the heap for memory ends the program by name. Only in
// programs of the preset `noheap`, where malloc itself is replaced (heap_trap.cpp); elsewhere it does nothing.
#pragma once

namespace ivo::test {

#ifdef IVO_HEAP_TRAP
class NoHeap {
 public:
  NoHeap() noexcept;
  ~NoHeap();
  NoHeap(const NoHeap&) = delete;
  NoHeap& operator=(const NoHeap&) = delete;
};
inline constexpr bool kHeapIsTrapped = true;
#else
class NoHeap {
 public:
  NoHeap() noexcept {}
  ~NoHeap() {}
  NoHeap(const NoHeap&) = delete;
  NoHeap& operator=(const NoHeap&) = delete;
};
inline constexpr bool kHeapIsTrapped = false;
#endif

}  // namespace ivo::test
