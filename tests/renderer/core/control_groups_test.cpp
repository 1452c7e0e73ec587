#include "renderer/core/control_groups.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using Folders = std::vector<std::filesystem::path>;

constexpr const char* kUnified =
    "30 23 0:28 / /sys/fs/cgroup rw,relatime shared:4 master:1 - cgroup2 cgroup2 rw,nsdelegate\n";
/// As a container of Docker or podman sees version 1: what is mounted begins at its own group.
constexpr const char* kContained =
    "84 76 0:46 / /sys/fs/cgroup rw,nosuid - tmpfs tmpfs rw,mode=755\n"
    "85 84 0:29 /docker/1f2e /sys/fs/cgroup/cpu,cpuacct ro,nosuid - cgroup cgroup rw,cpu,cpuacct\n"
    "88 84 0:32 /docker/1f2e /sys/fs/cgroup/memory ro,nosuid - cgroup cgroup rw,memory\n";

TEST(ControlGroups, AreTheProcesssOwnAndThoseAboveIt) {
  EXPECT_EQ(controlGroups("memory", "0::/a/b\n", kUnified),
            (Folders{"/sys/fs/cgroup", "/sys/fs/cgroup/a", "/sys/fs/cgroup/a/b"}));
  EXPECT_EQ(controlGroups("cpu", "0::/\n", kUnified), Folders{"/sys/fs/cgroup"}) << "as a container sees its own";
}

TEST(ControlGroups, OfVersionOneAreThoseOfTheController) {
  const std::string membership = "12:cpu,cpuacct:/docker/1f2e\n9:memory:/docker/1f2e\n1:name=systemd:/docker/1f2e\n";
  EXPECT_EQ(controlGroups("memory", membership, kContained), Folders{"/sys/fs/cgroup/memory"});
  EXPECT_EQ(controlGroups("cpu", membership, kContained), Folders{"/sys/fs/cgroup/cpu,cpuacct"});
  EXPECT_EQ(controlGroups("cpuset", membership, kContained), Folders{});
}

TEST(ControlGroups, OfAContainersOwnMakingAreFoundBelowWhatItSees) {
  EXPECT_EQ(controlGroups("memory", "9:memory:/docker/1f2e/job/part\n", kContained),
            (Folders{"/sys/fs/cgroup/memory", "/sys/fs/cgroup/memory/job", "/sys/fs/cgroup/memory/job/part"}));
}

TEST(ControlGroups, OfAnotherBranchAreTheMountsTopAlone) {
  for (const char* own :
       {"9:memory:/docker/1f2\n", "9:memory:/docker\n", "9:memory:/\n", "9:memory:/../../outside\n"}) {
    EXPECT_EQ(controlGroups("memory", own, kContained), Folders{"/sys/fs/cgroup/memory"}) << own;
  }
  EXPECT_EQ(controlGroups("memory", "0::/../../outside\n", kUnified), Folders{"/sys/fs/cgroup"});
}

TEST(ControlGroups, OfBothVersionsCount) {
  const std::string both =
      "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n"
      "35 31 0:32 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n";
  EXPECT_EQ(controlGroups("memory", "4:memory:/a\n0::/b\n", both),
            (Folders{"/sys/fs/cgroup/unified", "/sys/fs/cgroup/unified/b", "/sys/fs/cgroup/memory",
                     "/sys/fs/cgroup/memory/a"}));
}

TEST(ControlGroups, OfPathsWithSpacesAreFound) {
  const std::string spaced = "30 23 0:28 /my\\040jobs /mnt/control\\040groups rw - cgroup2 cgroup2 rw\n";
  EXPECT_EQ(controlGroups("cpu", "0::/my jobs/one\n", spaced),
            (Folders{"/mnt/control groups", "/mnt/control groups/one"}));
}

TEST(ControlGroups, AreNoneWhereNoneAreMountedOrNothingCanBeRead) {
  for (const char* mounts : {"", "nonsense\n", "1 2 3 / /sys/fs/cgroup rw - tmpfs tmpfs rw\n", "1 2 3 / /x rw -\n"}) {
    EXPECT_EQ(controlGroups("memory", "0::/a\n", mounts), Folders{}) << mounts;
  }
  for (const char* membership : {"", "nonsense\n", "0:\n"}) {
    EXPECT_EQ(controlGroups("memory", membership, kUnified), Folders{}) << membership;
  }
}

} // namespace
} // namespace gnomon
