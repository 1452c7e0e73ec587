#include <algorithm>
#include <bit>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"
#include "renderer/core/grid_file_kind.h"
#include "renderer/core/stop.h"
#include "renderer/volume/density_grid.h"
#include "renderer/volume/half.h"
#include "renderer/volume/vdb_file.h"

// "The NPY format", numpy.org/doc/stable/reference/generated/numpy.lib.format.html
namespace gnomon {

namespace {

constexpr std::string_view kSignature = "\x93NUMPY";
constexpr std::size_t kMaxHeaderBytes = 64 * 1024;
constexpr std::size_t kMaxShown = 40; // characters of the file in a problem

Problem malformed(const std::string& what) {
  return {ProblemCode::malformed, "", "The .npy file is broken: " + what + "."};
}

std::string excerpt(std::string_view text) {
  return asciiExcerpt(text.substr(0, kMaxShown));
}

/// The header is a Python dictionary; this reads the tokens of it, each after any spaces.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : rest_(text) {}

  bool take(std::string_view token) {
    skipSpaces();
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  std::optional<std::string_view> takeQuoted() {
    skipSpaces();
    if (rest_.empty() || (rest_.front() != '\'' && rest_.front() != '"')) return std::nullopt;
    const std::size_t end = rest_.find(rest_.front(), 1);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view text = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return text;
  }

  std::optional<std::int64_t> takeNumber() {
    skipSpaces();
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (error != std::errc()) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return number;
  }

  bool atEnd() {
    skipSpaces();
    return rest_.empty();
  }

 private:
  void skipSpaces() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\n"), rest_.size())); }

  std::string_view rest_;
};

struct Header {
  std::optional<std::string_view> descr{};
  std::optional<bool> fortranOrder{};
  std::optional<std::vector<std::int64_t>> shape{};
};

std::optional<std::vector<std::int64_t>> takeShape(Tokens& tokens) {
  std::vector<std::int64_t> shape;
  if (!tokens.take("(")) return std::nullopt;
  while (!tokens.take(")")) {
    const auto side = tokens.takeNumber();
    if (!side) return std::nullopt;
    shape.push_back(*side);
    if (!tokens.take(",")) return tokens.take(")") ? std::optional(shape) : std::nullopt;
  }
  return shape;
}

/// What is wrong with the next entry; empty = nothing.
std::string takeEntry(Tokens& tokens, Header& header) {
  const auto key = tokens.takeQuoted();
  if (!key || !tokens.take(":")) return "its header is no dictionary";
  if (*key == "descr" && !header.descr) {
    header.descr = tokens.takeQuoted();
    return header.descr ? "" : "its descr is no name of a type of numbers";
  }
  if (*key == "fortran_order" && !header.fortranOrder) {
    if (tokens.take("True")) header.fortranOrder = true;
    if (!header.fortranOrder && tokens.take("False")) header.fortranOrder = false;
    return header.fortranOrder ? "" : "its fortran_order is neither True nor False";
  }
  if (*key == "shape" && !header.shape) {
    header.shape = takeShape(tokens);
    return header.shape ? "" : "its shape is no tuple of whole numbers";
  }
  return "its header has '" + excerpt(*key) + "', which does not belong there or is there twice";
}

Result<Header> parseHeader(std::string_view text) {
  Tokens tokens(text);
  Header header;
  if (!tokens.take("{")) return malformed("its header is no dictionary");
  while (!tokens.take("}")) {
    if (const std::string wrong = takeEntry(tokens, header); !wrong.empty()) return malformed(wrong);
    if (tokens.take(",")) continue;
    if (!tokens.take("}")) return malformed("its header is no dictionary");
    break;
  }
  if (!tokens.atEnd()) return malformed("something follows its header's dictionary");
  if (!header.descr || !header.fortranOrder || !header.shape) {
    return malformed("its header lacks descr, fortran_order or shape");
  }
  return header;
}

/// Where the header's text lies, or what is wrong.
Result<std::string_view> headerText(std::span<const std::uint8_t> file) {
  if (!asText(file).starts_with(kSignature)) return malformed("it does not begin with the signature of NumPy");
  if (file.size() < kSignature.size() + 2) return malformed("it ends in its version");
  const int major = file[kSignature.size()];
  if (major < 1 || major > 3) {
    return Problem{ProblemCode::unsupportedFeature, "", "The .npy file is of a version that is not known.", "1..3",
                   std::to_string(major)};
  }
  const std::size_t lengthBytes = major == 1 ? 2 : 4;
  const std::size_t begin = kSignature.size() + 2 + lengthBytes;
  if (file.size() < begin) return malformed("it ends in its header's length");
  const std::uint64_t length = littleEndian(file.subspan(begin - lengthBytes, lengthBytes));
  if (length > kMaxHeaderBytes) {
    return Problem{ProblemCode::tooLarge, "", "The header of the .npy file is too long.",
                   std::to_string(kMaxHeaderBytes) + " bytes", std::to_string(length)};
  }
  if (file.size() - begin < length) return malformed("it ends in its header");
  return asText(file.subspan(begin, length));
}

enum class Type { float32, float16, uint8 };

std::optional<Type> typeOf(std::string_view descr) {
  if (descr == "<f4") return Type::float32;
  if (descr == "<f2") return Type::float16;
  if (descr == "|u1") return Type::uint8;
  return std::nullopt;
}

std::size_t bytesOf(Type type) {
  return type == Type::float32 ? 4 : type == Type::float16 ? 2 : 1;
}

float numberAt(const std::uint8_t* bytes, Type type) {
  if (type == Type::uint8) return *bytes;
  const std::uint64_t bits = littleEndian({bytes, bytesOf(type)});
  return type == Type::float16 ? fromHalf(static_cast<std::uint16_t>(bits))
                               : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
}

} // namespace

Result<DensityGrid> readNpy(std::span<const std::uint8_t> file) {
  const auto text = headerText(file);
  if (!text) return text.problems();
  const auto header = parseHeader(*text);
  if (!header) return header.problems();
  const auto type = typeOf(*header->descr);
  if (!type) {
    return Problem{ProblemCode::unsupportedFeature, "", "The .npy file has numbers of a type that is not read.",
                   "<f4, <f2, |u1", excerpt(*header->descr)};
  }
  if (*header->fortranOrder) {
    return Problem{ProblemCode::unsupportedFeature, "", "The .npy file is in Fortran order.", "fortran_order False",
                   "True"};
  }
  const std::vector<std::int64_t>& shape = *header->shape;
  if (shape.size() != 3) {
    return Problem{ProblemCode::invalidValue, "", "The .npy file is no array of three axes, z, y and x.", "3",
                   std::to_string(shape.size())};
  }
  const auto count = voxelCount(shape[2], shape[1], shape[0]);
  if (!count) return count.problems();
  const auto begin = static_cast<std::size_t>(text->data() + text->size() - asText(file).data());
  const std::uint8_t* data = file.data() + begin;
  if (file.size() - begin != *count * bytesOf(*type)) {
    return Problem{ProblemCode::malformed, "", "The .npy file has more or fewer numbers than its shape says.",
                   std::to_string(*count * bytesOf(*type)) + " bytes", std::to_string(file.size() - begin)};
  }
  DensityGrid grid{glm::ivec3(shape[2], shape[1], shape[0]), std::vector<float>(*count)};
  for (std::size_t i = 0; i < *count; ++i) {
    if (i % (1 << 16) == 0) stopIfAsked();
    grid.values[i] = numberAt(data + i * bytesOf(*type), *type);
  }
  return requireFinite(std::move(grid));
}

Result<DensityGrid> readGridFile(std::span<const std::uint8_t> file, const std::string& name) {
  const auto kind = gridFileKind(asText(file));
  if (!kind) {
    return Problem{ProblemCode::unsupportedFeature, "", "The file of a volume is of no kind that is read.",
                   "NumPy's .npy, OpenVDB's .vdb"};
  }
  if (*kind == GridFileKind::openVdb) return readVdb(file, name);
  if (!name.empty()) {
    return Problem{ProblemCode::invalidValue, "", "A .npy file has one grid, which has no name.", "no name",
                   name.substr(0, 40)};
  }
  return readNpy(file);
}

} // namespace gnomon
