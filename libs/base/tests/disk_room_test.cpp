// SPDX-License-Identifier: Apache-2.0
#include "rave/base/disk_room.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace rave {
namespace {

TEST(DiskRoom, IsTakenAndLeavesNoFile) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "rave_disk_room";
  std::filesystem::create_directories(folder);
  constexpr std::size_t kBytes = 100'000;
  const Descriptor room = take_disk_room(folder, kBytes);
  if (!room) GTEST_SKIP() << "a file system without files that have no name";
  struct stat info {};
  ASSERT_EQ(::fstat(room.get(), &info), 0);
  EXPECT_GE(static_cast<std::size_t>(info.st_blocks) * 512, kBytes);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}

TEST(DiskRoom, NoneWhereThereIsNoFolder) { EXPECT_FALSE(take_disk_room("/no/such/folder", 10)); }

}  // namespace
}  // namespace rave
