// The page's files, held in memory: what lies beside them on the disk cannot be asked for.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "config/base/result.hpp"
#include "firmware/web/http.hpp"

namespace ivo::firmware::web {

class Site {
 public:
  /// Reads every file below `page` (index.html is "/") and Leaflet's below `leaflet` ("/leaflet/..."), of the types
  /// that a page is made of; others are passed over. Fails without an index.html, or when there is far too much.
  [[nodiscard]] static Result<Site> read(const std::string& page, const std::string& leaflet);

  /// Null: no such file.
  [[nodiscard]] const HttpAnswer* file(std::string_view path) const;

 private:
  [[nodiscard]] Result<void> add(const std::string& folder, const std::string& prefix);

  std::map<std::string, HttpAnswer, std::less<>> files_;
};

}  // namespace ivo::firmware::web
