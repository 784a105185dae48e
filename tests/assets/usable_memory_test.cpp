#include "assets/import/usable_memory.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace foretouch::internal {
namespace {

/// What stands in for /sys/fs/cgroup.
class UsableMemory : public ::testing::Test {
 protected:
  void limit(const std::string& file, const std::string& text) const {
    const std::filesystem::path path = folder_ / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text << "\n";
  }
  [[nodiscard]] std::optional<std::size_t> of(const std::string& membership) const {
    return groupLimit(membership, folder_.path());
  }
  test::TempFolder folder_;
};

TEST_F(UsableMemory, IsTheLeastLimitOfAGroupAndThoseAroundIt) {
  limit("memory.max", "4000000000");
  limit("a/memory.max", "3000000");
  limit("a/b/memory.max", "max");
  limit("a/b/c/memory.max", "5000000");
  limit("other/memory.max", "7");
  EXPECT_EQ(of("0::/a/b/c\n"), 3'000'000u);
  EXPECT_EQ(of("0::/a\n"), 3'000'000u);
  EXPECT_EQ(of("0::/\n"), 4'000'000'000u);
  EXPECT_EQ(of("0::/a/b/c/d"), 3'000'000u);  // a group that is not to be seen here
}

TEST_F(UsableMemory, ReadsTheOlderVersionAndBothTogether) {
  limit("memory/memory.limit_in_bytes", "9223372036854771712");
  limit("memory/docker/x/memory.limit_in_bytes", "536870912");
  limit("unified/user/memory.max", "1");  // memory is of the older version here
  const std::string both = "5:cpu,cpuacct:/user\n4:memory:/docker/x\n0::/user\n";
  EXPECT_EQ(of(both), 536'870'912u);
  EXPECT_EQ(of("3:hugetlb,memory:/docker\n"), 9'223'372'036'854'771'712u);
  // In a container: the path is the host's, the files are the container's own.
  limit("memory/memory.limit_in_bytes", "268435456");
  EXPECT_EQ(of("4:memory:/lxc/17/deep\n"), 268'435'456u);
}

TEST_F(UsableMemory, HasNoLimitWhereNoneIsSaid) {
  limit("memory.max", "max");
  limit("a/memory.max", "");
  for (const char* membership : {"", "0::/\n", "0::/a", "nonsense", "::", "5:cpu:/\n",
                                 "4:memoryless:/\n", "0::/../../..", "4:memory:/a"}) {
    EXPECT_EQ(of(membership), std::nullopt) << membership;
  }
}

TEST_F(UsableMemory, IsNoMoreThanTheMachineHas) {
  const auto pages = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES));
  const auto usable = usableMemory();
  ASSERT_TRUE(usable.has_value());
  EXPECT_GT(*usable, 0u);
  EXPECT_LE(*usable, pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
}

}  // namespace
}  // namespace foretouch::internal
