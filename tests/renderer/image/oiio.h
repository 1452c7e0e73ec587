#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <memory>
#include <string_view>
#include <vector>

#include "renderer/image/image.h"

namespace gnomon {

inline bool isExr(std::string_view format) {
  return format == "openexr";
}

/// A file that OpenImageIO writes. `pixels`: of the type, as the spec says.
inline Bytes writtenByOiio(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* pixels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  EXPECT_TRUE(output && output->set_ioproxy(&memory) && output->open(isExr(format) ? "exr" : format, spec) &&
              output->write_image(type, pixels) && output->close())
      << format << ": " << OIIO::geterror();
  return {bytes.begin(), bytes.end()};
}

/// A file that OpenImageIO has opened with its alpha as the file has it; without a reader where it does not open.
struct OiioFile {
  OiioFile(const char* format, const Bytes& file) : bytes(file), memory(bytes.data(), bytes.size()) {
    OIIO::ImageSpec asked;
    if (!isExr(format)) asked.attribute("oiio:UnassociatedAlpha", 1);
    input = OIIO::ImageInput::create(format);
    if (input && input->set_ioproxy(&memory) && input->open(isExr(format) ? "exr" : format, spec, asked)) return;
    ADD_FAILURE() << format << " does not open: " << (input ? input->geterror() : OIIO::geterror());
    input.reset();
  }

  Bytes bytes;
  OIIO::Filesystem::IOMemReader memory;
  OIIO::ImageSpec spec;
  std::unique_ptr<OIIO::ImageInput> input;
};

} // namespace gnomon
