#include "firmware/tools/bench/bench_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "firmware/files/json_reading.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

using Row = std::vector<std::string>;

constexpr std::array<const char*, 2> kSenses = {"at most", "at least"};

std::string number(double value) {
  const double size = std::abs(value);
  const int decimals = value == 0.0 || size >= 1000 ? 0 : size >= 100 ? 1 : size >= 1 ? 2 : size >= 0.01 ? 3 : 5;
  return format("%.*f", decimals, value);
}

bool skipped(const Record& record) { return !record.value && record.text.empty(); }

std::string cell_of(const Record& record) {
  if (!record.value) {
    return record.text + (record.holds.value_or(true) ? "" : " (NOT EXPECTED)");
  }
  std::string text = number(*record.value);
  if (record.target) {
    text += (record.target->sense == Sense::kAtMost ? " (<= " : " (>= ") + number(record.target->value) +
            (*record.holds ? ", holds)" : ", MISSED)");
  }
  return text;
}

std::string head_of(const Record& record) {
  return record.unit.empty() ? record.figure : record.figure + " [" + record.unit + "]";
}

// Of UTF-8.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], width_of(row[i]));
    }
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width_of(row[i]), ' ');
      line += i == 0 ? row[i] + padding : "  " + padding + row[i];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

/// Cases with a figure in common share a table; what a case does not have stays empty.
class Table {
 public:
  [[nodiscard]] bool has(const std::string& head) const {
    return !rows_.empty() && std::find(rows_[0].begin() + 1, rows_[0].end(), head) != rows_[0].end();
  }
  [[nodiscard]] bool is(const std::string& title) const { return !rows_.empty() && rows_[0][0] == title; }
  void open(const std::string& title) { rows_ = {{title}}; }
  void begin_row(const std::string& name) { rows_.push_back({name}); }
  void set(const std::string& head, const std::string& cell) {
    if (!has(head)) {
      rows_[0].push_back(head);
    }
    const auto column =
        static_cast<std::size_t>(std::find(rows_[0].begin() + 1, rows_[0].end(), head) - rows_[0].begin());
    rows_.back().resize(std::max(rows_.back().size(), column + 1));
    rows_.back()[column] = cell;
  }
  void close(std::string& text) {
    if (!rows_.empty()) {
      text += (text.empty() ? "" : "\n") + aligned(rows_);
      rows_.clear();
    }
  }

 private:
  std::vector<Row> rows_;  // the head first
};

}  // namespace

std::string table_of(std::span<const Record> records) {
  std::string text;
  Table table;
  for (std::size_t i = 0; i < records.size();) {
    const Record& first = records[i];
    if (skipped(first)) {
      table.close(text);
      text += first.case_name + ": " + first.figure + "\n";
      ++i;
      continue;
    }
    const std::string title = first.bench + (first.clock.empty() ? "" : ": " + first.clock);
    if (!table.has(head_of(first)) || !table.is(title)) {
      table.close(text);
      table.open(title);
    }
    table.begin_row(first.case_name);
    for (; i < records.size() && !skipped(records[i]) && records[i].case_name == first.case_name; ++i) {
      table.set(head_of(records[i]), cell_of(records[i]));
    }
  }
  table.close(text);
  return text;
}

std::string json_of(std::span<const Record> records) {
  Json list = Json::list();
  for (const Record& record : records) {
    Json element = {{"bench", record.bench},
                    {"case", record.case_name},
                    {"figure", record.figure},
                    {"value", json_or_null(record.value)},
                    {"unit", record.unit},
                    {"target", record.target ? Json(record.target->value) : Json()},
                    {"holds", json_or_null(record.holds)}};
    if (record.target) {
      element.members.emplace_back("sense", kSenses[static_cast<std::size_t>(record.target->sense)]);
    }
    for (const auto& [name, text] : {std::pair("text", &record.text), std::pair("clock", &record.clock)}) {
      if (!text->empty()) {
        element.members.emplace_back(name, *text);
      }
    }
    list.elements.push_back(std::move(element));
  }
  return json_text(list);
}

namespace {

std::optional<double> number_or_none(JsonReading& reading, const Json& object, const std::string& at, const char* key) {
  constexpr double kMost = 1e300;
  const Json* const value = reading.field(object, at, key);
  if (value == nullptr || value->kind == Json::Kind::kNull) {
    return std::nullopt;
  }
  return reading.number(value, at + key, -kMost, kMost);
}

Record record_in(JsonReading& reading, const Json& object, const std::string& at) {
  Record record{.bench = reading.text(object, at, "bench"),
                .case_name = reading.text(object, at, "case"),
                .figure = reading.text(object, at, "figure"),
                .value = number_or_none(reading, object, at, "value"),
                .unit = reading.text(object, at, "unit"),
                .target = std::nullopt,
                .holds = std::nullopt};
  if (const Json* const holds = object.member("holds"); holds != nullptr && holds->kind == Json::Kind::kFlag) {
    record.holds = holds->flag;
  }
  if (const std::optional<double> target = number_or_none(reading, object, at, "target"); target && record.value) {
    record.target = Target{*target, static_cast<Sense>(reading.choice(object, at, "sense", kSenses))};
  }
  for (const auto& [key, text] : {std::pair("text", &record.text), std::pair("clock", &record.clock)}) {
    if (object.member(key) != nullptr) {
      *text = reading.text(object, at, key);
    }
  }
  return record;
}

}  // namespace

Result<std::vector<Record>> records_of(const std::string& json, const std::string& path) {
  const Result<Json> document = parse_json(json, path, "a list of figures");
  if (!document) {
    return document.error();
  }
  JsonReading reading(path);
  std::vector<Record> records;
  for (std::size_t i = 0; i < document.value().elements.size() && reading.ok(); ++i) {
    records.push_back(record_in(reading, document.value().elements[i], element("", i) + "."));
  }
  if (records.empty()) {
    reading.fault("figures", "none; expected at least one");
  }
  return reading.ok() ? Result<std::vector<Record>>(records) : Result<std::vector<Record>>(reading.error());
}

}  // namespace ivo::firmware::bench
