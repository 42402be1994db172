// SPDX-License-Identifier: Apache-2.0
// A driver of hardware: a thermometer that sends lines such as `T 21.50` on a serial line.
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <cmath>
#include <cstring>
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
    line_ = setup.parameters().text("line");
    if (!line_.starts_with('/')) line_ = std::string(setup.folder) + "/" + line_;
    // Live: samples come by the wall clock, so a run with this sensor is in real time.
    declaration.clock = rave::DriverClock::kLive;
    declaration.period_s = 0.1;
    return {};
  }

  rave::Status open(rave::SampleSink& sink) override {
    file_ = ::open(line_.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (file_ < 0) {
      return rave::fail(rave::ErrorCode::kIo, "cannot open `{}`: {}", line_, std::strerror(errno));
    }
    termios mode{};
    if (::tcgetattr(file_, &mode) == 0) {
      ::cfmakeraw(&mode);
      ::cfsetspeed(&mode, B9600);
      ::tcsetattr(file_, TCSANOW, &mode);
    }
    closing_ = false;
    thread_ = std::thread([this, &sink] { read_lines(sink); });  // The driver's own thread.
    return {};
  }

  void close() override {
    closing_ = true;
    if (thread_.joinable()) thread_.join();
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }

  // Printed into result.json.
  [[nodiscard]] std::string report() const override {
    return fmt::format(R"({{"samples": {}}})", samples_.load());
  }

 private:
  void read_lines(rave::SampleSink& sink) {
    std::string text;
    while (!closing_) {
      pollfd wait{file_, POLLIN, 0};
      if (::poll(&wait, 1, 50) <= 0) continue;
      char bytes[256];
      const ssize_t count = ::read(file_, bytes, sizeof bytes);
      if (count <= 0) {
        constexpr std::string_view kLost = "the serial line is closed";
        return sink.fail(kLost.data(), kLost.size());
      }
      text.append(bytes, static_cast<std::size_t>(count));
      for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
        publish(text.substr(0, end), sink);
        text.erase(0, end + 1);
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

  std::string line_;
  int file_ = -1;
  std::atomic<bool> closing_ = false;
  std::atomic<std::uint64_t> samples_ = 0;
  std::thread thread_;
};

constexpr rave::ParamSpec kParams[] = {
    rave::text_param("line", "/dev/ttyUSB0",
                     "Serial line; relative to the folder of the robot file."),
};

}  // namespace

RAVE_PLUGIN("thermometer") {
  rave::add_sensor<Thermometer>(registry, {.name = "thermometer",
                                           .summary = "Temperature in degrees Celsius.",
                                           .params = kParams,
                                           .clock = rave::DriverClock::kLive,
                                           .timing = rave::SampleTiming::kPeriodic});
}
