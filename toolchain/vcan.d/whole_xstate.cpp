// Preloaded into user-mode Linux on a processor with AMX. It sets a process's vector registers by the first 2696 bytes
// of them, which is all that processors had when it was written; a kernel with more refuses a part (EFAULT). Here the
// part becomes the whole, with the rest as the process has it.
#include <dlfcn.h>
#include <elf.h>
#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstddef>

namespace {

using Ptrace = long (*)(int request, pid_t process, void* address, void* data);

std::array<std::byte, 65536> whole;  // user-mode Linux's kernel is one thread

long set_part(Ptrace real, pid_t process, void* which, const iovec& part) {
  iovec all{whole.data(), whole.size()};
  if (real(PTRACE_GETREGSET, process, which, &all) < 0) {
    return -1;
  }
  if (part.iov_len >= all.iov_len) {
    errno = EFAULT;
    return -1;
  }
  std::copy_n(static_cast<const std::byte*>(part.iov_base), part.iov_len, whole.begin());
  return real(PTRACE_SETREGSET, process, which, &all);
}

}  // namespace

extern "C" long ptrace(enum __ptrace_request request, ...) noexcept {
  static const auto real = reinterpret_cast<Ptrace>(dlsym(RTLD_NEXT, "ptrace"));
  va_list arguments;
  va_start(arguments, request);
  const pid_t process = va_arg(arguments, pid_t);
  void* const address = va_arg(arguments, void*);
  void* const data = va_arg(arguments, void*);
  va_end(arguments);
  const long done = real(request, process, address, data);
  if (done < 0 && errno == EFAULT && request == PTRACE_SETREGSET && address == reinterpret_cast<void*>(NT_X86_XSTATE)) {
    return set_part(real, process, address, *static_cast<const iovec*>(data));
  }
  return done;
}
