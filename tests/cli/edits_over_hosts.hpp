// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/bus/writer.hpp"
#include "rave/record/run_reader.hpp"
#include "shared_world.hpp"
#include "stranger.hpp"

namespace rave::cli_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// A world of several processes whose obstacles are edited from another terminal.
class EditsOverHosts : public SharedWorld {
 protected:
  /// `rave` in another terminal.
  [[nodiscard]] Ended rave(const Words& words) const {
    return run_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()});
  }
  [[nodiscard]] Ended add_box(const std::string& name, const std::string& at) const {
    return rave({"edit", "add", "box", "--name", name, "--at", at, "--size", "0.5x0.3"});
  }
  void start_all(const std::string& scenario, const Words& more = {}) {
    start("env", "env", scenario, more);
    start_host("one", scenario, more);
    start_host("two", scenario, more);
  }
  /// Until the manager takes requests.
  void wait_until_it_runs() {
    wait_until([&] { return rave({"edit", "list"}).exit_code == 0; }, "it runs");
  }
  void wait_for_size(const std::string& host) {
    wait_until(
        [&] {
          std::error_code error;
          const auto size = fs::file_size(folder(host) + "/run.mcap", error);
          return !error && size > 100'000;
        },
        host + " goes on");
  }
  /// What the record of a host says was asked by hand: kind, step, and what.
  [[nodiscard]] std::vector<std::string> inputs_of(const std::string& host) const {
    std::vector<std::string> inputs;
    const auto reader = record::McapReader::open(folder(host) + "/run.mcap");
    EXPECT_TRUE(reader) << reader.error().text();
    if (!reader) return inputs;
    const auto take = [&](const record::MessageView& message) -> Status {
      RAVE_TRY_ASSIGN(const record::RunInput input, record::decode_input(message.bytes));
      inputs.push_back(fmt::format("{} {} {} {} {}", input.step, input.kind, input.robot, input.key,
                                   input.value));
      return {};
    };
    EXPECT_TRUE(record::for_each_message(*reader, record::topic::kInputs, take));
    return inputs;
  }
  void expect_verified(const std::string& host) const {
    const Ended ended = rave({"verify", folder(host)});
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
    EXPECT_NE(ended.out.find("equal: "), std::string::npos) << ended.out;
  }
};

/// A run of a known name, and a bus in this process from which anything can be sent to it.
class Garbage : public EditsOverHosts {
 protected:
  /// Sends it until the log of `who` has the text.
  template <class Message>
  void send_until(Message& message, const std::string& who, const std::string& text) {
    const auto bus = open_stranger(apart(), run_);
    ASSERT_TRUE(bus) << bus.error().text();
    auto writer = bus::Writer<Message>::create(**bus);
    ASSERT_TRUE(writer) << writer.error().text();
    wait_until(
        [&] {
          EXPECT_TRUE(writer->write(message));
          return console(who).find(text) != std::string::npos;
        },
        who + ": " + text);
  }

  bus::RunId run_ = bus::RunId::random();
};

/// An obstacle that nobody can build.
struct Nonsense {
  std::vector<double> x{0, 1, std::nan("")};
  std::vector<double> y{0, 0, 1};
  std::vector<rave_wire_BodyShape> shapes = std::vector<rave_wire_BodyShape>(1);
  std::vector<rave_wire_ObstacleChange> changes = std::vector<rave_wire_ObstacleChange>(1);

  Nonsense() {
    shapes[0].kind = rave_wire_SHAPE_POLYGON;
    shapes[0].z_max_m = 1;
    bus::borrow(shapes[0].x_m, x);
    bus::borrow(shapes[0].y_m, y);
    changes[0].id = 31;
    bus::put_text(changes[0].name, "nonsense");
    bus::borrow(changes[0].shapes, shapes);
  }
};

}  // namespace rave::cli_test
