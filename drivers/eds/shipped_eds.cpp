#include "drivers/eds/shipped_eds.hpp"

#include "config/base/contract.hpp"
#include "drivers/eds/eds_reader.hpp"

namespace ivo::drivers {
namespace {

struct Shipped {
  explicit Shipped(std::string_view text) noexcept { IVO_CONTRACT(!read_eds(text, dictionary).has_value()); }
  EdsDictionary dictionary;
};

}  // namespace

const EdsDictionary& ivo_drive_eds() noexcept {
  static const Shipped shipped(ivo_drive_eds_text());
  return shipped.dictionary;
}

const EdsDictionary& fixed_mapping_drive_eds() noexcept {
  static const Shipped shipped(fixed_mapping_drive_eds_text());
  return shipped.dictionary;
}

}  // namespace ivo::drivers
