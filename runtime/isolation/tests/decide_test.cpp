// SPDX-License-Identifier: Apache-2.0
// An isolated program does what it does in the host.

#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "support.hpp"

namespace rave::isolation {
namespace {

/// The program in this process, as the host would run it.
class InProcess final : RegistrySink {
 public:
  InProcess(const std::string& plugin, const ProgramSetup& setup) {
    handle_ = ::dlopen(plugin_file(plugin).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ == nullptr) return;
    auto entry =
        reinterpret_cast<void (*)(RegistrySink*)>(::dlsym(handle_, "rave_register_plugin"));
    entry(this);
    memory_.resize(ops_->instance.size / sizeof(std::max_align_t) + 1);
    ErrorText error;
    EXPECT_EQ(ops_->instance.construct(memory_.data(), &error), 0) << error.text;
    EXPECT_EQ(ops_->start(memory_.data(), &setup, &error), 0) << error.text;
  }
  InProcess(const InProcess&) = delete;
  InProcess& operator=(const InProcess&) = delete;
  ~InProcess() {
    if (ops_ != nullptr) ops_->instance.destroy(memory_.data());
    if (handle_ != nullptr) ::dlclose(handle_);
  }
  void decide(const DecideItem& item) {
    std::uint8_t failed = 0;
    ErrorText error;
    ops_->decide(memory_.data(), ops_->instance.size, &item, 1, &failed, &error);
    EXPECT_EQ(failed, 0) << error.text;
  }
  int update(const ProgramSetup& setup) {
    ErrorText error;
    return ops_->update(memory_.data(), setup.params, setup.param_count, &error);
  }
  [[nodiscard]] bool loaded() const { return ops_ != nullptr; }

 private:
  void add(const DriverInfo&, const void* ops) override {
    ops_ = static_cast<const ProgramOps*>(ops);
  }
  void* handle_ = nullptr;
  const ProgramOps* ops_ = nullptr;
  std::vector<std::max_align_t> memory_;
};

bool same_bits(const std::vector<Command>& a, const std::vector<Command>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Command)) == 0;
}

bool same_messages(const Mailbox& a, const Mailbox& b) {
  if (a.count != b.count || a.bytes != b.bytes || a.dropped != b.dropped) return false;
  return std::memcmp(a.data, b.data, a.bytes) == 0 &&
         std::memcmp(a.heads, b.heads, a.count * sizeof(rave::MessageHead)) == 0;
}

TEST(IsolatedProgram, TakesNewParametersAsInTheHost) {
  TestRobot inside;
  ProgramSetup inside_setup = inside.setup();
  InProcess reference("echo", inside_setup);
  ASSERT_TRUE(reference.loaded());
  TestRobot outside;
  const auto program = IsolatedProgram::start(options_for("echo", "echo"), outside.setup());
  ASSERT_TRUE(program) << program.error().text();
  const auto both_decide = [&](std::uint32_t k) {
    const DecideItem item = outside.item(k);
    reference.decide(inside.item(k));
    EXPECT_TRUE((*program)->begin_decide(item));
    EXPECT_TRUE((*program)->end_decide(item));
    EXPECT_TRUE(same_bits(outside.commands, inside.commands)) << k;
  };
  both_decide(1);
  const std::vector<Command> before = inside.commands;
  inside.params[0].number = 2.5;
  inside_setup.robot.radius_m = 0.7;
  ASSERT_EQ(reference.update(inside_setup), 0);
  ASSERT_TRUE((*program)->update(inside.params, 0.7));
  both_decide(2);
  EXPECT_FALSE(same_bits(inside.commands, before));
  // Refused: all as it was, and the conversation goes on.
  std::array<ParamValue, 3> bad;
  std::copy(inside.params.begin(), inside.params.end(), bad.begin());
  bad[0].number = -1;
  const Status refused = (*program)->update(bad, 0.9);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().message, "a negative gain");
  both_decide(3);
  ASSERT_EQ(reference.update(inside_setup), 0);
  ASSERT_TRUE((*program)->update(inside.params, 0.7));
  both_decide(4);
  const std::string long_text(10'000, 'x');
  bad[0].number = 1;
  bad[1].text = long_text.c_str();
  EXPECT_EQ((*program)->update(bad, 0.7).error().code, ErrorCode::kInvalidArgument);
  EXPECT_TRUE((*program)->begin_decide(outside.item(5)));
  EXPECT_EQ((*program)->update(inside.params, 0.7).error().code, ErrorCode::kState);
  EXPECT_TRUE((*program)->end_decide(outside.item(5)));
}

TEST(IsolatedProgram, DecidesBitForBitAsInTheHost) {
  TestRobot inside;
  TestRobot outside;
  const ProgramSetup setup = inside.setup();
  InProcess reference("echo", setup);
  ASSERT_TRUE(reference.loaded());
  const auto program = IsolatedProgram::start(options_for("echo", "echo"), outside.setup());
  ASSERT_TRUE(program) << program.error().text();
  EXPECT_EQ(outside.log, inside.log);
  EXPECT_EQ(outside.log, std::vector<std::string>{"hello"});
  std::vector<Command> before;
  for (std::uint32_t k = 0; k < 1000; ++k) {
    reference.decide(inside.item(k));
    ASSERT_TRUE((*program)->begin_decide(outside.item(k)));
    const Status status = (*program)->end_decide(outside.item(k));
    ASSERT_TRUE(status) << status.error().text();
    ASSERT_TRUE(same_bits(inside.commands, outside.commands)) << "decision " << k;
    ASSERT_TRUE(same_messages(inside.out, outside.out)) << "decision " << k;
    ASSERT_GE(outside.out.count + outside.out.dropped, 1 + k % 4);
    ASSERT_FALSE(same_bits(before, outside.commands));
    before = outside.commands;
  }
}

