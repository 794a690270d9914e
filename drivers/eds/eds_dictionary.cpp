#include "drivers/eds/eds_dictionary.hpp"

#include <algorithm>

namespace ivo::drivers {
namespace {

std::uint32_t key(ObjectAddress address) noexcept { return std::uint32_t{address.index} << 8 | address.sub; }

}  // namespace

bool EdsObject::mappable_into(bool received) const noexcept {
  if (!mappable || bytes == 0) {
    return false;
  }
  switch (access) {
    case EdsAccess::kReadWrite:
      return true;
    case EdsAccess::kWriteOnly:
    case EdsAccess::kReadWriteRpdo:
      return received;
    case EdsAccess::kReadOnly:
    case EdsAccess::kConst:
    case EdsAccess::kReadWriteTpdo:
      return !received;
  }
  return false;
}

void EdsDictionary::clear() noexcept {
  objects_.clear();
  device_ = {};
  dummies_ = 0;
  vendor_name_ = product_name_ = 0;
  vendor_name_bytes_ = product_name_bytes_ = 0;
  text_used_ = 0;
}

const EdsObject* EdsDictionary::find(ObjectAddress address) const noexcept {
  const auto* const at =
      std::lower_bound(objects_.begin(), objects_.end(), address,
                       [](const EdsObject& object, ObjectAddress a) { return key(object.address) < key(a); });
  return at != objects_.end() && at->address == address ? at : nullptr;
}

bool EdsDictionary::has_index(std::uint16_t index) const noexcept {
  const auto* const at =
      std::lower_bound(objects_.begin(), objects_.end(), index,
                       [](const EdsObject& object, std::uint16_t i) { return object.address.index < i; });
  return at != objects_.end() && at->address.index == index;
}

bool EdsDictionary::dummy(DataType type) const noexcept {
  const auto number = static_cast<std::uint16_t>(type);
  return number < 32 && (dummies_ >> number & 1) != 0;
}

std::string_view EdsDictionary::name_of(const EdsObject& object) const noexcept {
  return part(object.name, object.name_bytes);
}

std::string_view EdsDictionary::text_of(const EdsObject& object) const noexcept {
  return part(object.text, object.text_bytes);
}

EdsDictionary::Text EdsDictionary::keep(std::string_view text) noexcept {
  text = text.substr(0, kStringBytes);
  if (kTextBytes - text_used_ < text.size()) {
    return {};
  }
  const Text kept{static_cast<std::uint32_t>(text_used_), static_cast<std::uint8_t>(text.size()), true};
  std::copy(text.begin(), text.end(), text_.begin() + static_cast<std::ptrdiff_t>(text_used_));
  text_used_ += text.size();
  return kept;
}

}  // namespace ivo::drivers
