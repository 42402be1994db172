// SPDX-License-Identifier: Apache-2.0
#include "rave/process/child.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <csignal>
#include <cstdlib>

namespace rave::process {
namespace {

constexpr std::chrono::milliseconds kForEver{-1};

ChildOptions shell(const std::string& script) {
  ChildOptions options;
  options.words = {"/bin/sh", "-c", script};
  return options;
}

/// Both ends of a pipe.
struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) ADD_FAILURE() << "no pipe";
    out = Descriptor(ends[0]);
    in = Descriptor(ends[1]);
  }
  /// What was written until all have closed the other end.
  std::string read() {
    in.reset();
    std::string text;
    std::array<char, 256> part{};
    ssize_t size = 0;
    while ((size = ::read(out.get(), part.data(), part.size())) > 0) {
      text.append(part.data(), static_cast<std::size_t>(size));
    }
    return text;
  }
  Descriptor out;
  Descriptor in;
};

std::string output_of(ChildOptions options) {
  Pipe pipe;
  options.files.push_back({pipe.in.get(), STDOUT_FILENO});
  auto child = Child::start(options);
  EXPECT_TRUE(child) << child.error().text();
  std::string text = pipe.read();
  EXPECT_EQ(child->wait(kForEver)->exit_code, 0);
  return text;
}

TEST(Child, SaysHowItEnded) {
  auto child = Child::start(shell("exit 3")).value();
  EXPECT_GT(child.id(), 0);
  const auto end = child.wait(kForEver);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->exit_code, 3);
  EXPECT_FALSE(end->signal);
  EXPECT_EQ(child.id(), 0);
  EXPECT_EQ(child.wait(kForEver)->exit_code, 3) << "asked again";
}

TEST(Child, IsWaitedForNoLongerThanTold) {
  ChildOptions endless = shell("exec cat");
  Pipe kept;
  endless.files = {{kept.out.get(), STDIN_FILENO}};
  auto child = Child::start(endless).value();
  EXPECT_FALSE(child.wait(std::chrono::milliseconds(0)));
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(kForEver)->signal, SIGTERM);
  auto other = Child::start(endless).value();
  EXPECT_EQ(other.kill().signal, SIGKILL);
  EXPECT_EQ(other.kill().signal, SIGKILL) << "a second time";
}

TEST(Child, WhatIsNotThereIsNotStarted) {
  ChildOptions options;
  options.words = {"/nowhere/at all"};
  const auto child = Child::start(options);
  ASSERT_FALSE(child);
  EXPECT_EQ(child.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(child.error().message, "cannot start `/nowhere/at all`: No such file or directory");
  EXPECT_EQ(Child::start({}).error().message, "expected a program to start");
}

TEST(Child, HasTheFilesItIsGiven) {
  Pipe first;
  Pipe second;
  ChildOptions options = shell("echo one >&3; echo two >&4; ls /proc/self/fd | wc -l");
  // Each source has the number of the other's target, or lies below.
  options.files = {{second.in.get(), 4}, {first.in.get(), 3}};
  options.no_input = true;
  options.close_from = 5;
  const std::string counted = output_of(options);
  EXPECT_EQ(first.read(), "one\n");
  EXPECT_EQ(second.read(), "two\n");
  // Standard input, output, error, 3 and 4, and the folder that `ls` reads.
  EXPECT_EQ(std::stoi(counted), 6);
}

TEST(Child, HasAnEnvironmentWithoutWhatIsTakenOut) {
  ::setenv("RAVE_TEST_KEPT", "kept", 1);
  ::setenv("RAVE_TEST_GONE", "gone", 1);
  ChildOptions options = shell("echo $RAVE_TEST_KEPT$RAVE_TEST_GONE");
  options.without_variables = {"RAVE_TEST_GONE"};
  EXPECT_EQ(output_of(options), "kept\n");
}

TEST(Child, HasAGroupAndSignalsOfItsOwn) {
  std::signal(SIGUSR1, SIG_IGN);
  ChildOptions options = shell("kill -USR1 $$; echo ignored");
  EXPECT_EQ(output_of(options), "ignored\n");
  options.default_signals = true;
  auto child = Child::start(options).value();
  EXPECT_EQ(child.wait(kForEver)->signal, SIGUSR1);
  ChildOptions grouped = shell("ps -o pgid= -p $$ | tr -d ' '; echo $$");
  grouped.own_group = true;
  const std::string text = output_of(grouped);
  const auto line = text.find('\n');
  EXPECT_EQ(text.substr(0, line + 1), text.substr(line + 1));
}

TEST(Descriptor, ClosesWhatItOwnsOnce) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  Descriptor out(ends[0]);
  Descriptor moved(std::move(out));
  EXPECT_EQ(moved.get(), ends[0]);
  EXPECT_FALSE(Descriptor());
  moved.reset();
  EXPECT_LT(::fcntl(ends[0], F_GETFD), 0);
  ::close(ends[1]);
}

TEST(Child, GetsVariablesInPlaceOfInheritedOnes) {
  ::setenv("RAVE_TEST_COLOUR", "red", 1);
  ChildOptions options =
      shell("test \"$RAVE_TEST_COLOUR $RAVE_TEST_SIZE\" = \"blue 3\" && test -n \"$PATH\"");
  options.variables = {"RAVE_TEST_COLOUR=green", "RAVE_TEST_SIZE=3", "RAVE_TEST_COLOUR=blue"};
  auto child = Child::start(options);
  ASSERT_TRUE(child.has_value()) << child.error().text();
  EXPECT_EQ(child->wait(kForEver)->exit_code, 0);
}

}  // namespace
}  // namespace rave::process
