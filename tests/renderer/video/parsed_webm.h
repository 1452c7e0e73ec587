#pragma once

#include <string>
#include <string_view>
#include <vector>
#include <webm/dom_types.h>

#include "protocol/base/bytes.h"

namespace gnomon {

struct ParsedFrame {
  std::uint64_t milliseconds = 0;
  bool isKey = false;
  Bytes bytes;
};

struct ParsedWebm {
  bool isWhole = false; ///< libwebm found no fault, and its end
  webm::Ebml ebml;
  webm::Info info;
  std::vector<webm::TrackEntry> tracks;
  std::vector<ParsedFrame> frames;
  std::vector<webm::Tag> tags;
};

/// A WebM as libwebm's parser reads it.
ParsedWebm parsedWebm(std::string_view file);

} // namespace gnomon
