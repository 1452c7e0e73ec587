#pragma once

#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

namespace gnomon {

/// The number that a text is as a whole; nothing where it is none, or none within least..most.
template <class Number>
std::optional<Number> numberIn(std::string_view text, Number least = std::numeric_limits<Number>::lowest(),
                               Number most = std::numeric_limits<Number>::max()) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool isWhole = error == std::errc() && end == text.data() + text.size();
  return isWhole && number >= least && number <= most ? std::optional(number) : std::nullopt;
}

} // namespace gnomon
