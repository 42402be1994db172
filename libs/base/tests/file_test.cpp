// SPDX-License-Identifier: Apache-2.0
#include "rave/base/file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rave {
namespace {

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("rave_file_test_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(FileTest, WritesAndReadsBackAllBytes) {
  const std::string content("a\0b\nc", 5);
  ASSERT_TRUE(write_file_atomically(folder_ / "x", content));
  EXPECT_EQ(read_file(folder_ / "x").value(), content);
}

TEST_F(FileTest, PrivateFilesAreOfTheUserAlone) {
  const auto mode_of = [](const std::filesystem::path& file) {
    struct stat about {};
    EXPECT_EQ(::stat(file.c_str(), &about), 0);
    return about.st_mode & 07777U;
  };
  const ::mode_t before = ::umask(0);
  EXPECT_TRUE(write_private_file(folder_ / "a", "secret"));
  EXPECT_TRUE(write_private_file_atomically(folder_ / "b", "secret"));
  EXPECT_TRUE(write_file_atomically(folder_ / "c", "open"));
  ::umask(before);
  EXPECT_EQ(mode_of(folder_ / "a"), 0600U);
  EXPECT_EQ(mode_of(folder_ / "b"), 0600U);
  EXPECT_EQ(mode_of(folder_ / "c"), 0644U);
  EXPECT_TRUE(check_private_file(folder_ / "a"));
  EXPECT_TRUE(check_private_file(folder_ / "none"));
  for (const ::mode_t open : {0604U, 0640U, 0620U, 0602U, 0601U}) {
    ASSERT_EQ(::chmod((folder_ / "a").c_str(), open), 0);
    const Status checked = check_private_file(folder_ / "a");
    ASSERT_FALSE(checked) << open;
    EXPECT_EQ(checked.error().message, "other users can read the private key `" +
                                           (folder_ / "a").string() + "`; run `chmod 600 " +
                                           (folder_ / "a").string() + "`");
  }
}

TEST_F(FileTest, AFailedWriteLeavesNothingBehind) {
  std::filesystem::create_directories(folder_ / "target" / "occupied");
  const auto status = write_file_atomically(folder_ / "target", "new");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++entries;
  EXPECT_EQ(entries, 1U);
}

/// Nobody ever writes to it: whoever waited for that would wait for ever.
TEST_F(FileTest, ANamedPipeIsRefusedAndNotWaitedFor) {
  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto text = read_file(pipe);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::kIo);
  EXPECT_EQ(text.error().message, "cannot read `" + pipe.string() + "`: it is not a regular file");
  EXPECT_EQ(read_file("/dev/null").error().code, ErrorCode::kIo);
}

TEST_F(FileTest, SaysWhatIsWrong) {
  EXPECT_EQ(read_file(folder_ / "none").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_file(folder_).error().code, ErrorCode::kIo);
  ASSERT_TRUE(write_file_atomically(folder_ / "x", "12345"));
  EXPECT_EQ(read_file(folder_ / "x", 4).error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace rave
