// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "rave/base/random.hpp"
#include "rave/base/time.hpp"
#include "rave/robot/handles.hpp"
#include "rave/robot/order.hpp"

namespace rave {

/// The latest sample of one sensor of one robot, in memory of the host.
struct SensorView {
  const SampleHeader* header = nullptr;
  const void* records = nullptr;
};

/// The data of one decision of one robot in the plug-in interface. Programs use Percepts and
/// Commands.
struct DecideItem {
  const SensorView* sensors = nullptr;              ///< In the order of ProgramSetup::sensors.
  Command* commands = nullptr;                      ///< In the order of ProgramSetup::controllers.
  const CommunicatorView* communicators = nullptr;  ///< As in ProgramSetup::communicators.
  std::int64_t now_ns = 0;
  PoseReading pose;            ///< Reported pose in the world frame.
  std::uint32_t decision = 0;  ///< Counts from 0.
  std::uint32_t robot = 0;
  std::uint64_t seed = 0;
  const OrderItem* orders = nullptr;  ///< Orders since the last decision.
  std::uint32_t order_count = 0;
  std::uint32_t driven = 0;                ///< Not 0: a user drives the robot.
  const AnswerService* answers = nullptr;  ///< Null: answers are ignored.
  std::uint64_t* state = nullptr;          ///< Receives Commands::state(); null: ignored.
};

/// One received message. A view: valid during decide().
struct Message {
  std::uint32_t from = 0;  ///< RobotId of the sender.
  SimTime stamp;           ///< See MessageHead::stamp_ns.
  Recipient to;
  std::span<const std::byte> bytes;

  /// The message as a plain struct; empty if its size differs.
  template <class T>
  [[nodiscard]] std::optional<T> as() const noexcept {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes.size() != sizeof(T)) return std::nullopt;
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
};

/// Iterates over the messages of a mailbox.
class MessageIterator {
 public:
  MessageIterator(const Mailbox& box, std::uint32_t i) noexcept : box_(&box), i_(i) {}
  [[nodiscard]] Message operator*() const noexcept {
    const MessageHead& head = box_->heads[i_];
    return {head.from, {head.stamp_ns}, head.to, box_->bytes_of(head)};
  }
  MessageIterator& operator++() noexcept {
    ++i_;
    return *this;
  }
  [[nodiscard]] bool operator!=(const MessageIterator& other) const noexcept {
    return i_ != other.i_;
  }

 private:
  const Mailbox* box_;
  std::uint32_t i_;
};

/// The messages in a mailbox: `for (const Message message : percepts.messages(radio))`.
class Messages {
 public:
  explicit Messages(const Mailbox& box) noexcept : box_(&box) {}
  [[nodiscard]] std::size_t size() const noexcept { return box_->count; }
  [[nodiscard]] bool empty() const noexcept { return box_->count == 0; }
  /// The number of messages lost since the last decision because the mailbox was full.
  [[nodiscard]] std::uint32_t dropped() const noexcept { return box_->dropped; }
  [[nodiscard]] MessageIterator begin() const noexcept { return {*box_, 0}; }
  [[nodiscard]] MessageIterator end() const noexcept { return {*box_, box_->count}; }

 private:
  const Mailbox* box_;
};

/// The knowledge of a robot at a decision. A view: valid during decide().
class Percepts {
 public:
  explicit Percepts(const DecideItem& item) noexcept : item_(&item) {}

  [[nodiscard]] SimTime now() const noexcept { return {item_->now_ns}; }
  /// The reported pose, world frame, with its covariance.
  [[nodiscard]] const PoseReading& pose() const noexcept { return item_->pose; }

