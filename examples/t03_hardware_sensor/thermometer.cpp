// SPDX-License-Identifier: Apache-2.0
// A driver of hardware: a thermometer that sends lines such as `T 21.50` on a serial line.
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <optional>
#include <rave/line/byte_line.hpp>
#include <rave/robot/plugin_entry.hpp>
#include <string>
#include <string_view>
#include <thread>

namespace {

constexpr std::size_t kLongestLine = 64;

class Thermometer final : public rave::HardwareSensor {
 public:
  static constexpr rave::ReadingKind kReading = rave::ReadingKind::kValues;

  rave::Status configure(const rave::HardwareSetup& setup,
                         rave::HardwareDeclaration& declaration) override {
    address_.device = setup.parameters().text("device");
    if (!address_.device.starts_with('/')) {
      address_.device = std::string(setup.folder) + "/" + address_.device;
    }
    address_.baud = setup.parameters().integer("baud");
    // Live: samples come by the wall clock, so a run with this sensor is in real time.
    declaration.clock = rave::DriverClock::kLive;
    declaration.period_s = 0.1;
    return {};
  }

  rave::Status open(rave::SampleSink& sink) override {
    RAVE_TRY(wake_.open());
    wake_.clear();  // close() rang it if the driver was open before.
    RAVE_TRY_ASSIGN(auto line, rave::line::ByteLine::open(address_, kPatience, &wake_));
    line_.emplace(std::move(line));
    thread_ = std::thread([this, &sink] { read_lines(sink); });  // The driver's own thread.
    return {};
  }

  void close() override {
    wake_.ring();  // Ends the wait of the thread at once.
    if (thread_.joinable()) thread_.join();
    line_.reset();
  }

  // Printed into result.json.
  [[nodiscard]] std::string report() const override {
    return fmt::format(R"({{"samples": {}}})", samples_.load());
  }

 private:
  void read_lines(rave::SampleSink& sink) {
    using rave::line::ReadEnd;
    std::string text;
    std::array<char, 256> room{};
    while (true) {
      const auto [end, size] = line_->read(room, kPatience, &wake_);
      if (end == ReadEnd::kWoken) return;
      if (end == ReadEnd::kLost) return sink.fail(line_->lost().data(), line_->lost().size());
      text.append(room.data(), size);
      for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n')) {
        publish(text.substr(0, at), sink);
        text.erase(0, at + 1);
      }
      if (text.size() > kLongestLine) text.clear();  // Noise on the line.
    }
  }

  // A line that is not understood is dropped: a serial line starts in the middle of one.
  void publish(std::string_view line, rave::SampleSink& sink) {
    double value_degC = 0;
    if (!line.starts_with("T ")) return;
    const char* const last = line.data() + line.size();
    const auto [end, error] = std::from_chars(line.data() + 2, last, value_degC);
    if (error != std::errc{} || end != last || !std::isfinite(value_degC)) return;
    if (sink.publish(sink.now(), &value_degC, 1)) ++samples_;
  }

  static constexpr rave::line::Wait kPatience{1000};

  rave::line::Address address_;
  rave::line::Wake wake_;
  std::optional<rave::line::ByteLine> line_;
  std::atomic<std::uint64_t> samples_ = 0;
  std::thread thread_;
};

constexpr rave::ParamSpec kParams[] = {
    rave::text_param("device", "/dev/ttyUSB0",
                     "Serial line; relative to the folder of the robot file."),
    rave::integer_param("baud", 9600, 300, 921600, "Speed of the line in bits per second."),
};

}  // namespace

RAVE_PLUGIN("thermometer") {
  rave::add_sensor<Thermometer>(registry, {.name = "thermometer",
                                           .summary = "Temperature in degrees Celsius.",
                                           .params = kParams,
                                           .clock = rave::DriverClock::kLive,
                                           .timing = rave::SampleTiming::kPeriodic});
}
