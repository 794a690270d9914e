#include "firmware/tools/bench/can/fault_report.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/tools/bench/bench_report.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr std::size_t kColumns = 8;
using Cells = std::array<std::string, kColumns>;
constexpr std::size_t kWords = 3;  // columns of words, left-aligned, come first
const Cells kHead = {" #",           "fault",      "provoked by", "found [ms]", "told [cycles]",
                     "at rest [ms]", "of at most", "drives again"};

bool is_fault(const Record& record) { return !record.case_name.empty() && record.case_name[0] <= '9'; }

/// The records of one fault.
class Fault {
 public:
  explicit Fault(std::span<const Record> records) : records_(records) {}

  [[nodiscard]] const Record* figure(std::string_view name) const {
    const auto found = std::ranges::find(records_, name, &Record::figure);
    return found == records_.end() ? nullptr : &*found;
  }
  [[nodiscard]] std::string text(std::string_view name) const {
    const Record* const record = figure(name);
    return record == nullptr ? std::string() : record->text;
  }
  [[nodiscard]] double value(std::string_view name) const {
    const Record* const record = figure(name);
    return record == nullptr ? 0.0 : record->value.value_or(0.0);
  }
  [[nodiscard]] const std::string& name() const { return records_[0].case_name; }
  [[nodiscard]] std::string number() const { return name().substr(0, name().find(' ')); }
  [[nodiscard]] std::string what() const { return name().substr(name().find(' ') + 1); }
  [[nodiscard]] bool skipped() const { return !records_[0].value && records_[0].text.empty(); }
  [[nodiscard]] const std::string& why_skipped() const { return records_[0].figure; }
  [[nodiscard]] bool holds() const {
    return std::ranges::none_of(records_, [](const Record& record) { return record.holds == false; });
  }
  [[nodiscard]] std::span<const Record> records() const { return records_; }

 private:
  std::span<const Record> records_;
};

std::vector<Fault> faults_in(std::span<const Record> records) {
  std::vector<Fault> faults;
  for (std::size_t i = 0, end = 0; i < records.size(); i = end) {
    while (end < records.size() && records[end].case_name == records[i].case_name) {
      ++end;
    }
    faults.emplace_back(records.subspan(i, end - i));
  }
  return faults;
}

std::string drives_again(const Fault& fault) {
  if (fault.figure("goes on") != nullptr) {
    return "does not stop";
  }
  return fault.value("moves again") > 0.0 ? "yes" : "no";
}

Cells cells_of(const Fault& fault) {
  Cells cells = {fault.number(), fault.what(), fault.text("provoked by")};
  if (fault.skipped()) {
    return cells;
  }
  cells.back() = drives_again(fault);
  if (const Record* const found = fault.figure("detected")) {
    cells[3] = format("%.0f", *found->value);
  } else if (fault.figure("moves again") != nullptr) {
    cells[3] = "at start-up";
  }
  if (const Record* const told = fault.figure("told to stop")) {
    cells[4] = format("%.0f", *told->value);
  }
  if (const Record* const rest = fault.figure("at rest")) {
    cells[5] = format("%.0f", *rest->value);
    cells[6] = format("%.0f", rest->target->value);
  }
  return cells;
}

std::string line_of(const Cells& cells, const std::array<std::size_t, kColumns>& widths) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string padding(widths[i] - std::min(widths[i], cells[i].size()), ' ');
    const bool left = i > 0 && i < kWords;
    line += (i == 0 ? "" : "  ") + (left ? cells[i] + padding : padding + cells[i]);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

/// What stands below a fault's line.
std::string notes_on(const Fault& fault, const std::string& indent) {
  if (fault.skipped()) {
    return indent + fault.why_skipped() + "\n";
  }
  std::string notes = indent + "says: " + fault.text("says") + "\n";
  for (const Record& record : fault.records()) {
    if (record.holds.value_or(true)) {
      continue;
    }
    notes += indent + "MISSED: " + record.figure;
    if (record.target) {
      notes += format(" %.0f %s, expected %s %.0f", record.value.value_or(0.0), record.unit.c_str(),
                      record.target->sense == Sense::kAtMost ? "at most" : "at least", record.target->value);
    }
    notes += record.text.empty() ? "\n" : " something else than expected\n";
  }
  return notes;
}

const Fault* longest(const std::vector<Fault>& faults, std::string_view figure) {
  const auto of = [&](const Fault& fault) { return fault.value(figure); };
  const auto most = std::ranges::max_element(faults, {}, of);
  return most == faults.end() ? nullptr : &*most;
}

std::string summary_of(const std::vector<Fault>& faults) {
  std::set<std::string> numbers;
  int held = 0;
  int skipped = 0;
  double unasked = 0.0;
  for (const Fault& fault : faults) {
    numbers.insert(fault.number());
    skipped += fault.skipped() ? 1 : 0;
    held += !fault.skipped() && fault.holds() ? 1 : 0;
    unasked += fault.value("moved unasked");
  }
  const int all = static_cast<int>(faults.size());
  std::string text = format(
      "%d rows of %zu faults: %d hold, %d missed, %d skipped; %.0f frames or cycles of motion that "
      "nobody asked for",
      all, numbers.size(), held, all - held - skipped, skipped, unasked);
  if (const Fault* const slowest = longest(faults, "detected")) {
    text += format("\nlatest found: %.0f ms, %s", slowest->value("detected"), slowest->name().c_str());
  }
  if (const Fault* const farthest = longest(faults, "at rest")) {
    text += format("\nlongest to rest: %.0f ms, %s", farthest->value("at rest"), farthest->name().c_str());
  }
  return text + "\n";
}

std::string fault_table_of(std::span<const Record> records) {
  const std::vector<Fault> faults = faults_in(records);
  std::vector<Cells> rows = {kHead};
  std::ranges::transform(faults, std::back_inserter(rows), cells_of);
  std::array<std::size_t, kColumns> widths{};
  for (const Cells& cells : rows) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      widths[i] = std::max(widths[i], cells[i].size());
    }
  }
  std::string text =
      "faults: " + records[0].clock +
      "; found and at rest since the provocation, told to stop since found; says: what the operator reads\n" +
      line_of(rows[0], widths);
  for (std::size_t i = 0; i < faults.size(); ++i) {
    text += line_of(rows[i + 1], widths) + notes_on(faults[i], std::string(widths[0] + 4, ' '));
  }
  return text + "\n" + summary_of(faults);
}

}  // namespace

std::string table_with_faults(std::span<const Record> records) {
  std::vector<Record> others;
  std::vector<Record> faults;
  for (const Record& record : records) {
    (is_fault(record) ? faults : others).push_back(record);
  }
  const std::string text = others.empty() ? std::string() : table_of(others);
  return faults.empty() ? text : text + (text.empty() ? "" : "\n") + fault_table_of(faults);
}

}  // namespace ivo::firmware::bench
