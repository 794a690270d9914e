#include "firmware/files/json_reading.hpp"

#include "firmware/files/number_text.hpp"

namespace ivo::firmware {

std::string shown_text(const std::string& text) {
  constexpr std::size_t kMost = 200;
  if (text.size() <= kMost) {
    return "\"" + text + "\"";
  }
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
    --end;  // no half of a character
  }
  return "\"" + text.substr(0, end) + "...\"";
}

void JsonReading::fault(const std::string& field, const std::string& what) {
  if (fault_.empty()) {
    fault_ = path_ + ": " + (field.empty() ? "" : field + ": ") + what;
  }
}

const Json* JsonReading::field(const Json& object, const std::string& at, const char* key) {
  const Json* const found = object.member(key);
  if (found == nullptr) {
    fault(at + key, "missing; it must be given");
  }
  return found;
}

std::string JsonReading::text(const Json& object, const std::string& at, const char* key) {
  const Json* const value = field(object, at, key);
  if (value == nullptr || value->kind != Json::Kind::kText) {
    fault(at + key, "is no text; expected text");
    return {};
  }
  return value->text;
}

bool JsonReading::flag(const Json& object, const std::string& at, const char* key) {
  const Json* const value = field(object, at, key);
  if (value == nullptr || value->kind != Json::Kind::kFlag) {
    fault(at + key, "is no flag; expected true or false");
    return false;
  }
  return value->flag;
}

double JsonReading::number(const Json* value, const std::string& name, double least, double most) {
  if (value == nullptr || !value->is_number() || !(value->real >= least && value->real <= most)) {
    const std::string found = value != nullptr && value->is_number() ? shortest(value->real) : "this";
    fault(name, found + " will not do; expected a number, " + shortest(least) + " to " + shortest(most));
    return least;
  }
  return value->real;
}

std::uint64_t JsonReading::count(const Json& object, const std::string& at, const char* key, std::uint64_t most) {
  const Json* const value = field(object, at, key);
  if (value == nullptr || value->kind != Json::Kind::kCount || value->count > most) {
    fault(at + key, "is no count; expected a whole number, 0 to " + std::to_string(most));
    return 0;
  }
  return value->count;
}

std::size_t JsonReading::choice(const Json& object, const std::string& at, const char* key,
                                std::span<const char* const> words) {
  const std::string word = text(object, at, key);
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (word == words[i]) {
      return i;
    }
    all += (i == 0 ? "\"" : i + 1 == words.size() ? "\" or \"" : "\", \"") + std::string(words[i]);
  }
  fault(at + key, shown_text(word) + " is unknown; expected " + all + "\"");
  return 0;
}

const Json& JsonReading::list(const Json& object, const std::string& at, const char* key) {
  static const Json kEmpty = Json::list();
  const Json* const value = field(object, at, key);
  if (value == nullptr || value->kind != Json::Kind::kList || value->elements.empty()) {
    const bool empty = value != nullptr && value->kind == Json::Kind::kList;
    fault(at + key, std::string(empty ? "is empty" : "is no list") + "; expected a list of at least one");
    return kEmpty;
  }
  return *value;
}

Point JsonReading::point(const Json& value, const std::string& name) {
  constexpr double kFar = 1e6;
  if (value.kind != Json::Kind::kList || value.elements.size() != 2) {
    fault(name, "is no point; expected [x, y]");
    return {};
  }
  return {number(&value.elements[0], name, -kFar, kFar), number(&value.elements[1], name, -kFar, kFar)};
}

}  // namespace ivo::firmware