  /// The records of the latest sample; empty before the first.
  template <class Record>
  [[nodiscard]] std::span<const Record> operator[](SensorHandle<Record> sensor) const noexcept {
    const SensorView& view = item_->sensors[sensor.index()];
    return {static_cast<const Record*>(view.records), view.header->count};
  }
  /// Stamp, sequence number and freshness of the latest sample.
  template <class Record>
  [[nodiscard]] const SampleHeader& header(SensorHandle<Record> sensor) const noexcept {
    return *item_->sensors[sensor.index()].header;
  }
  /// Age of the latest sample in simulation time; infinity before the first.
  template <class Record>
  [[nodiscard]] double age_s(SensorHandle<Record> sensor) const noexcept {
    const SampleHeader& latest = header(sensor);
    return latest.sequence == 0 ? std::numeric_limits<double>::infinity()
                                : Duration{item_->now_ns - latest.stamp_ns}.seconds();
  }
  /// Whether the latest sample is older than SensorInfo::max_age_s. It then says nothing about the
  /// present: space that it shows as free may be occupied.
  template <class Record>
  [[nodiscard]] bool is_old(SensorHandle<Record> sensor) const noexcept {
    return age_s(sensor) > sensor.info().max_age_s;
  }
  /// The messages received since the last decision, in the order of arrival.
  [[nodiscard]] Messages messages(CommunicatorHandle communicator) const noexcept {
    return Messages(*item_->communicators[communicator.index()].in);
  }
  /// The orders since the last decision of the kinds that the program takes (its constant
  /// `kTakes`), in the order in which they apply.
  [[nodiscard]] Orders orders() const noexcept { return {item_->orders, item_->order_count}; }
  /// Whether a user drives the robot. Commands to controllers of the driven actuator then have no
  /// effect.
  [[nodiscard]] bool is_driven() const noexcept { return item_->driven != 0; }
  /// The random numbers for this decision; equal in every repetition of the run.
  [[nodiscard]] RandomStream random() const noexcept {
    return {item_->seed, item_->robot, kProgramDevice, item_->decision};
  }

  /// The device number of programs for random streams.
  static constexpr std::uint32_t kProgramDevice = 0xffff0000U;

 private:
  const DecideItem* item_;
};

/// Receives the decision of a program. A controller without a new command keeps its last one until
/// its watchdog stops it.
class Commands {
 public:
  explicit Commands(const DecideItem& item) noexcept : item_(&item) {}

  void set(ControllerHandle controller, const Command& command) noexcept {
    item_->commands[controller.index()] = command;
  }
  /// Forward speed and turning rate (counter-clockwise positive).
  void velocity(ControllerHandle controller, double v_mps, double w_radps) noexcept {
    set(controller, velocity_command(v_mps, w_radps));
  }
  /// The same with a velocity to the left, for robots that move sideways.
  void velocity(ControllerHandle controller, double v_mps, double w_radps, double vy_mps) noexcept {
    set(controller, velocity_command(v_mps, w_radps, vy_mps));
  }
  /// A point in the world frame to drive to; speed 0: the default of the controller.
  void goal(ControllerHandle controller, Vec2 p_WG, double speed_mps = 0) noexcept {
    set(controller, goal_command(p_WG.x, p_WG.y, speed_mps));
  }
  /// A number that stands for what the program knows, such as a digest of its map. It becomes a
  /// part of the hash of the run, which then shows at once when knowledge differs. 0: nothing.
  void state(std::uint64_t digest) noexcept {
    if (item_->state != nullptr) *item_->state = digest;
  }
  /// Sends a message. False, and nothing is sent, if it exceeds the communicator's limit or there
  /// is no room left in this step.
  bool send(CommunicatorHandle communicator, std::span<const std::byte> bytes,
            Recipient to = Recipient::everyone()) noexcept {
    if (bytes.size() > communicator.info().max_message_bytes) return false;
    MessageHead head;
    head.stamp_ns = item_->now_ns;
    head.to = to;
    return item_->communicators[communicator.index()].out->put(head, bytes);
  }
  /// Sends a plain struct as its bytes. The struct must have no padding, whose bytes would be
  /// indeterminate.
  template <class T>
    requires(!std::is_convertible_v<const T&, std::span<const std::byte>>)
  bool send(CommunicatorHandle communicator, const T& message,
            Recipient to = Recipient::everyone()) noexcept {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::span<const std::byte> bytes = std::as_bytes(std::span<const T, 1>(&message, 1));
    return send(communicator, bytes, to);
  }
  /// Sends a text to users: UTF-8, at most kMostOrderText bytes. False, and nothing is sent, if it
  /// is longer or the limit of this decision is reached.
  bool say(std::string_view text) noexcept { return answer(text, 0); }
  /// Like say(), and reports the current order as completed.
  bool done(std::string_view text) noexcept { return answer(text, 1); }

 private:
  bool answer(std::string_view text, std::uint32_t done) noexcept {
    const AnswerService* const answers = item_->answers;
    return answers != nullptr &&
           answers->say(answers->context, item_->robot, text.data(), text.size(), done);
  }
  const DecideItem* item_;
};

}  // namespace rave
