#include "renderer/scene/container/model_container.h"

#include <array>
#include <string>

namespace gnomon {

namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;   // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942; // "BIN\0"

Problem malformed(std::string detail, std::string limit = {}, std::string actual = {}) {
  return {ProblemCode::malformed, {}, std::move(detail), std::move(limit), std::move(actual)};
}

std::uint32_t numberAt(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return static_cast<std::uint32_t>(littleEndian(bytes.subspan(offset, 4)));
}

std::string nameOf(int chunk) {
  return "Chunk " + std::to_string(chunk) + " of the GLB";
}

/// The chunk's kind where a header can stand there; else 0.
std::uint32_t kindAt(std::span<const std::uint8_t> file, std::size_t offset) {
  return offset + kChunkHeaderBytes <= file.size() ? numberAt(file, offset + 4) : 0;
}

/// Where the next chunk begins after one of `bytes` that ends at `end`, whether or not its padding is there and
/// counted; nothing where neither leads to a chunk or the end.
std::optional<std::size_t> nextChunk(std::span<const std::uint8_t> file, std::size_t length, std::size_t bytes,
                                     std::size_t end) {
  if (bytes % 4 == 0) return end;
  for (const std::size_t begin : {end, end + 4 - bytes % 4}) {
    const std::uint32_t kind = kindAt(file, begin);
    if (begin >= length || kind == kBinaryChunk || kind == kJsonChunk) return begin;
  }
  return std::nullopt;
}

const Repair kUnpadded{"A chunk of the GLB has a length that is not a multiple of 4", "it is read as long as it is"};
const Repair kAfterEnd{"The GLB has bytes after its end", "they are not read"};
const Repair kWrongLength{"The length in the header of the GLB is less than that of its chunks",
                          "they are read as long as they are"};

Result<ModelContainer> openGlb(std::span<const std::uint8_t> file, Findings& findings) {
  if (file.size() < kHeaderBytes) return malformed("The GLB ends inside its header.");
  const std::uint32_t version = numberAt(file, 4);
  if (version != 2) {
    return Problem{
        ProblemCode::unsupportedFeature, {}, "The GLB container is not of version 2.", "2", std::to_string(version)};
  }
  const std::uint32_t length = numberAt(file, 8);
  if (length > file.size()) {
    return malformed("The GLB is cut short: the file has " + std::to_string(file.size()) + " of the " +
                     std::to_string(length) + " bytes that its header states.");
  }

  ModelContainer container;
  std::size_t offset = kHeaderBytes;
  for (int chunk = 0; offset + kChunkHeaderBytes <= length; ++chunk) {
    const std::uint32_t bytes = numberAt(file, offset);
    const std::uint32_t kind = numberAt(file, offset + 4);
    offset += kChunkHeaderBytes;
    if (bytes > file.size() - offset) {
      return malformed(nameOf(chunk) + " claims more bytes than the file holds.", std::to_string(file.size() - offset),
                       std::to_string(bytes));
    }
    const auto content = file.subspan(offset, bytes);
    const auto next = nextChunk(file, length, bytes, offset + bytes);
    if (!next) {
      return malformed(nameOf(chunk) + " has a length that is not a multiple of 4, and no chunk follows it.", {},
                       std::to_string(bytes));
    }
    if (bytes % 4 != 0) findings.repair(kUnpadded, {}, {}, nameOf(chunk));
    offset = *next;

    if ((chunk == 0) != (kind == kJsonChunk)) {
      return malformed(chunk == 0 ? "The first chunk of the GLB is not JSON." : "The GLB has a second JSON chunk.");
    }
    if (chunk == 0) {
      container.json = asText(content);
    } else if (kind == kBinaryChunk && container.binary) {
      findings.repair({"The GLB has a second BIN chunk", "it is not read"}, {});
    } else if (kind == kBinaryChunk) {
      container.binary = content;
      if (content.empty()) findings.repair({"The BIN chunk of the GLB is empty", "it counts as none"}, {});
    }
  }
  if (offset > length) findings.repair(kWrongLength, {});
  if (offset < file.size()) findings.repair(kAfterEnd, {}, {}, std::to_string(file.size() - offset) + " bytes");
  const std::size_t text = container.json.find_last_not_of('\0') + 1;
  if (text < container.json.size()) {
    findings.repair({"The JSON of the GLB is padded with zeros instead of spaces", "they are not read"}, {});
    container.json = container.json.substr(0, text);
  }
  if (container.json.empty()) return malformed("The GLB has no JSON chunk.");
  return container;
}

/// The first bytes of files that are none, and what is said of them.
struct ForeignFile {
  std::string_view begins;
  std::string_view is;
};
constexpr std::array kForeignFiles{
    ForeignFile{"\x1F\x8B", "is packed with gzip: unpack it first"},
    ForeignFile{"b3dm", "is a b3dm, a tile of 3D Tiles around a GLB: take the GLB out of it first"},
    ForeignFile{"i3dm", "is an i3dm, a tile of 3D Tiles around a GLB: take the GLB out of it first"},
    ForeignFile{"cmpt", "is a cmpt, several tiles of 3D Tiles in one file: take the GLBs out of it first"},
    ForeignFile{"pnts", "is a pnts, a point cloud of 3D Tiles, which is not read"},
    ForeignFile{"PXR-USDC", "is a USD file, which is not read: export it as glTF"},
    ForeignFile{"#usda", "is a USD file, which is not read: export it as glTF"},
    ForeignFile{"Kaydara FBX", "is an FBX file, which is not read: export it as glTF"},
    ForeignFile{"version https://git-lfs", "is a git-lfs pointer, not the file that it stands for"},
};

/// Of a ZIP: a USDZ is one whose first file is a USD.
std::string_view kindOfZip(std::string_view zip) {
  constexpr std::size_t kName = 30; // of the first file, whose length stands at 26 (APPNOTE.TXT, 4.3.7)
  if (zip.size() < kName) return "is a ZIP: unpack it first";
  const std::size_t length = static_cast<unsigned char>(zip[26]) + 256u * static_cast<unsigned char>(zip[27]);
  const std::string_view name = zip.substr(kName, length);
  const bool isUsd = name.ends_with(".usd") || name.ends_with(".usda") || name.ends_with(".usdc");
  return isUsd ? "is a USDZ, which is not read: export it as glTF" : "is a ZIP: unpack it first";
}

/// What a file that is neither a GLB nor JSON is.
std::string_view kindOf(std::string_view text) {
  for (const ForeignFile& each : kForeignFiles) {
    if (text.starts_with(each.begins)) return each.is;
  }
  if (text.starts_with("PK\x03\x04")) return kindOfZip(text);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool markup = first != std::string_view::npos && text[first] == '<';
  return markup ? "is HTML or XML, neither a GLB nor glTF JSON" : "is neither a GLB nor glTF JSON";
}

} // namespace

Result<ModelContainer> openContainer(const Bytes& model, Findings& findings) {
  std::string_view text = asText(model);
  if (text.empty()) return malformed("The model is empty.");
  if (text.starts_with("glTF")) return openGlb(model, findings);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '{') {
    return malformed("The model " + std::string(kindOf(text)) + ".");
  }
  return ModelContainer{text, std::nullopt};
}

} // namespace gnomon
