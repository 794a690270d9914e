// What the controller shows beyond its status, on the shelf and on its way to a client.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "firmware/console/document_sender.hpp"
#include "firmware/console/document_shelf.hpp"

namespace ivo::firmware::console {
namespace {

std::string counted(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<char>('a' + i % 23);
  }
  return bytes;
}

TEST(DocumentShelf, KnowsWhatWasNeverPutThere) {
  const DocumentShelf shelf;
  EXPECT_EQ(shelf.revision(Document::kPlan), 0U);
  EXPECT_EQ(shelf.at(Document::kPlan).bytes, nullptr);
}

TEST(DocumentShelf, CountsChangesAndNotPuts) {
  DocumentShelf shelf;
  EXPECT_TRUE(shelf.put(Document::kPlan, ""));
  EXPECT_EQ(shelf.revision(Document::kPlan), 1U) << "empty is something";
  EXPECT_TRUE(shelf.put(Document::kPlan, ""));
  EXPECT_EQ(shelf.revision(Document::kPlan), 1U);
  EXPECT_TRUE(shelf.put(Document::kPlan, "one"));
  EXPECT_TRUE(shelf.put(Document::kPlan, "one"));
  EXPECT_EQ(shelf.revision(Document::kPlan), 2U);
  EXPECT_TRUE(shelf.put(Document::kPlan, ""));
  EXPECT_EQ(shelf.revision(Document::kPlan), 3U);
  EXPECT_EQ(shelf.revision(Document::kReport), 0U) << "each counts for itself";
}

TEST(DocumentShelf, WhoHasACopyKeepsItAsItWas) {
  DocumentShelf shelf;
  (void)shelf.put(Document::kAreas, "before");
  const DocumentShelf::Copy copy = shelf.at(Document::kAreas);
  (void)shelf.put(Document::kAreas, "after");
  EXPECT_EQ(*copy.bytes, "before");
  EXPECT_EQ(*shelf.at(Document::kAreas).bytes, "after");
}

TEST(DocumentShelf, TakesSixtyFourMegabytesAndNotAByteMore) {
  DocumentShelf shelf;
  EXPECT_TRUE(shelf.put(Document::kAerial, std::string(kLargestDocument, 'x')));
  EXPECT_EQ(shelf.revision(Document::kAerial), 1U);
  EXPECT_FALSE(shelf.put(Document::kAerial, std::string(kLargestDocument + 1, 'x')));
  EXPECT_EQ(shelf.revision(Document::kAerial), 1U);
  EXPECT_EQ(shelf.at(Document::kAerial).bytes->size(), kLargestDocument) << "what was there stays";
}

class DocumentSenderTest : public testing::Test {
 protected:
  struct Heard {
    std::uint32_t revision = 0;
    std::string bytes;
    int times = 0;  // whole
  };

  /// As a client does; false when nothing came.
  bool hear() {
    const DocumentPart* const part = sender_.next(shelf_);
    if (part == nullptr) {
      return false;
    }
    EXPECT_EQ(part->header.kind, Kind::kDocumentPart);
    EXPECT_EQ(part->header.size, sizeof(DocumentPart));
    EXPECT_LE(part->count, DocumentPart::kBytes);
    Heard& heard = heard_[place_of(part->document)];
    if (part->from == 0) {
      heard = {part->revision, "", heard.times};
    }
    EXPECT_EQ(heard.revision, part->revision);
    EXPECT_EQ(heard.bytes.size(), part->from) << "in order";
    const char* const bytes = reinterpret_cast<const char*>(part->bytes.data());
    heard.bytes.append(bytes, part->count);
    EXPECT_TRUE(std::all_of(part->bytes.begin() + part->count, part->bytes.end(), [](std::byte byte) {
      return byte == std::byte{};
    })) << "nothing else goes out";
    heard.times += heard.bytes.size() == part->whole ? 1 : 0;
    sender_.sent();
    return true;
  }
  const Heard& heard(Document document) const { return heard_[place_of(document)]; }

