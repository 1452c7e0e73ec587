#include "renderer/image/codec_loader.h"

#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace gnomon {
namespace {

TEST(CodecLoader, LooksBesideTheProgramAndInTheInstalledFolder) {
  const auto paths = codecModulePaths("/opt/gnomon/bin/gnomon");
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0], "/opt/gnomon/bin/libgnomon_image_codec.so");
  EXPECT_EQ(paths[1], "/opt/gnomon/lib/gnomon/libgnomon_image_codec.so");
}

TEST(CodecLoader, SaysThatTheModuleIsMissingWithoutNamingAPath) {
  const auto codec = openCodec(codecModulePaths("/nowhere/at/all/gnomon"));
  ASSERT_FALSE(codec);
  EXPECT_EQ(codec.problems().front().code, ProblemCode::internal);
  EXPECT_NE(codec.problems().front().detail.find("libgnomon_image_codec.so"), std::string::npos);
  EXPECT_EQ(codec.problems().front().detail.find("/nowhere"), std::string::npos);
}

TEST(CodecLoader, RefusesAFileThatIsNoLibrary) {
  const std::vector<std::filesystem::path> paths{"/proc/self/status"};
  const auto codec = openCodec(paths);
  ASSERT_FALSE(codec);
  EXPECT_EQ(codec.problems().front().code, ProblemCode::internal);
}

TEST(CodecLoader, RefusesALibraryThatIsNoCodec) {
  const std::vector<std::filesystem::path> paths{"/lib/x86_64-linux-gnu/libm.so.6", "/lib/aarch64-linux-gnu/libm.so.6"};
  EXPECT_FALSE(openCodec(paths));
}

TEST(CodecLoader, GivesEveryThreadTheSameTable) {
  std::vector<const codec::Table*> tables(4, nullptr);
  {
    std::vector<std::jthread> threads;
    for (auto& table : tables) {
      threads.emplace_back([&table] {
        const auto codec = imageCodec();
        if (codec) table = *codec;
      });
    }
  }
  ASSERT_NE(tables[0], nullptr);
  for (const codec::Table* table : tables) EXPECT_EQ(table, tables[0]);
}

} // namespace
} // namespace gnomon
