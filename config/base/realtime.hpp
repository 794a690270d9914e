// IVO_REALTIME marks a function that neither waits nor takes memory, whatever it calls: what a cycle runs. It stands
// after noexcept, in the declaration:
//
//   void cycle(Instant now) noexcept IVO_REALTIME;
//
// In the preset `rtsan` (clang's RealtimeSanitizer) a program that allocates, locks or waits within such a function
// ends and says where. Elsewhere the mark tells the reader alone.
#pragma once

#ifdef __has_feature
#if __has_feature(realtime_sanitizer)
#define IVO_RTSAN 1
#endif
#endif

#ifdef IVO_RTSAN
#define IVO_REALTIME [[clang::nonblocking]]
extern "C" {
void __rtsan_disable(void);
void __rtsan_enable(void);
}
#else
#define IVO_REALTIME
#endif

namespace ivo {

/// While one lives, RealtimeSanitizer looks away on this thread: for a call that it takes for one that may wait. Each
/// use is an exemption; it says why the call does not.
class KnownNotToWait {
 public:
#ifdef IVO_RTSAN
  KnownNotToWait() noexcept { __rtsan_disable(); }
  ~KnownNotToWait() { __rtsan_enable(); }
#else
  KnownNotToWait() noexcept {}
  ~KnownNotToWait() {}
#endif
  KnownNotToWait(const KnownNotToWait&) = delete;
  KnownNotToWait& operator=(const KnownNotToWait&) = delete;
};

}  // namespace ivo