TEST(IsolatedProgram, CommandsThatAreNotGivenStayAsTheyWere) {
  TestRobot robot;
  const auto program = IsolatedProgram::start(options_for("faults", "talks"), robot.setup());
  ASSERT_TRUE(program) << program.error().text();
  robot.commands[0] = velocity_command(1, 2);
  ASSERT_TRUE((*program)->begin_decide(robot.item(0)));
  ASSERT_TRUE((*program)->end_decide(robot.item(0)));
  EXPECT_EQ(robot.commands[0], velocity_command(1, 2));
  EXPECT_EQ(robot.commands[1], Command{});
}

TEST(IsolatedProgram, LogLinesComeInOrderAndThoseTooManyAreCounted) {
  TestRobot robot;
  const auto program = IsolatedProgram::start(options_for("faults", "talks"), robot.setup());
  ASSERT_TRUE(program) << program.error().text();
  for (std::uint32_t k = 0; k < 3; ++k) {
    robot.log.clear();
    ASSERT_TRUE((*program)->begin_decide(robot.item(k)));
    EXPECT_TRUE(robot.log.empty());
    ASSERT_TRUE((*program)->end_decide(robot.item(k)));
    ASSERT_EQ(robot.log.size(), 65U);
    EXPECT_EQ(robot.log[0], "line 0");
    EXPECT_EQ(robot.log[63], "line 63");
    EXPECT_EQ(robot.log[64], "dropped 36 surplus log lines of one decision");
  }
}

TEST(IsolatedProgram, CallsOutOfTurnAreRefused) {
  TestRobot robot;
  const auto program = IsolatedProgram::start(options_for("echo", "echo"), robot.setup());
  ASSERT_TRUE(program) << program.error().text();
  EXPECT_EQ((*program)->end_decide(robot.item(0)).error().text(),
            "no decision of the program was started");
  ASSERT_TRUE((*program)->begin_decide(robot.item(0)));
  EXPECT_EQ((*program)->begin_decide(robot.item(0)).error().text(),
            "the program is still deciding");
  ASSERT_TRUE((*program)->end_decide(robot.item(0)));
  const DecideItem item = robot.item(1);
  robot.headers[1].count = 4;
  EXPECT_EQ((*program)->begin_decide(item).error().text(),
            "sensor 1 has 4 records; expected at most 3");
  EXPECT_TRUE((*program)->begin_decide(robot.item(1)));
  EXPECT_TRUE((*program)->end_decide(robot.item(1)));
}

TEST(IsolatedProgram, FiftyDecideAtOnceAndAllEnd) {
  std::vector<std::unique_ptr<TestRobot>> robots;
  std::vector<std::unique_ptr<IsolatedProgram>> programs;
  for (int i = 0; i < 50; ++i) {
    robots.push_back(std::make_unique<TestRobot>("robot" + std::to_string(i)));
    auto program = IsolatedProgram::start(options_for("echo", "echo"), robots.back()->setup());
    ASSERT_TRUE(program) << program.error().text();
    programs.push_back(*std::move(program));
  }
  for (std::uint32_t k = 0; k < 20; ++k) {
    for (std::size_t i = 0; i < 50; ++i) {
      ASSERT_TRUE(programs[i]->begin_decide(robots[i]->item(k)));
    }
    for (std::size_t i = 0; i < 50; ++i) {
      ASSERT_TRUE(programs[i]->end_decide(robots[i]->item(k)));
      ASSERT_TRUE(same_bits(robots[i]->commands, robots[0]->commands));
    }
  }
  const pid_t first = programs[0]->process_id();
  ASSERT_GT(first, 0);
  programs.clear();
  EXPECT_EQ(::kill(first, 0), -1);
  // No child is left behind, dead or alive.
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
}

/// A process between this one and the isolated program dies without a chance to clean up; the
/// program, in an endless loop by then, must go as well.
TEST(IsolatedProgram, EndsWithItsHost) {
  int answer[2];
  ASSERT_EQ(::pipe(answer), 0);
  // Orphans come to us instead of to the init process, so that we can wait for them.
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0), 0);
  const pid_t host = ::fork();
  ASSERT_GE(host, 0);
  if (host == 0) {
    TestRobot robot;
    const auto program = IsolatedProgram::start(options_for("faults", "endless"), robot.setup());
    if (!program || !(*program)->begin_decide(robot.item(0))) ::_exit(1);
    const int id = (*program)->process_id();
    if (::write(answer[1], &id, sizeof id) != sizeof id) ::_exit(1);
    for (;;) ::pause();
  }
  int id = 0;
  ::close(answer[1]);
  ASSERT_EQ(::read(answer[0], &id, sizeof id), static_cast<ssize_t>(sizeof id));
  ::close(answer[0]);
  ASSERT_EQ(::kill(host, SIGKILL), 0);
  ASSERT_EQ(::waitpid(host, nullptr, 0), host);
  int status = -1;
  EXPECT_EQ(::waitpid(id, &status, 0), id);  // Hangs, and so fails, if the program stays.
  EXPECT_TRUE(WIFEXITED(status));
  ::prctl(PR_SET_CHILD_SUBREAPER, 0, 0, 0, 0);
}

}  // namespace
}  // namespace rave::isolation
