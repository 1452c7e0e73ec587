#pragma once

#include <span>
#include <string_view>

namespace gnomon {

/// One file of the web page, as it is served.
struct WebFile {
  std::string_view path;        ///< of the URL: "/" for index.html, else "/" and the file's name
  std::string_view contentType; ///< the whole header value
  std::string_view bytes;       ///< lives as long as the program
};

/// Every file of the page, embedded at build. Nothing else is needed to show it.
std::span<const WebFile> webFiles();

} // namespace gnomon
