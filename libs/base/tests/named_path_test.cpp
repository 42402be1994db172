// SPDX-License-Identifier: Apache-2.0
#include "rave/base/named_path.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace rave {
namespace {

/// The home folder is another one as long as it is there.
class Home {
 public:
  explicit Home(const char* path) : before_(std::getenv("HOME") ? std::getenv("HOME") : "") {
    ::setenv("HOME", path, 1);
  }
  Home(const Home&) = delete;
  Home& operator=(const Home&) = delete;
  ~Home() { ::setenv("HOME", before_.c_str(), 1); }

 private:
  std::string before_;
};

TEST(NamedPath, IsBesideTheFileOrAbsoluteOrAtHome) {
  const Home home("/at/ada");
  EXPECT_EQ(named_path("/maps", "lab.pgm"), "/maps/lab.pgm");
  EXPECT_EQ(named_path("/maps", "/other/lab.pgm"), "/other/lab.pgm");
  EXPECT_EQ(named_path("/maps", "~/lab.pgm"), "/at/ada/lab.pgm");
  EXPECT_EQ(named_path("/maps", "~"), "/at/ada");
  EXPECT_EQ(named_path("/maps", "~/"), "/at/ada");
  EXPECT_EQ(named_path("/maps", "~bob/lab.pgm"), "/maps/~bob/lab.pgm");
  EXPECT_EQ(named_path("/maps", "lab~"), "/maps/lab~");
}

TEST(NamedPath, WithoutAHomeFolderATildeIsAName) {
  const Home home("");
  EXPECT_EQ(named_path("/maps", "~/lab.pgm"), "/maps/~/lab.pgm");
}

}  // namespace
}  // namespace rave
