#include "renderer/environment/rgbe_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"
#include "renderer/environment/environment_checks.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxHeader = 65536;
constexpr int kLeastEncoded = 8, kMostEncoded = 32767; ///< widths that the newer encoding has

Problem broken(const std::string& what) {
  return {ProblemCode::malformed, "", "The .hdr file is broken: " + what + "."};
}

Problem unsupported(std::string detail, std::string limit, std::string_view actual) {
  return {ProblemCode::unsupportedFeature, "", std::move(detail), std::move(limit), asciiExcerpt(actual)};
}

/// Takes words off the front of a line.
std::string_view nextWord(std::string_view& line) {
  const auto begin = std::min(line.find_first_not_of(" \t\r"), line.size());
  line.remove_prefix(begin);
  const auto end = std::min(line.find_first_of(" \t\r"), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

template <class Number>
std::optional<Number> numberOf(std::string_view word) {
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (word.empty() || error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

struct RgbeHeader {
  glm::ivec2 size{0};
  glm::dvec3 exposure{1}; ///< numbers of the file are multiplied by it already
  std::size_t pixels = 0; ///< where they begin
};

/// Multiplies `exposure` by `count` numbers, or by one three times.
Status applyExposure(std::string_view values, int count, glm::dvec3& exposure) {
  glm::dvec3 by(1);
  for (int i = 0; i < count; ++i) {
    const auto number = numberOf<double>(nextWord(values));
    if (!number || !(*number > 1e-30) || !(*number < 1e30)) return broken("an exposure is no positive number");
    by[i] = *number;
  }
  exposure *= count == 1 ? glm::dvec3(by.x) : by;
  return Done{};
}

Status applyVariable(std::string_view line, RgbeHeader& header) {
  const auto valueOf = [&](std::string_view name) -> std::optional<std::string_view> {
    return line.starts_with(name) ? std::optional(line.substr(name.size())) : std::nullopt;
  };
  if (auto format = valueOf("FORMAT=")) {
    const std::string_view name = nextWord(*format);
    if (name != "32-bit_rle_rgbe") {
      return unsupported("The .hdr file has colors of a kind that is not read.", "32-bit_rle_rgbe", name);
    }
  }
  if (const auto exposure = valueOf("EXPOSURE=")) return applyExposure(*exposure, 1, header.exposure);
  if (const auto correction = valueOf("COLORCORR=")) return applyExposure(*correction, 3, header.exposure);
  return Done{};
}

Result<glm::ivec2> sizeIn(std::string_view line) {
  const std::string_view whole = line;
  std::array<std::string_view, 4> words;
  for (std::string_view& word : words) word = nextWord(line);
  const auto isAxis = [](std::string_view word, char axis) {
    return word.size() == 2 && (word[0] == '+' || word[0] == '-') && word[1] == axis;
  };
  const bool isTurned = isAxis(words[0], 'X') && isAxis(words[2], 'Y');
  if (!isTurned && !(isAxis(words[0], 'Y') && isAxis(words[2], 'X'))) return broken("it has no line of its size");
  if (words[0] != "-Y" || words[2] != "+X") {
    return unsupported("The rows of the .hdr file do not go from top to bottom and from left to right.",
                       "-Y HEIGHT +X WIDTH", whole);
  }
  const auto height = numberOf<int>(words[1]), width = numberOf<int>(words[3]);
  if (!height || !width || *height < 1 || *width < 1) return broken("its size is no pair of positive numbers");
  return glm::ivec2(*width, *height);
}

Result<RgbeHeader> headerOf(std::span<const std::uint8_t> file) {
  if (!isRgbe(file)) return broken("it does not begin with #?RADIANCE or #?RGBE");
  std::string_view text = asText(file.first(std::min(file.size(), kMaxHeader)));
  RgbeHeader header;
  bool variables = true;
  while (true) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return broken("its header does not end");
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    header.pixels += end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!variables) {
      const auto size = sizeIn(line);
      if (!size) return size.problems();
      header.size = *size;
      return header;
    }
    variables = !line.empty();
    if (const Status applied = applyVariable(line, header); !applied) return applied.problems();
  }
}

using Rgbe = std::array<std::uint8_t, 4>;

/// Takes rows off the rest of a file.
class RowReader {
 public:
  explicit RowReader(std::span<const std::uint8_t> rest) : rest_(rest) {}

  Status read(std::span<Rgbe> row) {
    const auto width = static_cast<int>(row.size());
    const bool encoded = width >= kLeastEncoded && width <= kMostEncoded && rest_.size() >= 4 && rest_[0] == 2 &&
                         rest_[1] == 2 && rest_[2] < 128;
    return encoded ? readPlanes(row) : readPixels(row);
  }

 private:
  static Problem cutShort() { return broken("it ends before its last row does"); }

  /// Red, green, blue and exponents of the row one after another, each as runs and as bytes that stand for themselves.
  Status readPlanes(std::span<Rgbe> row) {
    if ((std::size_t{rest_[2]} << 8 | rest_[3]) != row.size())
      return broken("a row has another length than the picture");
    rest_ = rest_.subspan(4);
    for (std::size_t plane = 0; plane < 4; ++plane) {
      for (std::size_t x = 0; x < row.size();) {
        if (rest_.size() < 2) return cutShort();
        const bool isRun = rest_[0] > 128;
        const std::size_t count = isRun ? rest_[0] - 128u : rest_[0];
        if (count == 0 || count > row.size() - x) return broken("a run does not end with its row");
        if (!isRun && rest_.size() < 1 + count) return cutShort();
        for (std::size_t i = 0; i < count; ++i) row[x + i][plane] = rest_[isRun ? 1 : 1 + i];
        x += count;
        rest_ = rest_.subspan(isRun ? 2 : 1 + count);
      }
    }
    return Done{};
  }

  /// Whole pixels; (1, 1, 1, n) says how often the one before it comes again, in base 256 where several follow.
  Status readPixels(std::span<Rgbe> row) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < row.size();) {
      if (rest_.size() < 4) return cutShort();
      const Rgbe pixel{rest_[0], rest_[1], rest_[2], rest_[3]};
      rest_ = rest_.subspan(4);
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        row[x++] = last_ = pixel;
        shift = 0;
        continue;
      }
      const std::size_t count = shift < 32 ? std::size_t{pixel[3]} << shift : row.size() + 1;
      if (count > row.size() - x) return broken("a run does not end with its row");
      for (std::size_t i = 0; i < count; ++i) row[x++] = last_;
      shift += 8;
    }
    return Done{};
  }

  std::span<const std::uint8_t> rest_;
  Rgbe last_{};
};

} // namespace

bool isRgbe(std::span<const std::uint8_t> file) {
  const std::string_view text = asText(file);
  return text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE");
}

Result<glm::ivec2> rgbeSize(std::span<const std::uint8_t> file) {
  const auto header = headerOf(file);
  if (!header) return header.problems();
  return header->size;
}

Result<EnvironmentMap> readRgbe(std::span<const std::uint8_t> file) {
  const auto header = headerOf(file);
  if (!header) return header.problems();
  if (const Status fits = checkEnvironmentSize(header->size); !fits) return fits.problems();
  EnvironmentMap map{header->size.x, header->size.y, {}};
  const auto width = static_cast<std::size_t>(map.width);
  map.texels.reserve(width * static_cast<std::size_t>(map.height));
  std::vector<Rgbe> row(width);
  RowReader reader(file.subspan(header->pixels));
  for (int y = 0; y < map.height; ++y) {
    if (const Status read = reader.read(row); !read) return read.problems();
    for (const Rgbe& pixel : row) {
      const glm::dvec3 mantissas(pixel[0], pixel[1], pixel[2]);
      map.texels.emplace_back(mantissas * std::ldexp(1.0, pixel[3] - 136) / header->exposure);
    }
  }
  return map;
}

} // namespace gnomon
