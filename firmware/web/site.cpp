#include "firmware/web/site.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <utility>

#include "firmware/files/text_file.hpp"
#include "firmware/web/random.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::size_t kMostFiles = 500;
constexpr std::size_t kMostBytes = 32U << 20U;

std::string_view type_of(const std::string& ending) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kTypes{{
      {".html", "text/html; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".json", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/vnd.microsoft.icon"},
      {".woff2", "font/woff2"},
  }};
  for (const auto& [known, type] : kTypes) {
    if (ending == known) {
      return type;
    }
  }
  return "";
}

}  // namespace

Result<void> Site::add(const std::string& folder, const std::string& prefix) {
  std::error_code error;
  std::filesystem::recursive_directory_iterator entry(folder, error);
  if (error) {
    return Error{folder + ": cannot be read: " + error.message() + "; expected the folder of the page's files"};
  }
  std::size_t bytes = 0;
  for (const std::filesystem::recursive_directory_iterator end; entry != end; entry.increment(error)) {
    const std::string type(type_of(entry->path().extension().string()));
    const std::string name = std::filesystem::relative(entry->path(), folder, error).generic_string();
    if (type.empty() || error || !std::filesystem::is_regular_file(entry->path(), error) ||
        name.find("/.") != std::string::npos || name.starts_with('.')) {
      continue;
    }
    Result<std::string> text = read_file(entry->path().string());
    if (!text) {
      return text.error();
    }
    bytes += text.value().size();
    if (files_.size() >= kMostFiles || bytes > kMostBytes) {
      return Error{folder + ": holds more than a page; expected at most " + std::to_string(kMostFiles) + " files and " +
                   std::to_string(kMostBytes) + " bytes"};
    }
    const std::string path = prefix + (name == "index.html" ? "" : name);
    const std::string etag = "\"" + digest_of(text.value()).substr(0, 32) + "\"";
    HttpAnswer answer = answer_of(200, std::move(text).value(), type);
    // Asked for anew each time, or an update would meet pages of the version before.
    answer.headers = {{"cache-control:", "no-cache"}, {"etag:", etag}};
    files_[path] = std::move(answer);
  }
  return {};
}

Result<Site> Site::read(const std::string& page, const std::string& leaflet) {
  Site site;
  if (const Result<void> added = site.add(page, "/"); !added) {
    return added.error();
  }
  if (site.file("/") == nullptr) {
    return Error{page + ": holds no index.html; expected the page's files"};
  }
  if (const Result<void> added = site.add(leaflet, "/leaflet/"); !added) {
    return added.error();
  }
  return site;
}

const HttpAnswer* Site::file(std::string_view path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace ivo::firmware::web
