// SPDX-License-Identifier: Apache-2.0
// With certificates: those who have them talk, the others get nothing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "peer_process.hpp"
#include "rave/bus/reader.hpp"

namespace rave::bus::testing {
namespace {

/// A folder with fresh certificates.
class Certificates {
 public:
  Certificates() {
    std::string name = std::filesystem::temp_directory_path() / "rave-bus-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) return;
    folder_ = name;
    const std::string command = RAVE_SOURCE_DIR "/libs/bus/tests/make_certificates.sh " + name;
    made_ = std::system(command.c_str()) == 0;
  }
  Certificates(const Certificates&) = delete;
  Certificates& operator=(const Certificates&) = delete;
  ~Certificates() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  [[nodiscard]] bool made() const { return made_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  bool made_ = false;
};

TEST(Security, ThoseWithCertificatesTalkAndTheOthersGetNothing) {
  const Certificates certificates;
  ASSERT_TRUE(certificates.made()) << "make_certificates.sh failed; it needs the program openssl";
  const TestDomain domain;
  PeerProcess member(domain, "furnish", "member",
                     {"count=2", "security=" + certificates.folder().string()});
  PeerProcess outsider(domain, "furnish", "outsider", {"count=5"});
  ASSERT_EQ(member.line(), "ready");
  ASSERT_EQ(outsider.line(), "ready");
  BusConfig config = domain.config();
  config.security = certificates.folder();
  std::size_t heard = 0;
  {
    const auto bus = Bus::open(config);
    ASSERT_TRUE(bus) << bus.error().text();
    auto reader = Reader<Obstacle>::create(**bus);
    EXPECT_TRUE(eventually([&] {
      heard += reader->take([](const Obstacle& obstacle) { EXPECT_LT(obstacle.id, 2U); });
      return heard >= 2;
    }));
    EXPECT_EQ(reader->writers(), 1U);
  }
  // And the other way round: without certificates one hears the outsider only.
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<Obstacle>::create(**bus);
  heard = 0;
  EXPECT_TRUE(eventually([&] {
    heard += reader->take([](const Obstacle&) {});
    return heard >= 5;
  }));
  EXPECT_EQ(reader->writers(), 1U);
}

TEST(Security, CertificatesThatDoNotFitAreNamed) {
  const Certificates certificates;
  ASSERT_TRUE(certificates.made()) << "make_certificates.sh failed; it needs the program openssl";
  std::ofstream(certificates.folder() / "governance.p7s") << "nothing";
  BusConfig config = TestDomain().config();
  config.security = certificates.folder();
  const auto bus = Bus::open(config);
  ASSERT_FALSE(bus);
  EXPECT_NE(bus.error().message.find("permissions"), std::string::npos) << bus.error().message;
}

}  // namespace
}  // namespace rave::bus::testing
