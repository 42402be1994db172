// SPDX-License-Identifier: Apache-2.0
// What wakes the thread of a server.
#include "rave/base/bell.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>

#include "rave/web/server.hpp"

namespace rave::web {
namespace {

class Silent final : public Handler {
 public:
  Response serve(const Request&) override { return text_response(404, "not found\n"); }
  Admission admit(const Request&) override { return {4401, "not signed in"}; }
  void opened(std::uint64_t, Socket&, const Request&) override {}
  void received(std::uint64_t, std::string_view) override {}
  bool received_binary(std::uint64_t, std::string_view) override { return false; }
  void closed(std::uint64_t) override {}
};

class ServerBell : public testing::Test {
 protected:
  void SetUp() override {
    auto started = Server::start({}, handler_);
    ASSERT_TRUE(started) << started.error().text();
    server_ = *std::move(started);
  }
  /// From now on the bell counts in `rung`.
  void hear(int descriptor, std::atomic<int>& rung) {
    std::promise<void> done;
    server_->post([&] {
      server_->when_rung(descriptor, [&rung] {
        ++rung;
        rung.notify_all();
      });
      done.set_value();
    });
    done.get_future().wait();
  }
  /// All that came before is handled.
  void settle() {
    std::promise<void> done;
    server_->post([&done] { done.set_value(); });
    done.get_future().wait();
  }

  Silent handler_;
  std::unique_ptr<Server> server_;
};

TEST_F(ServerBell, IsHeardEachTimeItRings) {
  std::atomic<int> rung = 0;
  const Bell bell;
  hear(bell.descriptor(), rung);
  for (int i = 0; i < 3; ++i) {
    bell.ring();
    rung.wait(i);
    EXPECT_EQ(rung, i + 1);
  }
  settle();
  EXPECT_EQ(rung, 3);
}

TEST_F(ServerBell, OneThatRangBeforeIsHeardAtOnce) {
  std::atomic<int> rung = 0;
  const Bell bell;
  bell.ring();
  bell.ring();
  hear(bell.descriptor(), rung);
  rung.wait(0);
  settle();
  EXPECT_EQ(rung, 1);
}

TEST_F(ServerBell, IsHeardNoMoreOnceThereIsAnotherOrNone) {
  std::atomic<int> first_rung = 0;
  std::atomic<int> second_rung = 0;
  const Bell first;
  const Bell second;
  hear(first.descriptor(), first_rung);
  hear(second.descriptor(), second_rung);
  first.ring();
  second.ring();
  second_rung.wait(0);
  hear(-1, second_rung);
  second.ring();
  settle();
  EXPECT_EQ(first_rung, 0);
  EXPECT_EQ(second_rung, 1);
}

/// The run, and its bell, may go before the server is told of another.
TEST_F(ServerBell, MayGoBeforeTheServer) {
  std::atomic<int> rung = 0;
  {
    const Bell bell;
    hear(bell.descriptor(), rung);
    bell.ring();
    rung.wait(0);
  }
  settle();
  EXPECT_EQ(rung, 1);
}

}  // namespace
}  // namespace rave::web
