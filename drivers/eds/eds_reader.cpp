#include "drivers/eds/eds_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "drivers/eds/eds_entry.hpp"
#include "drivers/eds/eds_lines.hpp"
#include "drivers/eds/eds_number.hpp"
#include "drivers/eds/eds_section.hpp"
#include "drivers/eds/eds_structure.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint8_t kMostSubs = 0xFE;

}  // namespace

class EdsReader {
 public:
  explicit EdsReader(EdsDictionary& into) noexcept : into_(into) { into_.clear(); }

  std::optional<EdsError> read(std::string_view text) noexcept {
    EdsLines lines(text);
    for (EdsLine line = lines.next(); line.kind != EdsLine::Kind::kEnd && ok(); line = lines.next()) {
      if (line.kind == EdsLine::Kind::kSection) {
        begin(line);
      } else {
        take(line);
      }
    }
    if (ok() && lines.error().has_value()) {
      error_ = lines.error();
      error_->section = ShortString<40>(section_name_);
    }
    if (ok()) {
      end_section();
    }
    if (ok()) {
      std::sort(into_.objects_.begin(), into_.objects_.end(), before);
      error_ = structure_.error(into_.objects());
    }
    return error_;
  }

 private:
  [[nodiscard]] bool ok() const noexcept { return !error_.has_value(); }

  void fail(EdsProblem problem, std::uint32_t line, ShortString<40> section, std::uint64_t number = 0) noexcept {
    if (ok()) {
      error_ = EdsError{.problem = problem,
                        .line = line,
                        .section = section,
                        .key = {},
                        .found = {},
                        .type = DataType::kNone,
                        .number = number};
    }
  }
  void fail_here(EdsProblem problem, const EdsLine& line, std::uint64_t number = 0) noexcept {
    fail(problem, line.number, ShortString<40>(section_name_), number);
    error_->key = ShortString<40>(line.name);
    error_->found = ShortString<60>(line.value);
  }
  void take_error(const EdsEntryReader& reader) noexcept {
    if (ok() && reader.error().has_value()) {
      error_ = reader.error();
      error_->section = ShortString<40>(section_name_);
    }
  }

  void begin(const EdsLine& line) noexcept {
    end_section();
    section_ = eds_section(line.name);
    section_name_ = line.name;
    section_line_ = line.number;
    fields_.clear();
    announced_.reset();
    listed_before_ = structure_.listed();
    if (section_.kind == SectionKind::kValueTable) {
      fail(EdsProblem::kCompactValues, line.number, ShortString<40>(line.name));
    }
    std::uint32_t& first = single_lines_[static_cast<std::size_t>(section_.kind)];
    if (section_.is_single() && first != 0) {
      fail(EdsProblem::kDuplicateSection, line.number, ShortString<40>(line.name), first);
    }
    first = line.number;
  }

  void take(const EdsLine& line) noexcept {
    switch (section_.kind) {
      case SectionKind::kNone:
        fail_here(EdsProblem::kKeyOutsideSection, line);
        break;
      case SectionKind::kDummyUsage:
        take_dummy(line);
        break;
      case SectionKind::kMandatoryObjects:
      case SectionKind::kOptionalObjects:
      case SectionKind::kManufacturerObjects:
        take_listed(line);
        break;
      case SectionKind::kDeviceInfo:
      case SectionKind::kObject:
      case SectionKind::kSub:
        if (const std::uint32_t first = fields_.take(line); first != 0) {
          fail_here(EdsProblem::kDuplicateKey, line, first);
        }
        break;
      case SectionKind::kForeign:
      case SectionKind::kValueTable:
        break;
    }
  }

