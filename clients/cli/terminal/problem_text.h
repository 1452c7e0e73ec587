#pragma once

#include <map>
#include <string>

#include "protocol/base/result.h"

namespace gnomon::cli {

/// JSON pointer of the spec -> the flag that set it, so that a problem can name what the user typed.
using FlagOrigins = std::map<std::string, std::string>;

/// One line: "--sun (/lights/0/sun/elevationDegrees): what is wrong; allowed: -90..90; got: 100". Control characters
/// in what came from elsewhere are replaced, so that a file or a server can't write to the terminal.
std::string problemLine(const Problem& problem, const FlagOrigins& origins = {});

/// Every problem on its line on stderr, each after "gnomon: ". Gives kExitProblem.
int printProblems(const Problems& problems, const FlagOrigins& origins = {});

/// The text with every control character replaced, so that what a file or a server says can't steer the terminal.
std::string printable(std::string text);

} // namespace gnomon::cli
