// The EDS reader on any bytes, and what is built on what it accepts: the check against start-up, the simulated drive.
//
// An input that begins with NUL is no file but a change of the shipped one: where (2 bytes), how many bytes go (1), and
// what comes in their place.
#include <algorithm>
#include <string>

#include "drivers/eds/dictionary_check.hpp"
#include "drivers/eds/dictionary_check_text.hpp"
#include "drivers/eds/eds_error_text.hpp"
#include "drivers/eds/eds_reader.hpp"
#include "drivers/eds/shipped_eds.hpp"
#include "drivers/sim/sim_drive.hpp"
#include "drivers/sim/sim_objects.hpp"
#include "drivers/startup_steps.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo;
using fuzz::require;

std::string text_of(fuzz::Input& input) {
  std::string text(drivers::ivo_drive_eds_text());
  const std::size_t at = input.take<std::uint16_t>() % text.size();
  const std::size_t gone = input.byte();
  const auto in_its_place = input.rest();
  text.replace(at, gone, reinterpret_cast<const char*>(in_its_place.data()), in_its_place.size());
  return text;
}

bool one_line(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

bool fits(const drivers::EdsValue& value, drivers::DataType type) {
  if (!value.given || value.plus_node) {
    return true;
  }
  if (drivers::is_signed(type)) {
    const auto number = static_cast<std::int64_t>(value.bits);
    return number >= drivers::least_of(type) && number <= static_cast<std::int64_t>(drivers::most_of(type));
  }
  return !drivers::is_unsigned(type) || value.bits <= drivers::most_of(type);
}

void judge(const drivers::EdsDictionary& eds) {
  require(!eds.objects().empty(), "a dictionary without objects is refused");
  const drivers::EdsObject* before = nullptr;
  for (const drivers::EdsObject& object : eds.objects()) {
    const auto rank = [](const drivers::EdsObject& of) { return of.address.index * 256 + of.address.sub; };
    require(before == nullptr || rank(*before) < rank(object), "objects are in order, and none is there twice");
    before = &object;
    require(eds.find(object.address) == &object, "what is there is found");
    require(eds.has_index(object.address.index), "and its index is known");
    require(object.bytes == drivers::bytes_of(object.type), "a value has the bytes of its type");
    require(eds.name_of(object).size() <= drivers::EdsDictionary::kStringBytes, "a name is kept short");
    require(eds.text_of(object).size() <= drivers::EdsDictionary::kStringBytes, "and so is a string");
    require(fits(object.power_on, object.type) && fits(object.low, object.type) && fits(object.high, object.type),
            "a number fits its type");
  }
}

void start_up(const drivers::EdsDictionary& eds) {
  static const Robot robot;
  static const drivers::StartupSteps steps = drivers::startup_steps(robot, Wheel::kFrontLeft);
  for (const drivers::DictionaryFinding& finding : drivers::check_dictionary(eds, steps, robot.drives[0].node_id)) {
    require(one_line(drivers::describe(finding)), "a finding is one line");
  }
}

/// All that the drive has is read, and written back: what a drive's own dictionary says must not break it.
void simulate(const drivers::EdsDictionary& eds) {
  const DriveParameters parameters = Robot{}.drives[0];
  drivers::SimDrive drive(parameters, drivers::SimScript(), eds);
  drivers::SimDrive::Outbox out;
  drive.open(out);
  const auto request = static_cast<std::uint16_t>(0x600 + parameters.node_id);
  for (const drivers::EdsObject& object : eds.objects()) {
    out.clear();
    drive.on_frame(drivers::sdo_frame(request, {drivers::sdo_command::kUpload, object.address, 0}), out);
    require(out.size() <= drivers::SimDrive::kFramesPerCall, "one request has no more answers than it may");
    if (out.empty() || out[0].size != 8 || (out[0].data[0] & 0xE2) != 0x42) {
      continue;  // not an expedited answer
    }
    hal::CanFrame write = out[0];  // the number that was read, with the bytes that it has
    write.id = request;
    write.data[0] = static_cast<std::uint8_t>(0x20 | (write.data[0] & 0x0F));
    out.clear();
    drive.on_frame(write, out);
  }
  out.clear();
  drive.on_frame({.id = 0x000, .size = 2, .data = {1, 0}}, out);
  for (int cycle = 0; cycle < 10; ++cycle) {
    out.clear();
    drive.on_frame({.id = 0x080, .size = 0, .data = {}}, out);
    drive.advance_to(drive.now() + std::chrono::milliseconds(2), out);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static drivers::EdsDictionary eds;
  fuzz::Input input(data, size);
  std::string text(reinterpret_cast<const char*>(data), size);
  if (size > 0 && data[0] == 0) {
    (void)input.byte();
    text = text_of(input);
  }
  if (const auto error = drivers::read_eds(text, eds)) {
    require(one_line(drivers::describe(*error)), "a refusal is one line");
    require(error->line <= 1 + std::ranges::count(text, '\n'), "a refusal names a line that there is");
    return 0;
  }
  judge(eds);
  start_up(eds);
  if (!drivers::sim_unfit(eds)) {
    simulate(eds);
  }
  return 0;
}
