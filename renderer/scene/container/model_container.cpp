#include "renderer/scene/container/model_container.h"

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

Result<ModelContainer> openGlb(std::span<const std::uint8_t> file) {
  if (file.size() < kHeaderBytes) return malformed("The GLB ends inside its header.");
  const std::uint32_t version = numberAt(file, 4);
  if (version != 2) {
    return Problem{
        ProblemCode::unsupportedFeature, {}, "The GLB container is not of version 2.", "2", std::to_string(version)};
  }
  const std::uint32_t length = numberAt(file, 8);
  if (length != file.size()) {
    return malformed("The length in the GLB's header is not the length of the file.", std::to_string(file.size()),
                     std::to_string(length));
  }

  ModelContainer container;
  std::size_t offset = kHeaderBytes;
  for (int chunk = 0; offset < file.size(); ++chunk) {
    const std::string name = "Chunk " + std::to_string(chunk) + " of the GLB";
    if (file.size() - offset < kChunkHeaderBytes) return malformed(name + " ends inside its header.");
    const std::uint32_t bytes = numberAt(file, offset);
    const std::uint32_t type = numberAt(file, offset + 4);
    offset += kChunkHeaderBytes;
    if (bytes > file.size() - offset) {
      return malformed(name + " claims more bytes than the file holds.", std::to_string(file.size() - offset),
                       std::to_string(bytes));
    }
    if (bytes % 4 != 0)
      return malformed(name + " has a length that is not a multiple of 4.", {}, std::to_string(bytes));
    const auto content = file.subspan(offset, bytes);
    offset += bytes;

    if ((chunk == 0) != (type == kJsonChunk)) {
      return malformed(chunk == 0 ? "The first chunk of the GLB is not JSON." : "The GLB has a second JSON chunk.");
    }
    if (chunk == 0) {
      container.json = asText(content);
    } else if (type == kBinaryChunk) {
      if (container.binary) return malformed("The GLB has a second BIN chunk.");
      container.binary = content;
    }
  }
  if (container.json.empty()) return malformed("The GLB has no JSON chunk.");
  return container;
}

} // namespace

Result<ModelContainer> openContainer(const Bytes& model) {
  std::string_view text = asText(model);
  if (text.empty()) return malformed("The model is empty.");
  if (text.starts_with("glTF")) return openGlb(model);
  if (text.starts_with("version https://git-lfs")) {
    return malformed("The model is a git-lfs pointer, not the file that it stands for.");
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '{') {
    const bool markup = first != std::string_view::npos && text[first] == '<';
    return malformed(markup ? "The model is HTML or XML, neither a GLB nor glTF JSON."
                            : "The model is neither a GLB nor glTF JSON.");
  }
  return ModelContainer{text, std::nullopt};
}

} // namespace gnomon
