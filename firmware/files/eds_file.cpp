#include "firmware/files/eds_file.hpp"

#include <utility>

#include "drivers/eds/dictionary_check_text.hpp"
#include "drivers/eds/eds_error_text.hpp"
#include "drivers/eds/eds_reader.hpp"
#include "drivers/sim/sim_objects.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {

Result<std::unique_ptr<drivers::EdsDictionary>> read_eds_file(const std::string& path) {
  const Result<std::string> text = read_file(path);
  if (!text) {
    return text.error();
  }
  auto dictionary = std::make_unique<drivers::EdsDictionary>();
  if (const auto error = drivers::read_eds(text.value(), *dictionary)) {
    return Error{path + ":" + std::to_string(error->line) + ": " + drivers::describe(*error)};
  }
  return dictionary;
}

Result<std::unique_ptr<drivers::EdsDictionary>> read_simulated_eds(const std::string& path) {
  Result<std::unique_ptr<drivers::EdsDictionary>> dictionary = read_eds_file(path);
  if (!dictionary) {
    return dictionary;
  }
  if (const auto unfit = drivers::sim_unfit(*dictionary.value())) {
    if (unfit->too_many) {
      return Error{path + ": more objects than a simulated drive holds; expected at most " +
                   std::to_string(drivers::ObjectDictionary::kEntries) + ", of which " +
                   std::to_string(drivers::ObjectDictionary::kLongObjects) + " longer than four bytes"};
    }
    return Error{path + ": no object " + drivers::text_of(unfit->missing) +
                 " that is a number; expected it of a wheel drive that is to be simulated"};
  }
  return dictionary;
}

Result<void> check_drive_eds(const Robot& robot, Wheel wheel) {
  const DriveParameters& drive = robot.drives[static_cast<std::size_t>(wheel)];
  if (drive.eds.empty()) {
    return {};
  }
  const Result<std::unique_ptr<drivers::EdsDictionary>> dictionary = read_eds_file(drive.eds);
  if (!dictionary) {
    return dictionary.error();
  }
  const drivers::DictionaryFindings findings =
      drivers::check_dictionary(*dictionary.value(), drivers::startup_steps(robot, wheel), drive.node_id);
  if (findings.empty()) {
    return {};
  }
  const std::string more =
      findings.size() > 1 ? " (and " + std::to_string(findings.size() - 1) + " more findings)" : "";
  return Error{drive.eds + ": " + drivers::describe(findings[0]) + more};
}

}  // namespace ivo::firmware
