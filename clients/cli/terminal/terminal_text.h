#pragma once

#include <string>

namespace gnomon::cli {

/// The text with every control character replaced, so that what a file or a server says can't steer the terminal.
std::string printable(std::string text);

} // namespace gnomon::cli
