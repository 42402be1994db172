// SPDX-License-Identifier: Apache-2.0
// `rave map-server` and `rave map save` beside a run of several processes.
#include <csignal>

#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;

class Maps : public SharedWorld {
 protected:
  [[nodiscard]] Words beside(Words words) const {
    for (const std::string& word : apart()) words.push_back(word);
    return words;
  }
  [[nodiscard]] Words variables() const { return {"XDG_RUNTIME_DIR=" + folder_.path().string()}; }
  [[nodiscard]] Ended save(const Words& more) const {
    Words words = {"map", "save"};
    words.insert(words.end(), more.begin(), more.end());
    return run_rave(beside(words), variables());
  }
  /// The width and height that an image states.
  static std::string size_of(const std::string& image) {
    const std::size_t from = image.find('\n') + 1;
    return image.substr(from, image.find('\n', from) - from);
  }
};

TEST_F(Maps, AMapServerCombinesTheMapsOfAllRobots) {
  start("run", "run",
        std::string(RAVE_SOURCE_DIR) + "/scenarios/collaborative-mapping/scenario.yaml",
        {"--processes", "2", "--pace", "realtime", "--no-record", "--no-picture"});
  const std::string said = folder("said");
  const pid_t server = start_rave(beside({"map-server"}), variables(), said);
  wait_until([&] { return content_of(said).find("maps of 3 robots") != std::string::npos; },
             "the map server has heard all robots");
  const std::string base = folder("floor");
  const Ended global = save({"-o", base + ".yaml"});
  EXPECT_EQ(global.exit_code, 0) << global.err;
  EXPECT_NE(global.out.find("cells of 0.05 m"), std::string::npos) << global.out;
  const std::string image = content_of(base + ".pgm");
  EXPECT_EQ(image.substr(0, 2), "P5");
  EXPECT_NE(image.find('\xfe', 20), std::string::npos) << "something is free";
  EXPECT_NE(content_of(base + ".yaml").find("image: floor.pgm"), std::string::npos);
  const Ended local = save({"--map", "patton", "-o", folder("patton")});
  EXPECT_EQ(local.exit_code, 0) << local.err;
  EXPECT_EQ(size_of(content_of(folder("patton") + ".pgm")), "512 512");
  const Ended none = save({"--map", "nobody"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("no map `nobody`; known: de-gaulle, global, patton, rommel"),
            std::string::npos)
      << none.err;
  ASSERT_EQ(::kill(server, SIGINT), 0);
  EXPECT_EQ(wait_for(server), 0);
  EXPECT_NE(content_of(said).find("map server: ended; maps of 3 robots"), std::string::npos);
  EXPECT_EQ(run_rave({"end"}, variables()).exit_code, 0);
  EXPECT_EQ(end_of("run"), 0) << console("run");
  // What the hosts know comes together in the results.
  EXPECT_EQ(result("run")["maps"]["robots"].size(), 3U);
  EXPECT_GT(result("run")["maps"]["global"]["known_m2"], 1);
}

TEST_F(Maps, WithoutARunTheySaySo) { EXPECT_EQ(save({}).exit_code, 2); }

}  // namespace
}  // namespace rave::cli_test
