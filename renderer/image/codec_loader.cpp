#include "renderer/image/codec_loader.h"

#include <dlfcn.h>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>

namespace gnomon {
namespace {

constexpr const char* kModuleFile = "libgnomon_image_codec.so";

Problem codecProblem(const std::string& detail) {
  return {ProblemCode::internal, "", "The image codec is not usable: " + detail + ".", "", ""};
}

} // namespace

std::vector<std::filesystem::path> codecModulePaths(const std::filesystem::path& executable) {
  const std::filesystem::path folder = executable.parent_path();
  return {folder / kModuleFile, (folder / ".." / "lib" / "gnomon" / kModuleFile).lexically_normal()};
}

Result<const codec::Table*> openCodec(std::span<const std::filesystem::path> paths) {
  for (const std::filesystem::path& path : paths) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) continue;
    void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    // dlerror() names paths of this machine, which a problem must not.
    if (!module) return codecProblem(std::string(kModuleFile) + " or a library that it needs cannot be opened");
    const auto function = reinterpret_cast<codec::TableFunction>(dlsym(module, codec::kTableFunction));
    const codec::Table* table = function ? function() : nullptr;
    if (!table || table->version != codec::kTableVersion) {
      return codecProblem(std::string(kModuleFile) + " belongs to another version of this program");
    }
    return table;
  }
  return codecProblem(std::string(kModuleFile) + " lies neither beside the program nor in ../lib/gnomon");
}

Result<const codec::Table*> imageCodec() {
  static std::once_flag once;
  static std::optional<Result<const codec::Table*>> codec;
  std::call_once(once, [] {
    std::error_code error;
    const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
    codec = error ? Result<const codec::Table*>(codecProblem("/proc/self/exe cannot be read"))
                  : openCodec(codecModulePaths(executable));
  });
  return *codec;
}

} // namespace gnomon