  /// Dummy0005=1.
  void take_dummy(const EdsLine& line) noexcept {
    constexpr std::string_view kDummy = "Dummy";
    std::uint32_t type = 0;
    if (!starts_with_word(line.name, kDummy)) {
      return;
    }
    const std::string_view digits = line.name.substr(kDummy.size());
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), type, 16);
    const EdsNumber used = eds_number(line.value, DataType::kBoolean);
    if (error != std::errc() || end != digits.data() + digits.size() || used.status == EdsNumberStatus::kNotANumber) {
      fail_here(EdsProblem::kNotANumber, line);
    } else if (type > 0x1F || used.status == EdsNumberStatus::kOutOfRange) {
      fail_here(EdsProblem::kNumberOutOfRange, line, 1);
    } else if (used.value.bits != 0) {
      into_.dummies_ |= std::uint32_t{1} << type;
    }
  }

  /// SupportedObjects=3, 1=0x1000.
  void take_listed(const EdsLine& line) noexcept {
    const bool announces = same_word(line.name, "SupportedObjects");
    const bool lists = std::all_of(line.name.begin(), line.name.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!announces && !lists) {
      return;
    }
    const EdsNumber number = eds_number(line.value, DataType::kUnsigned16);
    if (number.status == EdsNumberStatus::kNotANumber) {
      fail_here(EdsProblem::kNotANumber, line);
    } else if (number.status == EdsNumberStatus::kOutOfRange) {
      fail_here(EdsProblem::kNumberOutOfRange, line, 0xFFFF);
    } else if (announces && announced_.has_value()) {
      fail_here(EdsProblem::kDuplicateKey, line, section_line_);
    } else if (announces) {
      announced_ = number.value.bits;
    } else if (!structure_.list({static_cast<std::uint16_t>(number.value.bits), line.number})) {
      fail_here(EdsProblem::kTooManyObjects, line);
    }
  }

  void end_section() noexcept {
    if (!ok()) {
      return;
    }
    if (section_.is_list()) {
      const std::size_t count = structure_.listed() - listed_before_;
      if (announced_.value_or(0) != count) {
        fail(EdsProblem::kWrongCount, section_line_, ShortString<40>(section_name_), count);
        error_->key = ShortString<40>("SupportedObjects");
      }
    } else if (section_.kind == SectionKind::kDeviceInfo) {
      end_device();
    } else if (section_.kind == SectionKind::kObject) {
      end_object();
    } else if (section_.kind == SectionKind::kSub) {
      EdsEntryReader reader(fields_, section_line_);
      add(reader, reader.object_type() == EdsObjectType::kDomain);
    }
  }

  void end_device() noexcept {
    constexpr std::uint64_t kMost = 0xFFFF'FFFF;
    EdsEntryReader reader(fields_, section_line_);
    into_.device_ = {static_cast<std::uint32_t>(reader.number(EdsKey::kVendorNumber, kMost)),
                     static_cast<std::uint32_t>(reader.number(EdsKey::kProductNumber, kMost)),
                     static_cast<std::uint32_t>(reader.number(EdsKey::kRevisionNumber, kMost))};
    take_error(reader);
    const auto vendor = keep(fields_[EdsKey::kVendorName].value);
    const auto product = keep(fields_[EdsKey::kProductName].value);
    into_.vendor_name_ = vendor.at;
    into_.vendor_name_bytes_ = vendor.bytes;
    into_.product_name_ = product.at;
    into_.product_name_bytes_ = product.bytes;
  }

  void end_object() noexcept {
    EdsEntryReader reader(fields_, section_line_);
    EdsHead head;
    head.index = section_.address.index;
    head.type = reader.object_type();
    head.line = section_line_;
    reader.require(EdsKey::kParameterName);
    switch (head.type) {
      case EdsObjectType::kVariable:
      case EdsObjectType::kDomain:
        add(reader, head.type == EdsObjectType::kDomain);
        break;
      case EdsObjectType::kArray:
      case EdsObjectType::kRecord:
        head.compact = static_cast<std::uint8_t>(reader.number(EdsKey::kCompactSubObj, kMostSubs));
        if (head.compact == 0) {
          reader.require(EdsKey::kSubNumber);
        }
        head.subs = static_cast<std::uint16_t>(reader.number(EdsKey::kSubNumber, 0x100));
        add_compact(reader, head);
        break;
      case EdsObjectType::kNull:
      case EdsObjectType::kDefType:
      case EdsObjectType::kDefStruct:
        head.subs = static_cast<std::uint16_t>(reader.number(EdsKey::kSubNumber, 0x100));
        break;
    }
    take_error(reader);
    if (ok() && !structure_.add(head)) {
      fail(EdsProblem::kTooManyObjects, section_line_, ShortString<40>(section_name_));
    }
  }

  /// CompactSubObj=8: sub-index 0 and eight that are all as the section says.
  void add_compact(EdsEntryReader& reader, const EdsHead& head) noexcept {
    if (head.compact == 0) {
      return;
    }
    EdsObject object = reader.entry({head.index, 1}, false);
    take_error(reader);
    keep_words(object);
    EdsObject count;
    count.address = {head.index, 0};
    count.type = DataType::kUnsigned8;
    count.bytes = 1;
    count.line = section_line_;
    count.name = object.name;
    count.name_bytes = object.name_bytes;
    count.power_on = {true, false, head.compact};
    push(count);
    for (std::uint32_t sub = 1; sub <= head.compact; ++sub) {
      object.address.sub = static_cast<std::uint8_t>(sub);
      push(object);
    }
  }

  void add(EdsEntryReader& reader, bool domain) noexcept {
    EdsObject object = reader.entry(section_.address, domain);
    take_error(reader);
    keep_words(object);
    push(object);
  }

  void keep_words(EdsObject& object) noexcept {
    const auto name = keep(fields_[EdsKey::kParameterName].value);
    object.name = name.at;
    object.name_bytes = name.bytes;
    if (is_text(object.type)) {
      const EdsField& configured = fields_[EdsKey::kParameterValue];
      const auto text = keep(configured.given() ? configured.value : fields_[EdsKey::kDefaultValue].value);
      object.text = text.at;
      object.text_bytes = text.bytes;
    }
  }

  void push(const EdsObject& object) noexcept {
    if (ok() && !into_.objects_.push_back(object)) {
      fail(EdsProblem::kTooManyObjects, section_line_, ShortString<40>(section_name_));
    }
  }

  EdsDictionary::Text keep(std::string_view text) noexcept {
    const EdsDictionary::Text kept = into_.keep(text);
    if (!kept.kept) {
      fail(EdsProblem::kTooMuchText, section_line_, ShortString<40>(section_name_));
    }
    return kept;
  }

  EdsDictionary& into_;
  std::optional<EdsError> error_;
  EdsSection section_;
  std::string_view section_name_;
  std::uint32_t section_line_ = 0;
  std::array<std::uint32_t, static_cast<std::size_t>(SectionKind::kNone) + 1> single_lines_{};
  EdsFields fields_;
  std::optional<std::uint64_t> announced_;  // SupportedObjects
  std::size_t listed_before_ = 0;
  EdsStructure structure_;
};

std::optional<EdsError> read_eds(std::string_view text, EdsDictionary& into) noexcept {
  return EdsReader(into).read(text);
}

}  // namespace ivo::drivers
