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
/// Within a NoHeap, for a double that stands where the heap is trapped and that no robot has.
class HeapAgain {
 public:
  HeapAgain() noexcept;
  ~HeapAgain();
  HeapAgain(const HeapAgain&) = delete;
  HeapAgain& operator=(const HeapAgain&) = delete;

 private:
  int held_;
};
#else
class NoHeap {
 public:
  NoHeap() noexcept {}
  ~NoHeap() {}
  NoHeap(const NoHeap&) = delete;
  NoHeap& operator=(const NoHeap&) = delete;
};
class HeapAgain {
 public:
  HeapAgain() noexcept {}
  ~HeapAgain() {}
  HeapAgain(const HeapAgain&) = delete;
  HeapAgain& operator=(const HeapAgain&) = delete;
};
#endif

}  // namespace ivo::test
