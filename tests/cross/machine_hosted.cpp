#include <cstdio>

#include "tests/cross/machine.hpp"

namespace ivo::cross {

void print(std::string_view text) noexcept { (void)std::fwrite(text.data(), 1, text.size(), stdout); }

}  // namespace ivo::cross

int main() { return ivo::cross::run(); }
