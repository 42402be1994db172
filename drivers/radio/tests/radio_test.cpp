// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "rave/plugin/param_set.hpp"
#include "rave/robot/plugin_entry.hpp"

extern "C" void rave_register_plugin(rave::RegistrySink* registry);

namespace rave {
namespace {

/// The driver, started with parameters that differ from the default.
class Model final : RegistrySink {
 public:
  explicit Model(const std::map<std::string, double>& given) {
    rave_register_plugin(this);
    for (const ParamSpec& spec : info_.param_specs()) {
      const auto found = given.find(spec.name);
      params_.add_number(spec.name, found == given.end() ? spec.default_number : found->second);
    }
    memory_.resize(ops_->instance.size / sizeof(std::max_align_t) + 1);
    EXPECT_EQ(ops_->instance.construct(memory_.data(), &error_), 0);
    DeviceSetup setup;
    setup.params = params_.values().data();
    setup.param_count = params_.values().size();
    started_ = ops_->start(memory_.data(), &setup, &declaration_, &error_) == 0;
  }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  ~Model() { ops_->instance.destroy(memory_.data()); }

  LinkAnswer link(const LinkQuery& query) {
    LinkAnswer answer;
    EXPECT_EQ(ops_->link(memory_.data(), &query, &answer, 1, &error_), 0) << error_.text;
    return answer;
  }
  [[nodiscard]] const RadioDeclaration& declaration() const { return declaration_; }
  [[nodiscard]] std::string error() const { return started_ ? "" : error_.text; }

 private:
  void add(const DriverInfo& info, const void* ops) override {
    info_ = info;
    ops_ = static_cast<const CommunicatorOps*>(ops);
  }
  DriverInfo info_;
  const CommunicatorOps* ops_ = nullptr;
  plugin::ParamSet params_;
  std::vector<std::max_align_t> memory_;
  RadioDeclaration declaration_;
  ErrorText error_;
  bool started_ = false;
};

TEST(Radio, SaysWhatItsParametersSay) {
  const Model model({{"range_m", 7},
                     {"line_of_sight", 1},
                     {"byte_rate", 100},
                     {"overhead_bytes", 3},
                     {"max_message_bytes", 50},
                     {"mailbox_bytes", 20},
                     {"mailbox_messages", 4},
                     {"queue_bytes", 60},
                     {"antenna_z_m", 0.4}});
  EXPECT_EQ(model.error(), "");
  const RadioDeclaration& radio = model.declaration();
  EXPECT_EQ(radio.range_m, 7);
  EXPECT_EQ(radio.line_of_sight, 1U);
  EXPECT_EQ(radio.byte_rate, 100);
  EXPECT_EQ(radio.overhead_bytes, 3U);
  EXPECT_EQ(radio.max_message_bytes, 50U);
  EXPECT_EQ(radio.max_messages, 4U);
  EXPECT_EQ(radio.max_queue_bytes, 60U);
  EXPECT_EQ(radio.antenna_z_m, 0.4);
  // Room for the longest message at least.
  EXPECT_EQ(radio.max_mailbox_bytes, 50U);
}

TEST(Radio, RefusesAQueueThatNoMessageFitsInto) {
  EXPECT_EQ(Model({{"max_message_bytes", 50}, {"overhead_bytes", 11}, {"queue_bytes", 60}}).error(),
            "`queue_bytes` (60) has no room for the longest message with its overhead (61)");
}

TEST(Radio, ReachesThroughBodiesAsFarAsItIsTold) {
  for (const double through_m : {0.0, 3.0}) {
    Model model({{"range_m", 10}, {"line_of_sight", 1}, {"obstructed_range_m", through_m}});
    LinkQuery query;
    for (const double distance_m : {0.1, 2.9, 3.1, 9.0}) {
      query.distance_m = distance_m;
      query.obstructed = 1;
      EXPECT_EQ(model.link(query).arrives, distance_m <= through_m ? 1U : 0U);
      query.obstructed = 0;
      EXPECT_EQ(model.link(query).arrives, 1U);
    }
  }
}

TEST(Radio, LosesAndDelaysByChanceOfEachDeliveryAlone) {
  Model model({{"loss_probability", 0.3}, {"latency_s", 0.02}, {"jitter_s", 0.01}});
  LinkQuery query;
  query.seed = 3;
  int lost = 0;
  double sum_s = 0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    query.sequence = static_cast<std::uint32_t>(i);
    query.to = query.sequence % 7;
    const LinkAnswer answer = model.link(query);
    EXPECT_GE(answer.delay_s, 0.02);
    EXPECT_LT(answer.delay_s, 0.03);
    lost += answer.arrives == 0 ? 1 : 0;
    sum_s += answer.delay_s;
    const LinkAnswer again = model.link(query);
    ASSERT_TRUE(again.arrives == answer.arrives && again.delay_s == answer.delay_s);
  }
  // Four standard deviations.
  EXPECT_NEAR(lost, 30'000, 4 * 145);
  EXPECT_NEAR(sum_s / kCount, 0.025, 4 * 0.01 / 3.464 / 316);
}

}  // namespace
}  // namespace rave