  DocumentShelf shelf_;
  DocumentSender sender_;
  std::array<Heard, kDocuments> heard_;
};

TEST_F(DocumentSenderTest, SendsNothingOfAnEmptyShelf) { EXPECT_FALSE(hear()); }

TEST_F(DocumentSenderTest, SendsEachDocumentOnceWhateverItsSize) {
  constexpr std::size_t kPart = DocumentPart::kBytes;
  const std::vector<std::size_t> sizes{0, 1, kPart - 1, kPart, kPart + 1, 3 * kPart, 3 * kPart + 7};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    ASSERT_TRUE(shelf_.put(static_cast<Document>(i + 1), counted(sizes[i])));
  }
  int parts = 0;
  while (hear()) {
    ++parts;
  }
  EXPECT_EQ(parts, 1 + 1 + 1 + 1 + 2 + 3 + 4);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_EQ(heard_[i].bytes, counted(sizes[i]));
    EXPECT_EQ(heard_[i].times, 1);
    EXPECT_EQ(heard_[i].revision, 1U);
  }
  EXPECT_FALSE(hear());
}

TEST_F(DocumentSenderTest, APartThatDidNotLeaveIsTheNextOneStill) {
  ASSERT_TRUE(shelf_.put(Document::kPlan, counted(10'000)));
  const DocumentPart* const first = sender_.next(shelf_);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->from, 0U);
  EXPECT_EQ(sender_.next(shelf_)->from, 0U);
  sender_.sent();
  EXPECT_EQ(sender_.next(shelf_)->from, DocumentPart::kBytes);
  EXPECT_EQ(sender_.next(shelf_)->from, DocumentPart::kBytes);
}

TEST_F(DocumentSenderTest, BeginsADocumentAnewThatChangesMeanwhile) {
  ASSERT_TRUE(shelf_.put(Document::kPlan, counted(20'000)));
  ASSERT_TRUE(hear());
  ASSERT_TRUE(hear());
  ASSERT_TRUE(shelf_.put(Document::kPlan, "short"));
  while (hear()) {
  }
  EXPECT_EQ(heard(Document::kPlan).bytes, "short");
  EXPECT_EQ(heard(Document::kPlan).revision, 2U);
  EXPECT_EQ(heard(Document::kPlan).times, 1);
}

TEST_F(DocumentSenderTest, BeginsAnewAlsoWithAPartThatWasMadeAndNotSent) {
  ASSERT_TRUE(shelf_.put(Document::kPlan, counted(20'000)));
  ASSERT_NE(sender_.next(shelf_), nullptr);
  ASSERT_TRUE(shelf_.put(Document::kPlan, ""));
  const DocumentPart* const part = sender_.next(shelf_);
  ASSERT_NE(part, nullptr);
  EXPECT_EQ(part->revision, 2U);
  EXPECT_EQ(part->whole, 0U);
  EXPECT_EQ(part->count, 0U);
  ASSERT_TRUE(hear());
  EXPECT_FALSE(hear());
  EXPECT_EQ(heard(Document::kPlan).times, 1);
}

TEST_F(DocumentSenderTest, ADocumentThatChangesAllTheTimeDoesNotKeepOthersFromArriving) {
  ASSERT_TRUE(shelf_.put(Document::kMission, "mission"));
  ASSERT_TRUE(shelf_.put(Document::kReport, "report"));
  ASSERT_TRUE(shelf_.put(Document::kPlan, "plan 0"));
  for (int i = 1; i < 10; ++i) {
    ASSERT_TRUE(hear());
    ASSERT_TRUE(shelf_.put(Document::kPlan, "plan " + std::to_string(i)));
  }
  EXPECT_EQ(heard(Document::kMission).times, 1);
  EXPECT_EQ(heard(Document::kReport).times, 1) << "it waits for nobody";
  while (hear()) {
  }
  EXPECT_EQ(heard(Document::kMission).bytes, "mission");
  EXPECT_EQ(heard(Document::kReport).bytes, "report");
  EXPECT_EQ(heard(Document::kPlan).bytes, "plan 9");
}

}  // namespace
}  // namespace ivo::firmware::console
