#pragma once

#include <string>
#include <string_view>

#include "protocol/fields/fields.h"

/// What an option's value may be as text, wherever it comes from; addresses that are read are in serve_inputs.h.
namespace gnomon {

/// What is wrong with a text, as a sentence; empty = nothing.
using TextCheck = std::string (*)(std::string_view text);

/// What an option takes.
struct OptionValue {
  std::string_view name = ""; ///< in --help; empty = what the type of the member says
  Range range{};              ///< of a whole number
  TextCheck fault = nullptr;  ///< of a text, or of each in a list; nullptr = any will do
};

inline constexpr std::string_view kBytes = "BYTES";     ///< takes units: 512MB, 2GB; powers of 1024
inline constexpr std::string_view kSeconds = "SECONDS"; ///< takes units: 90s, 5m, 12h, 30d

/// Makes a text that is a whole number of the value's range, with a unit where the option takes one, the number alone.
/// What is wrong otherwise; the text stays.
std::string toPlainNumber(std::string& text, const OptionValue& value);

/// As "1..65535", or "1KB..1PB".
std::string rangeText(const OptionValue& value);

std::string listenAddressFault(std::string_view text); ///< a host's name or address, without a port
std::string allowedHostFault(std::string_view text);   ///< origin_check.h
std::string allowedOriginFault(std::string_view text); ///< origin_check.h

} // namespace gnomon
