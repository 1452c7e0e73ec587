#include "renderer/scene/checks/typed_model.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <string>

namespace gnomon {
namespace {

TEST(TypedModel, TinyGltfIsNotTheOneInsideDraco) {
  // bool tinygltf::TinyGLTF::LoadASCIIFromString(Model*, string*, string*, char const*, unsigned, string const&,
  // unsigned)
  void* function = dlsym(RTLD_DEFAULT,
                         "_ZN8tinygltf8TinyGLTF19LoadASCIIFromStringEPNS_5ModelEPNSt7__cxx1112basic_"
                         "stringIcSt11char_traitsIcESaIcEEES9_PKcjRKS8_j");
  ASSERT_NE(function, nullptr);
  Dl_info place{};
  ASSERT_NE(dladdr(function, &place), 0);
  EXPECT_NE(std::string(place.dli_fname).find("libtinygltf"), std::string::npos) << place.dli_fname;
}

} // namespace
} // namespace gnomon
