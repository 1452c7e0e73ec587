#include "renderer/image/oiio/module.h"

#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gnomon::codec {
namespace {

/// One thread a call: whole requests run side by side instead. No plug-in from the file system is ever read.
bool setUpLibrary() noexcept {
  try {
    return OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1) &&
           OIIO::attribute("plugin_searchpath", "");
  } catch (...) {
    return false;
  }
}

} // namespace

MemoryFile::MemoryFile() : descriptor_(memfd_create("gnomon", MFD_CLOEXEC)) {}

MemoryFile::~MemoryFile() {
  if (mapped_) munmap(mapped_, mappedSize_);
  if (valid()) close(descriptor_);
}

std::string MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

std::span<const std::uint8_t> MemoryFile::contents() {
  struct stat status {};
  if (mapped_ || fstat(descriptor_, &status) != 0 || status.st_size <= 0) return {};
  const auto size = static_cast<std::size_t>(status.st_size);
  void* mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor_, 0);
  if (mapped == MAP_FAILED) return {};
  mapped_ = mapped;
  mappedSize_ = size;
  return {static_cast<const std::uint8_t*>(mapped), size};
}

} // namespace gnomon::codec

/// The table, or null where the library could not be set up.
extern "C" __attribute__((visibility("default"))) const gnomon::codec::Table* gnomonImageCodec() {
  using namespace gnomon::codec;
  static const bool ready = setUpLibrary();
  static const Table table{kTableVersion, encodeExr, decode, decodeAlpha};
  return ready ? &table : nullptr;
}
