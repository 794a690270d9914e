// The only file that includes nlohmann-json, which takes seconds to compile.
#include "firmware/files/json_value.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

namespace ivo::firmware {
namespace {

using Library = nlohmann::ordered_json;

Library library_of(const Json& json) {
  switch (json.kind) {
    case Json::Kind::kNull:
      break;
    case Json::Kind::kFlag:
      return json.flag;
    case Json::Kind::kCount:
      return json.count;
    case Json::Kind::kReal:
      return json.real;
    case Json::Kind::kText:
      return json.text;
    case Json::Kind::kList: {
      Library list = Library::array();
      for (const Json& element : json.elements) {
        list.push_back(library_of(element));
      }
      return list;
    }
    case Json::Kind::kObject: {
      Library object = Library::object();
      for (const auto& [name, value] : json.members) {
        object[name] = library_of(value);
      }
      return object;
    }
  }
  return nullptr;
}

Json value_of(const Library& library) {
  switch (library.type()) {
    case Library::value_t::boolean:
      return library.get<bool>();
    case Library::value_t::number_unsigned:
      return library.get<std::uint64_t>();
    case Library::value_t::number_integer:
    case Library::value_t::number_float:
      return library.get<double>();
    case Library::value_t::string:
      return library.get<std::string>();
    case Library::value_t::array: {
      Json list = Json::list();
      for (const Library& element : library) {
        list.elements.push_back(value_of(element));
      }
      return list;
    }
    case Library::value_t::object: {
      Json object = Json::of(Json::Kind::kObject);
      for (const auto& [name, value] : library.items()) {
        object.members.emplace_back(name, value_of(value));
      }
      return object;
    }
    case Library::value_t::null:
    case Library::value_t::binary:
    case Library::value_t::discarded:
      break;
  }
  return {};
}

std::string compact(const Library& json) { return json.dump(-1, ' ', false, Library::error_handler_t::replace); }

bool is_list_of_objects(const Library& json) { return json.is_array() && !json.empty() && json.front().is_object(); }

std::string lines_of(const Library& list, const std::string& indent) {
  std::string lines;
  for (const Library& element : list) {
    lines += (lines.empty() ? "\n" : ",\n") + indent + "  " + compact(element);
  }
  return "[" + lines + "\n" + indent + "]";
}

// Deeper input would run the library out of stack.
constexpr int kDeepest = 64;

bool too_deep(std::string_view text) {
  int depth = 0;
  for (const char c : text) {
    depth += (c == '[' || c == '{') ? 1 : (c == ']' || c == '}') ? -1 : 0;
    if (depth > kDeepest) {
      return true;
    }
  }
  return false;
}

/// `byte` is where the library gave up, counted from 1; beyond the text when it ended too early.
Error no_json(std::string_view text, std::size_t byte, const std::string& path, const std::string& what) {
  constexpr std::size_t kShown = 12;
  std::size_t at = std::min(byte > 0 ? byte - 1 : 0, text.size());
  const auto in_word = [&](std::size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
  };
  while (at > 0 && in_word(at) && in_word(at - 1)) {
    --at;  // it may have read a part of a word
  }
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  // A complaint is one line, and UTF-8 whatever the text is.
  std::string shown(text.substr(at, kShown));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  const std::string fault = at == text.size() ? "ends too early" : "\"" + shown + "\" cannot stand here";
  return Error{path + ":" + std::to_string(line) + ": not JSON: " + fault + "; expected " + what};
}

/// Hears of every name while the library reads.
class NameWatch {
 public:
  bool operator()(int /*depth*/, Library::parse_event_t event, const Library& parsed) {
    if (event == Library::parse_event_t::object_start) {
      names_.emplace_back();
    } else if (event == Library::parse_event_t::object_end) {
      names_.pop_back();
    } else if (event == Library::parse_event_t::key) {
      twice_ = !names_.back().insert(parsed.get<std::string>()).second || twice_;
    }
    return true;
  }
  [[nodiscard]] bool twice() const { return twice_; }

 private:
  std::vector<std::set<std::string>> names_;  // of the objects that are open
  bool twice_ = false;
};

Result<Json> parsed(std::string_view text, const std::string& path, const std::string& what,
                    const Library::parser_callback_t& watch) {
  if (too_deep(text)) {
    return Error{path + ": nested deeper than " + std::to_string(kDeepest) + " levels; expected " + what};
  }
  try {
    return value_of(Library::parse(text, watch));
  } catch (const Library::out_of_range&) {
    return Error{path + ": holds a number beyond all bounds; expected finite numbers"};
  } catch (const Library::parse_error& error) {
    return no_json(text, error.byte, path, what);
  } catch (const Library::exception&) {
    return Error{path + ": not JSON; expected " + what};
  }
}

}  // namespace

Json::Json(std::uint64_t value) : kind(Kind::kCount), count(value), real(static_cast<double>(value)) {}
Json::Json(std::string value) : kind(Kind::kText), text(std::move(value)) {}
Json::Json(Point p) : kind(Kind::kList), elements{Json(p.x_m), Json(p.y_m)} {}
Json::Json(std::initializer_list<JsonMember> value) : kind(Kind::kObject), members(value) {}

const Json* Json::member(std::string_view name) const {
  const Json* found = nullptr;
  for (const auto& [key, value] : members) {
    found = key == name ? &value : found;
  }
  return found;
}

std::string json_text(const Json& document) {
  const Library json = library_of(document);
  if (!json.is_object()) {
    return (is_list_of_objects(json) ? lines_of(json, "") : compact(json)) + "\n";
  }
  std::string text = "{";
  for (const auto& [key, value] : json.items()) {
    text += (text.size() == 1 ? "\n  " : ",\n  ") + compact(Library(key)) + ": " +
            (is_list_of_objects(value) ? lines_of(value, "  ") : compact(value));
  }
  return text + "\n}\n";
}

Result<Json> parse_json(std::string_view text, const std::string& path, const std::string& what) {
  return parsed(text, path, what, nullptr);
}

Result<Json> parse_strict_json(std::string_view text, const std::string& path, const std::string& what) {
  NameWatch watch;
  Result<Json> json = parsed(text, path, what, std::ref(watch));
  if (json && watch.twice()) {
    return Error{path + ": gives a name twice; expected " + what};
  }
  return json;
}

}  // namespace ivo::firmware
