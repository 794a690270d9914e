// What one check of a robot's PC found.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ivo::firmware::doctor {

enum class State : std::uint8_t {
  kOk,
  kWarning,     ///< the robot can be run, worse than it need be
  kFault,       ///< the robot should not be run before it is mended
  kNotChecked,  ///< nothing could be seen, or nobody asked for it
};

struct Finding {
  std::string check;  ///< "clock source": two or three words
  State state = State::kNotChecked;
  std::string found;     ///< what is so, with its figure; of kNotChecked why nothing is known
  std::string remedy{};  ///< one line that can be typed or looked up; empty where nothing is to be done
};

struct Group {
  std::string name;  ///< "Kernel"
  std::vector<Finding> findings;
};

[[nodiscard]] inline Finding ok(std::string check, std::string found) {
  return {std::move(check), State::kOk, std::move(found)};
}
[[nodiscard]] inline Finding warning(std::string check, std::string found, std::string remedy) {
  return {std::move(check), State::kWarning, std::move(found), std::move(remedy)};
}
[[nodiscard]] inline Finding fault(std::string check, std::string found, std::string remedy) {
  return {std::move(check), State::kFault, std::move(found), std::move(remedy)};
}
[[nodiscard]] inline Finding not_checked(std::string check, std::string why) {
  return {std::move(check), State::kNotChecked, std::move(why)};
}

}  // namespace ivo::firmware::doctor
