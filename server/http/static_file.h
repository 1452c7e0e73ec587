#pragma once

#include <string_view>

namespace gnomon {

/// One file of the web page.
struct StaticFile {
  std::string_view path;        ///< of the URL, beginning with '/'
  std::string_view contentType; ///< the whole header value
  std::string_view bytes;       ///< outlives the server
};

} // namespace gnomon
