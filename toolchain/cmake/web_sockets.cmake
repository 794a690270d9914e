# ivo_web_sockets: libwebsockets, and OpenSSL's hashes.
pkg_check_modules(crypto REQUIRED IMPORTED_TARGET libcrypto)
add_library(ivo_web_sockets INTERFACE)
target_link_libraries(ivo_web_sockets INTERFACE PkgConfig::crypto)
if(CMAKE_CROSSCOMPILING)
  # Its development package cannot be installed beside this machine's, whose headers are the same; the library can.
  find_library(IVO_WEBSOCKETS NAMES libwebsockets.so.17 PATHS /usr/lib/aarch64-linux-gnu NO_DEFAULT_PATH REQUIRED)
  target_link_libraries(ivo_web_sockets INTERFACE ${IVO_WEBSOCKETS})
else()
  pkg_check_modules(websockets REQUIRED IMPORTED_TARGET libwebsockets)
  target_link_libraries(ivo_web_sockets INTERFACE PkgConfig::websockets)
endif()
