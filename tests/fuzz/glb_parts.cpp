#include "tests/fuzz/glb_parts.h"

#include <algorithm>
#include <vector>

#include "renderer/scene/container/model_container.h"

namespace gnomon::fuzz {

namespace {

constexpr std::size_t kHeaders = 12 + 8 + 8; ///< of the GLB and its two chunks

void append32(Bytes& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void appendChunk(Bytes& glb, const char* type, const Bytes& content, std::uint8_t padding) {
  const std::size_t padded = (content.size() + 3) / 4 * 4;
  append32(glb, padded);
  glb.insert(glb.end(), type, type + 4);
  glb.insert(glb.end(), content.begin(), content.end());
  glb.resize(glb.size() + padded - content.size(), padding);
}

Bytes glbOf(const Bytes& json, const Bytes& binary) {
  Bytes glb;
  glb.insert(glb.end(), {'g', 'l', 'T', 'F', 2, 0, 0, 0, 0, 0, 0, 0});
  appendChunk(glb, "JSON", json, ' ');
  if (!binary.empty()) appendChunk(glb, "BIN\0", binary, 0);
  Bytes length;
  append32(length, glb.size());
  std::copy(length.begin(), length.end(), glb.begin() + 8);
  return glb;
}

} // namespace

std::size_t mutatePart(std::uint8_t* data, std::size_t size, std::size_t capacity, unsigned seed,
                       const Mutation& mutate) {
  const Bytes whole(data, data + size);
  Findings findings;
  const auto parts = openContainer(whole, findings);
  const bool isGlb = size >= 4 && std::equal(data, data + 4, "glTF");
  if (!parts || !isGlb || seed % 8 == 0 || capacity < kHeaders + 8) return mutate(data, size, capacity);

  Bytes json(parts->json.begin(), parts->json.end());
  Bytes binary;
  if (parts->binary) binary.assign(parts->binary->begin(), parts->binary->end());
  const bool mutatesJson = binary.empty() || seed % 8 < 5;
  Bytes& part = mutatesJson ? json : binary;
  const std::size_t other = mutatesJson ? binary.size() : json.size();
  if (kHeaders + 8 + other >= capacity) return mutate(data, size, capacity);

  const std::size_t room = capacity - kHeaders - 8 - other;
  const std::size_t used = std::min(part.size(), room);
  part.resize(room);
  part.resize(mutate(part.data(), used, room));
  const Bytes glb = glbOf(json, binary);
  std::copy(glb.begin(), glb.end(), data);
  return glb.size();
}

} // namespace gnomon::fuzz
