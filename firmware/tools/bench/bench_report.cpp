#include "firmware/tools/bench/bench_report.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "firmware/files/json_value.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

using Row = std::vector<std::string>;

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
    for (const auto& [name, text] : {std::pair("text", &record.text), std::pair("clock", &record.clock)}) {
      if (!text->empty()) {
        element.members.emplace_back(name, *text);
      }
    }
    list.elements.push_back(std::move(element));
  }
  return json_text(list);
}

}  // namespace ivo::firmware::bench
