#include "drivers/eds/eds_structure.hpp"

#include <algorithm>

#include "drivers/eds/eds_section.hpp"

namespace ivo::drivers {
namespace {

using Fault = std::optional<EdsError>;

EdsError fault(EdsProblem problem, std::uint32_t line, ShortString<40> section, std::uint64_t number = 0) noexcept {
  EdsError error;
  error.problem = problem;
  error.line = line;
  error.section = section;
  error.number = number;
  return error;
}

template <class T>
bool before_by_index(const T& a, const T& b) noexcept {
  return a.index != b.index ? a.index < b.index : a.line < b.line;
}

ShortString<40> name_of(std::uint16_t index) noexcept { return section_name({index, 0}, false); }

Fault wrong_variable(const EdsHead& head, std::span<const EdsObject> entries) noexcept {
  const auto sub =
      std::find_if(entries.begin(), entries.end(), [&](const EdsObject& entry) { return entry.line != head.line; });
  return sub == entries.end() ? Fault()
                              : fault(EdsProblem::kSubOfVariable, sub->line, section_name(sub->address, true));
}

Fault wrong_subs(const EdsHead& head, std::span<const EdsObject> entries) noexcept {
  if (head.compact != 0) {
    return entries.size() == head.compact + std::size_t{1}
               ? Fault()
               : fault(EdsProblem::kCompactWithSubs, head.line, name_of(head.index));
  }
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].address == entries[i - 1].address) {
      return fault(EdsProblem::kDuplicateSection, entries[i].line, section_name(entries[i].address, true),
                   entries[i - 1].line);
    }
  }
  if (entries.size() != head.subs) {
    EdsError error = fault(EdsProblem::kWrongCount, head.line, name_of(head.index), entries.size());
    error.key = ShortString<40>(name_of(EdsKey::kSubNumber));
    return error;
  }
  return entries.empty() || entries.front().address.sub == 0
             ? Fault()
             : fault(EdsProblem::kMissingSub, head.line, name_of(head.index));
}

Fault without_object(const EdsObject& entry) noexcept {
  return fault(EdsProblem::kSubWithoutObject, entry.line, section_name(entry.address, true));
}

}  // namespace

bool before(const EdsObject& a, const EdsObject& b) noexcept {
  return a.address.index != b.address.index ? a.address.index < b.address.index
         : a.address.sub != b.address.sub   ? a.address.sub < b.address.sub
                                            : a.line < b.line;
}

std::optional<EdsError> EdsStructure::error(std::span<const EdsObject> objects) noexcept {
  std::sort(heads_.begin(), heads_.end(), before_by_index<EdsHead>);
  std::sort(listed_.begin(), listed_.end(), before_by_index<EdsListed>);
  const bool without_values = objects.empty();
  if (const Fault twice = duplicate_head()) {
    return twice;
  }
  for (const EdsHead& head : heads_) {
    if (!objects.empty() && objects.front().address.index < head.index) {
      return without_object(objects.front());
    }
    std::size_t count = 0;
    while (count < objects.size() && objects[count].address.index == head.index) {
      ++count;
    }
    const std::span<const EdsObject> entries = objects.first(count);
    objects = objects.subspan(count);
    const bool variable = head.type == EdsObjectType::kVariable || head.type == EdsObjectType::kDomain;
    if (const Fault wrong = variable ? wrong_variable(head, entries) : wrong_subs(head, entries)) {
      return wrong;
    }
  }
  if (!objects.empty()) {
    return without_object(objects.front());
  }
  const Fault wrong = wrong_list();
  return wrong || !without_values ? wrong : fault(EdsProblem::kNoObjects, 0, {});
}

EdsStructure::Fault EdsStructure::duplicate_head() const noexcept {
  for (std::size_t i = 1; i < heads_.size(); ++i) {
    if (heads_[i - 1].index == heads_[i].index) {
      return fault(EdsProblem::kDuplicateSection, heads_[i].line, name_of(heads_[i].index), heads_[i - 1].line);
    }
  }
  return std::nullopt;
}

EdsStructure::Fault EdsStructure::wrong_list() const noexcept {
  const EdsHead* head = heads_.begin();
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    const EdsListed& listed = listed_[i];
    while (head != heads_.end() && head->index < listed.index) {
      ++head;
    }
    if (i > 0 && listed_[i - 1].index == listed.index) {
      return fault(EdsProblem::kListedTwice, listed.line, name_of(listed.index), listed_[i - 1].line);
    }
    if (head == heads_.end() || head->index != listed.index) {
      return fault(EdsProblem::kListedButMissing, listed.line, name_of(listed.index));
    }
  }
  return std::nullopt;
}

}  // namespace ivo::drivers
