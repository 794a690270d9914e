// The other end of the console's socket, for a program that asks one thing: reads what comes, says one command at a
// time.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>

#include "config/base/result.hpp"
#include "firmware/console/console_messages.hpp"
#include "firmware/console/document_assembly.hpp"
#include "firmware/console/document_shelf.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::firmware::console {

class ConsoleClient {
 public:
  /// A controller may still be reading a large map.
  static constexpr std::chrono::seconds kPatience{5};

  /// Fails when nobody listens at `path`.
  [[nodiscard]] static Result<ConsoleClient> connect(const std::string& path,
                                                     std::chrono::seconds patience = kPatience);

  /// The next status; fails when none comes while patience lasts, when the controller goes, or says what we do not
  /// understand.
  [[nodiscard]] Result<Status> status();
  /// The document as it was last heard; waits for it where it was not heard yet, and fails as status() does.
  [[nodiscard]] Result<std::string> document(Document document);
  /// Says it and waits for its answer; fails as status() does.
  [[nodiscard]] Result<Verdict> command(Kind kind, std::uint32_t question, std::uint32_t argument = 0);
  /// The same; header.kind is filled in, the rest of the header is ours.
  [[nodiscard]] Result<Verdict> put(AreaCommand area);
  [[nodiscard]] Result<Verdict> report(PoseCommand pose);

 private:
  ConsoleClient(std::string path, hal::FileDescriptor socket, std::chrono::seconds patience)
      : path_(std::move(path)), socket_(std::move(socket)), patience_(patience) {}

  struct Heard {
    std::optional<Status> status;
    std::optional<Answer> answer;
  };
  [[nodiscard]] Result<Heard> hear(std::chrono::steady_clock::time_point until);
  template <class Message>
  [[nodiscard]] Result<Verdict> say(Message message, Kind kind);
  void gather(const DocumentPart& part);

  std::string path_;
  hal::FileDescriptor socket_;
  std::chrono::seconds patience_;
  std::uint32_t said_ = 0;
  std::array<DocumentAssembly, kDocuments> parts_;
  std::array<std::optional<std::string>, kDocuments> documents_;
};

}  // namespace ivo::firmware::console
