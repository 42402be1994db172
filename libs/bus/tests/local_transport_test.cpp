// SPDX-License-Identifier: Apache-2.0
// The local transport between two buses of one machine: what takes it, and what is refused.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <stop_token>
#include <thread>

#include "local_transport_pair.hpp"
#include "rave/base_testing/no_threads.hpp"
#include "rave/bus/wait_set.hpp"

namespace rave::bus::testing {
namespace {

TEST(LocalTransport, SmallSamplesTakeItAndLargeOnesDoNot) {
  const Pair pair;
  EXPECT_TRUE(pair.connected());
  EXPECT_TRUE(eventually([&] { return !pair.comes_short(kMostLocalBytes); }));
}

TEST(LocalTransport, WhoHasNoneIsReachedByDds) {
  const Pair pair(false);
  EXPECT_FALSE(pair.comes_short());
  // Also if somebody has its address, to get what is for it.
  const auto thief = LocalSocket::open({pair.domain.run, pair.right->writer(), kWorldStep});
  ASSERT_TRUE(thief);
  EXPECT_FALSE(pair.comes_short());
}

TEST(LocalTransport, AWaitSetWakesFromBoth) {
  const Pair pair;
  auto waits = WaitSet::create(*pair.right);
  ASSERT_TRUE(waits && waits->add(*pair.reader));
  for (int i = 0; i < 3; ++i) {
    // After one that was too big for it some are not tried.
    ASSERT_TRUE(pair.connected());
    pair.reader->take([](const WorldStep&) {});
    pair.send(1000);
    EXPECT_EQ(waits->wait(Duration{10'000'000'000}), Woken::kReady);
    EXPECT_EQ(waits->wait(Duration{0}), Woken::kReady);
    EXPECT_GE(pair.reader->take([](const WorldStep&) {}), 1U);
    pair.send(1001, kMostLocalBytes);
    EXPECT_EQ(waits->wait(Duration{10'000'000'000}), Woken::kReady);
    EXPECT_GE(pair.reader->take([](const WorldStep&) {}), 1U);
    waits->ring();
    EXPECT_EQ(waits->wait(Duration{10'000'000'000}), Woken::kReady);
  }
}

TEST(LocalTransport, AWaitSetWithoutAThreadIsAnError) {
  const Pair pair;
  auto waits = WaitSet::create(*pair.right);
  ASSERT_TRUE(waits);
  const base_testing::NoThreads none;
  const Status added = waits->add(*pair.reader);
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find("cannot start the thread of a wait set"), std::string::npos)
      << added.error().text();
}

TEST(LocalTransport, ASleepEndsByTimeBellDatagramAndStop) {
  const Pair pair;
  auto waits = WaitSet::create(*pair.right);
  ASSERT_TRUE(waits && waits->add(*pair.reader));
  ASSERT_TRUE(pair.connected());
  std::uint64_t last = 0;
  const auto take = [&] { pair.reader->take([&](const WorldStep& world) { last = world.step; }); };
  // The first samples went by DDS, and some of them may come at any time.
  while (waits->wait(Duration{1'000'000}) != Woken::kTimeout) take();
  // Longer than anybody looks before he sleeps.
  constexpr std::chrono::milliseconds kLater{5};
  {
    const std::jthread other([&] { std::this_thread::sleep_for(kLater), waits->ring(); });
    EXPECT_EQ(waits->wait(Duration{-1}), Woken::kReady);
  }
  {
    const std::jthread other([&] { std::this_thread::sleep_for(kLater), pair.send(1000); });
    while (last != 1000 && waits->wait(Duration{-1}) == Woken::kReady) take();
    EXPECT_EQ(last, 1000U);
  }
  std::stop_source stop;
  const std::jthread other([&] { std::this_thread::sleep_for(kLater), stop.request_stop(); });
  Woken woken = Woken::kReady;
  while (woken == Woken::kReady) {
    take();
    woken = waits->wait(Duration{-1}, stop.get_token());
  }
  EXPECT_EQ(woken, Woken::kStopped);
}

TEST(LocalTransport, WhatComesByDdsIsNotLeftLyingWhileDatagramsCome) {
  const Pair pair;
  BusConfig config = pair.domain.config("far");
  config.beside = true;
  config.local_transport = false;
  const auto far = Bus::open(config);
  ASSERT_TRUE(far) << far.error().text();
  auto far_writer = Writer<WorldStep>::create(**far);
  auto waits = WaitSet::create(*pair.right);
  ASSERT_TRUE(far_writer && waits && waits->add(*pair.reader));
  ASSERT_TRUE(pair.connected());
  ASSERT_TRUE(
      eventually([&] { return far_writer->readers() == 1 && pair.reader->writers() == 2; }));
  for (std::uint64_t step = 1; step <= 20; ++step) {
    WorldStep world{};
    world.epoch = 1;
    world.step = step;
    ASSERT_TRUE(far_writer->write(world));
    std::uint64_t heard = 0;
    EXPECT_TRUE(eventually([&] {
      pair.send(1000);
      EXPECT_EQ(waits->wait(Duration{10'000'000'000}), Woken::kReady);
      pair.reader->take([&](const WorldStep& came) {
        if (came.writer == (*far)->writer()) heard = came.step;
      });
      return heard == step;
    })) << step;
  }
}

/// A receiver, and a socket that sends to it.
struct ReceiverWithSender {
  RunId run = RunId::random();
  LocalAddress address{run, 1, kWorldStep};
  LocalReceiver receiver{topic_of<WorldStep>(), run, *LocalSocket::open(address)};
  std::optional<LocalSocket> sender = LocalSocket::open({run, 2, 0});

  void send(std::string_view bytes) const {
    EXPECT_EQ(::sendto(sender->descriptor(), bytes.data(), bytes.size(), 0,
                       reinterpret_cast<const sockaddr*>(&address.name), address.size),
              static_cast<ssize_t>(bytes.size()));
  }
  /// Somebody waits and is woken by this.
  void wake() {
    send("x");
    EXPECT_TRUE(receiver.fetch());
  }
  /// The text of the next datagram; "none" if there is none.
  std::string next() {
    const auto got = receiver.receive();
    if (!got) return "none";
    return {reinterpret_cast<const char*>(got->bytes.data()), got->bytes.size()};
  }
};

TEST(LocalTransport, WhatEndedAWaitIsReceivedOnceAndInItsTurn) {
  ReceiverWithSender link;
  EXPECT_FALSE(link.receiver.fetch());
  link.send("first");
  link.send("second");
  EXPECT_TRUE(link.receiver.fetch());
  EXPECT_TRUE(link.receiver.fetch()) << "nobody has taken it";
  EXPECT_EQ(link.next(), "first");
  EXPECT_EQ(link.next(), "second");
  EXPECT_EQ(link.next(), "none");
  EXPECT_FALSE(link.receiver.fetch());
  link.send("");
  EXPECT_TRUE(link.receiver.fetch()) << "an empty one is one, too";
  EXPECT_EQ(link.next(), "");
  EXPECT_EQ(link.next(), "none");
}

TEST(LocalTransport, WhoSentWhatEndedAWaitIsSaidWhenItIsReceived) {
  ReceiverWithSender link;
  link.wake();
  link.receiver.meet({2, 3});
  const auto first = link.receiver.receive();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->writer, 2U) << "known since";
  link.wake();
  link.receiver.meet({3});
  const auto last = link.receiver.receive();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->writer, 2U) << "its last words";
}

TEST(LocalTransport, OnlyATakeThatADatagramWokeLeavesDdsAlone) {
  ReceiverWithSender link;
  LocalReceiver& receiver = link.receiver;
  EXPECT_EQ(receiver.begin_take(100), 100U) << "nobody has waited";
  EXPECT_FALSE(receiver.leaves_dds(true));
  link.wake();
  EXPECT_EQ(receiver.begin_take(100), 1U);
  EXPECT_TRUE(receiver.leaves_dds(true));
  EXPECT_EQ(receiver.begin_take(100), 100U) << "not again";
  EXPECT_FALSE(receiver.leaves_dds(true));
  link.wake();
  receiver.note_dds();
  EXPECT_EQ(receiver.begin_take(100), 1U);
  EXPECT_FALSE(receiver.leaves_dds(true)) << "there is something";
  link.wake();
  EXPECT_EQ(receiver.begin_take(100), 1U);
  EXPECT_FALSE(receiver.leaves_dds(false)) << "it was for nobody";
  receiver.meet({2, 3});
  link.wake();
  EXPECT_EQ(receiver.begin_take(100), 100U) << "of two there may be two";
  EXPECT_TRUE(receiver.leaves_dds(true));
}

TEST(LocalTransport, AFullQueueGoesByDdsAndTheNewestArrives) {
  const Pair pair;
  ASSERT_TRUE(pair.connected());
  // More than any system keeps in a queue.
  constexpr std::uint64_t kLast = 10'000;
  for (std::uint64_t step = 1; step <= kLast; ++step) pair.send(step);
  std::uint64_t newest = 0;
  bool by_dds = false;
  EXPECT_TRUE(eventually([&] {
    pair.reader->take([&](const WorldStep& world, const dds_sample_info_t& info) {
      newest = std::max(newest, world.step);
      by_dds = by_dds || info.publication_handle != 0;
    });
    return newest == kLast;
  }));
  EXPECT_TRUE(by_dds);
  EXPECT_TRUE(pair.connected());
}

TEST(LocalTransport, WhenAReaderIsKilledTheOthersMissNothing) {
  Followed run;
  PeerProcess victim(run.domain, "follow", "victim", {"host=1"});
  PeerProcess other(run.domain, "follow", "other", {"host=2", "lease_s=20"});
  ASSERT_EQ(victim.line(), "ready");
  ASSERT_EQ(other.line(), "ready");
  ASSERT_TRUE(run.goes_locally({1, 2}));
  victim.kill();
  // Once, and not again until it has come: its death is not known yet.
  run.send();
  EXPECT_TRUE(eventually([&] { return run.listen(), run.last[2].step == run.step; }));
  // When it is missed, all that are left are near.
  EXPECT_TRUE(run.goes_locally({2}));
  EXPECT_EQ(other.end(), 0);
}

TEST(LocalTransport, WhatStrangersThrowIsRefused) {
  const Pair pair;
  ASSERT_TRUE(pair.connected());
  const LocalAddress stranger(pair.domain.run, 77, 0);
  for (const std::string& bytes : {std::string("hello"), std::string(), datagram(WorldStep{}),
                                   std::string(kMostLocalBytes + 1, 'x')}) {
    const auto before = pair.right->foreign_samples();
    const auto came = pair.throw_bytes(stranger, bytes);
    if (!came) continue;
    EXPECT_EQ(*came, 0U);
    EXPECT_EQ(pair.right->foreign_samples(), before + 1) << bytes.size() << " bytes";
  }
  EXPECT_TRUE(pair.connected());
}

TEST(LocalTransport, WhatAKnownProcessSendsIsJudgedLikeASampleOfDds) {
  // The writer has no local transport, so its address is free for what the test throws in its name.
  const Pair pair(true, false);
  ASSERT_TRUE(eventually([&] { return pair.reader->writers() == 1; }));
  const LocalAddress writer(pair.domain.run, pair.left->writer(), 0);
  WorldStep world{};
  world.epoch = 1;
  world.writer = pair.left->writer();
  std::ranges::copy(pair.domain.run.bytes, world.run);
  EXPECT_EQ(pair.throw_bytes(writer, datagram(world)), 1U);
  EXPECT_EQ(pair.right->refused_samples(), 0U);
  EXPECT_EQ(pair.throw_bytes(writer, kHead), 0U) << "a head without a sample";
  EXPECT_EQ(pair.right->refused_samples(), 1U);
  world.epoch = 0;
  EXPECT_EQ(pair.throw_bytes(writer, datagram(world)), 0U) << "validation refuses it";
  EXPECT_EQ(pair.right->refused_samples(), 2U);
  world.epoch = 1;
  world.run[0] = static_cast<std::uint8_t>(world.run[0] ^ 1U);
  const auto before = pair.right->foreign_samples();
  EXPECT_EQ(pair.throw_bytes(writer, datagram(world)), 0U) << "of another run";
  EXPECT_EQ(pair.right->foreign_samples(), before + 1);
}

TEST(LocalTransport, AProcessOfAnotherRunIsAStranger) {
  const Pair pair(true, false);
  ASSERT_TRUE(eventually([&] { return pair.reader->writers() == 1; }));
  const auto before = pair.right->foreign_samples();
  WorldStep world{};
  world.epoch = 1;
  world.writer = pair.left->writer();
  std::ranges::copy(pair.domain.run.bytes, world.run);
  const LocalAddress elsewhere(RunId::random(), pair.left->writer(), 0);
  EXPECT_EQ(pair.throw_bytes(elsewhere, datagram(world)), 0U);
  EXPECT_EQ(pair.right->foreign_samples(), before + 1);
}

TEST(LocalTransport, IsOpenWithoutCertificatesAlone) {
  // With them: Security.NothingGoesBesideTheCertificates.
  const Pair pair;
  EXPECT_FALSE(LocalSocket::open({pair.domain.run, pair.left->writer(), 0}));
  EXPECT_FALSE(LocalSocket::open({pair.domain.run, pair.right->writer(), kWorldStep}));
}

TEST(LocalTransport, BytesThatAreNoSampleAreRefused) {
  LocalDecoder decoder(topic_of<WorldStep>());
  alignas(8) std::array<std::byte, 64> bytes{};
  EXPECT_EQ(decoder.decode(bytes), nullptr);
  const std::string head("ravesw\1\2", 8);
  std::transform(head.begin(), head.end(), bytes.begin(), [](char c) { return std::byte(c); });
  EXPECT_EQ(decoder.decode(bytes), nullptr);
  EXPECT_EQ(decoder.decode(std::span(bytes).first(8)), nullptr);
  EXPECT_EQ(decoder.decode(std::span(bytes).first(3)), nullptr);
}

}  // namespace
}  // namespace rave::bus::testing
