#include "clients/cli/terminal/terminal_text.h"

#include <algorithm>

namespace gnomon::cli {

std::string printable(std::string text) {
  const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), isControl, '?');
  return text;
}

} // namespace gnomon::cli
