#include "renderer/scene/decode/meshopt_view.h"

#include <string_view>

#include "renderer/scene/gltf_json.h"

namespace gnomon {

namespace {

using nlohmann::json;

constexpr const char* kNames[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// The name under which an object has the extension; nullptr if it has none.
const char* nameIn(const json& object) {
  for (const char* name : kNames) {
    if (extensionOf(object, name) != nullptr) return name;
  }
  return nullptr;
}

MeshoptMode modeOf(std::string_view name) {
  if (name == "TRIANGLES") return MeshoptMode::triangles;
  return name == "INDICES" ? MeshoptMode::indices : MeshoptMode::attributes;
}

MeshoptFilter filterOf(std::string_view name) {
  if (name == "OCTAHEDRAL") return MeshoptFilter::octahedral;
  if (name == "QUATERNION") return MeshoptFilter::quaternion;
  return name == "EXPONENTIAL" ? MeshoptFilter::exponential : MeshoptFilter::none;
}

/// The strides that a mode and a filter leave; empty if the filter does not go with the mode.
std::string stridesOf(MeshoptMode mode, MeshoptFilter filter) {
  if (mode != MeshoptMode::attributes) return filter == MeshoptFilter::none ? "2 or 4" : "";
  if (filter == MeshoptFilter::octahedral) return "4 or 8";
  return filter == MeshoptFilter::quaternion ? "8" : "a multiple of 4";
}

bool strideFits(std::uint64_t stride, MeshoptMode mode, MeshoptFilter filter) {
  if (mode != MeshoptMode::attributes) return stride == 2 || stride == 4;
  if (filter == MeshoptFilter::octahedral) return stride == 4 || stride == 8;
  return filter == MeshoptFilter::quaternion ? stride == 8 : stride % 4 == 0;
}

bool isSound(const MeshoptView& view, const json& bufferView, Findings& findings) {
  const std::string strides = stridesOf(view.mode, view.filter);
  if (strides.empty()) {
    findings.invalid(view.pointer + "/filter", "Indices have no filter.", "NONE");
    return false;
  }
  if (!strideFits(view.byteStride, view.mode, view.filter)) {
    findings.invalid(view.pointer + "/byteStride", "The stride is not one that the mode and the filter allow.", strides,
                     std::to_string(view.byteStride));
    return false;
  }
  if (view.mode == MeshoptMode::triangles && view.count % 3 != 0) {
    findings.invalid(view.pointer + "/count", "The triangles are not complete.", "a multiple of 3",
                     std::to_string(view.count));
    return false;
  }
  const auto length = bufferView["byteLength"].get<std::uint64_t>();
  if (length != view.decodedBytes()) {
    findings.invalid(view.pointer + "/count", "The elements do not fill the buffer view.",
                     std::to_string(length) + " bytes",
                     std::to_string(view.count) + " elements of " + std::to_string(view.byteStride) + " bytes");
    return false;
  }
  const auto stride = bufferView.find("byteStride");
  if (stride != bufferView.end() && stride->get<std::uint64_t>() != view.byteStride) {
    findings.invalid(view.pointer + "/byteStride", "The stride is not the one of the buffer view.", stride->dump(),
                     std::to_string(view.byteStride));
    return false;
  }
  return true;
}

} // namespace

std::vector<bool> meshoptFallbacks(const json& document, bool hasBinary) {
  const auto buffers = document.find("buffers");
  if (buffers == document.end()) return {};
  std::vector<bool> plain(buffers->size(), false);
  std::vector<bool> compressed(buffers->size(), false);
  if (const auto views = document.find("bufferViews"); views != document.end()) {
    for (const json& view : *views) (hasMeshopt(view) ? compressed : plain)[view["buffer"].get<std::size_t>()] = true;
  }
  std::vector<bool> fallbacks(buffers->size(), false);
  for (std::size_t i = 0; i < fallbacks.size(); ++i) {
    const json& buffer = (*buffers)[i];
    const char* name = nameIn(buffer);
    const bool marked = name && buffer["extensions"][name].value("fallback", false);
    const bool hasBytes = buffer.contains("uri") || (i == 0 && hasBinary);
    fallbacks[i] = marked || (!hasBytes && compressed[i] && !plain[i]);
  }
  return fallbacks;
}

bool hasMeshopt(const json& bufferView) {
  return nameIn(bufferView) != nullptr;
}

std::optional<MeshoptView> readMeshopt(const json& bufferView, const std::string& pointer, Findings& findings) {
  const char* name = nameIn(bufferView);
  const json& extension = bufferView["extensions"][name];
  MeshoptView view;
  view.pointer = pointer + "/extensions/" + name;
  view.buffer = extension["buffer"].get<std::size_t>();
  view.byteOffset = extension.value("byteOffset", std::uint64_t{0});
  view.byteLength = extension["byteLength"].get<std::uint64_t>();
  view.byteStride = extension["byteStride"].get<std::uint64_t>();
  view.count = extension["count"].get<std::uint64_t>();
  view.mode = modeOf(extension["mode"].get_ref<const std::string&>());
  const std::string filter = extension.value("filter", "NONE");
  if (filter == "COLOR") {
    findings.unsupported(view.pointer + "/filter", "The filter COLOR is not supported.");
    return std::nullopt;
  }
  view.filter = filterOf(filter);
  if (!isSound(view, bufferView, findings)) return std::nullopt;
  return view;
}

} // namespace gnomon
