// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ros2/ros2_device.hpp"
#include "ros2/stream_clock.hpp"
#include "ros2/writer_choice.hpp"

namespace rave::ros2_driver {

/// Statistics of one sensor's stream, for the report. A plain value.
struct TopicState {
  std::uint64_t samples = 0;
  std::uint64_t refused = 0;      ///< Unusable messages.
  std::uint64_t losses = 0;       ///< Times of silence beyond the limit.
  std::uint64_t passed_over = 0;  ///< Messages of writers that are not those of the robot.
  double rate_hz = 0;             ///< Rate of samples, by the host's clock.
  std::string trouble;            ///< The last problem; empty if there was none.
};

/// The common part of the sensors of this plug-in. The host's thread calls configure(), open(),
/// close() and report(); the device's thread calls attend() and what it calls. They share what
/// `mutex_` guards.
class TopicSensor : public HardwareSensor, public TopicUser {
 public:
  TopicSensor() = default;
  TopicSensor(const TopicSensor&) = delete;
  TopicSensor& operator=(const TopicSensor&) = delete;
  ~TopicSensor() override = default;

  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) final;
  Status open(SampleSink& sink) final;
  void close() final;
  [[nodiscard]] std::string report() const final;
  line::HostTime attend(line::HostTime now) final;

 protected:
  /// Creates the readers, waits for the first message, and declares its properties.
  virtual Status prepare(const Params& params, HardwareDeclaration& declaration) = 0;
  /// Takes all received messages, and calls publish() for each usable one.
  virtual void drain() = 0;
  /// Adds the state of the readers, and the reason for silence.
  virtual void look_after(TopicState& state) = 0;
  [[nodiscard]] virtual std::string explain_silence() const = 0;
  [[nodiscard]] virtual std::vector<dds_entity_t> readers() const = 0;
  [[nodiscard]] virtual const std::string& topic() const = 0;

  /// Permits silence, for topics without a regular rate.
  void allow_silence() noexcept { may_be_silent_ = true; }
  [[nodiscard]] bool may_be_silent() const noexcept { return may_be_silent_; }
  [[nodiscard]] Ros2Device& device() const noexcept { return *device_; }
  /// For drain(): publishes records of a message with this stamp. Old ones are dropped.
  void publish(std::int64_t stamp_ns, const void* records, std::uint32_t count);
  /// For drain() and prepare(): whether a message of `writer` counts, or its transform to `frame`.
  /// The writer of a static one may be silent for ever.
  bool admits(WriterChoice& choice, const ros2::End& reader, dds_instance_handle_t writer,
              std::string_view frame = "", bool is_static = false);
  /// For drain(): notes a message without a reading, so that the sensor does not count as lost.
  void note_alive();
  /// Creates a reader of a topic in the device's namespace. Errors: those of Ros2Device::topic()
  /// and ros2::Reader::create().
  template <class Message>
  Status make_reader(std::string_view topic, std::optional<ros2::Reader<Message>>& reader,
                     const bus::QosProfile& profile = ros2::kReadNewest) const {
    RAVE_TRY_ASSIGN(const std::string name, device().topic(topic));
    RAVE_TRY_ASSIGN(auto made,
                    ros2::Reader<Message>::create(device().participant(), name, profile));
    reader.emplace(std::move(made));
    return {};
  }
  /// For look_after(): adds the state of one reader.
  template <class Message>
  void look_at(ros2::Reader<Message>& reader, TopicState& state) const {
    state.refused += reader.refused();
    if (!reader.trouble().empty()) state.trouble = reader.trouble();
    if (auto text = reader.take_mismatch()) {
      warn(fmt::format("`{}`: {}", reader.topic(), *text), state);
    }
  }
  /// For look_after(): logs a problem.
  void warn(std::string text, TopicState& state) const;

 private:
  void tell_refused();

  Ros2Device* device_ = nullptr;
  bool ready_ = false;
  bool may_be_silent_ = false;
  std::vector<dds_entity_t> watched_;

  mutable std::mutex mutex_;  // guards what follows
  SampleSink* sink_ = nullptr;
  TopicState state_;
  StreamClock clock_;
  line::HostTime first_{};
  line::HostTime last_{};
  std::int64_t last_stamp_ns_ = 0;
  std::uint64_t refused_before_ = 0;  // value at the last message
  std::uint64_t refused_at_open_ = 0;
  std::uint64_t next_told_ = 1;  // number of refused messages of the next warning about them
  bool lost_ = false;
  bool alive_ = false;  // a message arrived since the last check
};

/// A sensor that reads one topic.
template <class Message>
class OneTopicSensor : public TopicSensor {
 protected:
  Status make_reader(const Params& params) {
    return TopicSensor::make_reader(params.text("topic"), reader_);
  }
  /// Creates the reader and waits for a suitable message.
  template <class Suits>
  Status begin_reading(const Params& params, Suits&& suits) {
    RAVE_TRY(make_reader(params));
    return device().await(*reader_, [&](const Message& message, dds_instance_handle_t writer) {
      return counts(writer) && suits(message);
    });
  }
  /// Like the above, for sensors that accept any first message.
  Status begin_reading(const Params& params) {
    return begin_reading(params, [](const Message& /*message*/) { return true; });
  }

  /// Converts a message. An error refuses it.
  virtual Status take(const Message& message) = 0;

  void drain() final {
    reader_->take([this](const Message& message, dds_instance_handle_t writer) {
      if (!counts(writer)) return;
      Status taken = take(message);
      if (!taken) reader_->refuse(std::move(taken).error());
    });
  }
  void look_after(TopicState& state) final { look_at(*reader_, state); }
  [[nodiscard]] std::string explain_silence() const final { return reader_->explain_silence(); }
  [[nodiscard]] const std::string& topic() const final { return reader_->topic(); }
  [[nodiscard]] std::vector<dds_entity_t> readers() const final { return {reader_->handle()}; }

 private:
  // Several nodes may command, such as two of rviz.
  bool counts(dds_instance_handle_t writer) {
    return may_be_silent() || admits(choice_, reader_->end(), writer);
  }

  std::optional<ros2::Reader<Message>> reader_;
  WriterChoice choice_;
};

/// A sensor that reads two topics, or one of them. prepare() creates `main_`, `beside_`, or both.
template <class Message, class Beside>
class TwoTopicSensor : public TopicSensor {
 protected:
  void look_after(TopicState& state) final {
    if (main_) look_at(*main_, state);
    if (beside_) look_at(*beside_, state);
  }
  [[nodiscard]] std::string explain_silence() const override {
    return main_ ? main_->explain_silence() : beside_->explain_silence();
  }
  [[nodiscard]] const std::string& topic() const final {
    return main_ ? main_->topic() : beside_->topic();
  }
  [[nodiscard]] std::vector<dds_entity_t> readers() const final {
    std::vector<dds_entity_t> all;
    if (main_) all.push_back(main_->handle());
    if (beside_) all.push_back(beside_->handle());
    return all;
  }

  std::optional<ros2::Reader<Message>> main_;
  std::optional<ros2::Reader<Beside>> beside_;
};

}  // namespace rave::ros2_driver
