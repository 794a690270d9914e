#include "hal/api/file_descriptor.hpp"

#include <unistd.h>

namespace ivo::hal {

void FileDescriptor::close() noexcept {
  if (const int fd = release(); fd >= 0) {
    (void)::close(fd);
  }
}

}  // namespace ivo::hal
