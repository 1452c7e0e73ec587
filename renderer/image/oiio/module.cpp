#include "renderer/image/oiio/module.h"

#include <OpenImageIO/imageio.h>

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

} // namespace gnomon::codec

/// The table, or null where the library could not be set up.
extern "C" __attribute__((visibility("default"))) const gnomon::codec::Table* gnomonImageCodec() {
  using namespace gnomon::codec;
  static const bool ready = setUpLibrary();
  static const Table table{kTableVersion, encodeExr, decode, decodeAlpha};
  return ready ? &table : nullptr;
}
