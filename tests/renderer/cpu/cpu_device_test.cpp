#include "renderer/cpu/cpu_device.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <set>
#include <strings.h>

#include "renderer/rays/traced_scene.h"

namespace gnomon {
namespace {

/// The renderer's information where the environment pins the kernels to `target`, or nothing ("").
Result<RendererInfo> pinned(const char* target) {
  setenv("GNOMON_CPU_TARGET", target, 1);
  const auto device = createCpuDevice({});
  unsetenv("GNOMON_CPU_TARGET");
  if (!device) return device.problems();
  return (*device)->info();
}

TEST(CpuDevice, APinnedInstructionSetIsNamedAndInTheFingerprint) {
  std::set<std::string> fingerprints;
  std::set<std::string> names;
  for (const char* target : {"sse4", "avx2", "avx3", "neon"}) {
    const auto info = pinned(target);
    if (!info) continue; // this processor lacks it
    EXPECT_EQ(strcasecmp(info->version.c_str(), target), 0) << info->version;
    fingerprints.insert(info->fingerprint);
    names.insert(info->version);
  }
  EXPECT_FALSE(names.empty());
  EXPECT_EQ(fingerprints.size(), names.size());
}

TEST(CpuDevice, RaysAreTracedWithThePinnedInstructionSet) {
  if (!pinned("sse4")) GTEST_SKIP() << "this processor has no SSE4";
  EXPECT_NE(std::string(rayDeviceOptions()).find("max_isa=sse4.2"), std::string::npos);
  const bool avx2 = bool(pinned("avx2"));
  EXPECT_EQ(std::string(rayDeviceOptions()).find("max_isa=avx2") != std::string::npos, avx2);
  if (pinned("avx3")) {
    EXPECT_EQ(std::string(rayDeviceOptions()).find("max_isa"), std::string::npos);
  }
  ASSERT_TRUE(pinned(""));
}

TEST(CpuDevice, WithoutAPinItTakesTheBestSetAgain) {
  const auto free = pinned("");
  ASSERT_TRUE(free);
  for (const char* target : {"sse4", "neon"}) (void)pinned(target);
  const auto again = pinned("");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->version, free->version);
}

TEST(CpuDevice, AnUnknownInstructionSetIsAProblemThatListsTheKnownOnes) {
  const auto info = pinned("mmx");
  ASSERT_FALSE(info);
  const Problem& problem = info.problems().front();
  EXPECT_EQ(problem.code, ProblemCode::backend);
  EXPECT_EQ(problem.actual, "mmx");
  const auto free = pinned("");
  ASSERT_TRUE(free);
  const std::string best = problem.limit.substr(0, problem.limit.find(','));
  EXPECT_EQ(strcasecmp(best.c_str(), free->version.c_str()), 0) << problem.limit;
}

} // namespace
} // namespace gnomon
