#include "renderer/core/cpu_quota.h"

#include <fstream>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

class CpuQuota : public testing::Test {
 protected:
  std::filesystem::path root_ =
      std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override { std::filesystem::remove_all(root_); }
  void TearDown() override { std::filesystem::remove_all(root_); }
};

TEST_F(CpuQuota, readsCpuMax) {
  EXPECT_EQ(coresOfCpuMax("150000 100000\n"), 1.5);
  EXPECT_EQ(coresOfCpuMax("max 100000\n"), std::nullopt);
  EXPECT_EQ(coresOfCpuMax("-1 100000"), std::nullopt);
  EXPECT_EQ(coresOfCpuMax("1000 0"), std::nullopt);
  EXPECT_EQ(coresOfCpuMax(""), std::nullopt);
}

TEST_F(CpuQuota, takesTheTightestOfTheAncestors) {
  write(root_ / "a/cpu.max", "200000 100000");
  write(root_ / "a/b/cpu.max", "400000 100000");
  EXPECT_EQ(coresGranted(root_, "0::/a/b\n"), 2.0);
  EXPECT_EQ(coresGranted(root_, "0::/c\n"), std::nullopt);
}

TEST_F(CpuQuota, takesTheMountOfAContainer) {
  write(root_ / "cpu.max", "50000 100000");
  EXPECT_EQ(coresGranted(root_, "0::/\n"), 0.5);
  EXPECT_EQ(coresGranted(root_, "0::/../../outside\n"), 0.5);
}

TEST_F(CpuQuota, knowsVersionOne) {
  write(root_ / "cpu/job/cpu.cfs_quota_us", "300000\n");
  write(root_ / "cpu/job/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(coresGranted(root_, "5:memory:/job\n4:cpu,cpuacct:/job\n"), 3.0);
  EXPECT_EQ(coresGranted(root_, "5:cpuset:/job\n"), std::nullopt);
  EXPECT_EQ(coresGranted(root_, "nonsense"), std::nullopt);
}

} // namespace
} // namespace gnomon
