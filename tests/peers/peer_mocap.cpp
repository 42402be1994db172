// SPDX-License-Identifier: Apache-2.0
// Stands for a motion capture that watches a body go round a circle: see README.md.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <random>

#include "arguments.hpp"
#include "console.hpp"
#include "own_clock.hpp"

namespace {

using namespace peer;

struct Datagram {
  std::int64_t at_ns = 0;
  std::string text;
  bool operator>(const Datagram& other) const { return at_ns > other.at_ns; }
};

class MocapPeer {
 public:
  explicit MocapPeer(const Arguments& given)
      : body_(given.text("body", "robot")),
        circle_(given.numbers("circle", {1, 2, 0.5, 8})),
        period_ns_(std::llround(1e9 / given.number("rate-hz", 100))),
        noise_m_(given.number("noise-m", 0)),
        delay_s_(given.number("delay-s", 0)),
        jitter_s_(given.number("jitter-s", 0)),
        loss_(given.number("loss", 0)),
        twice_(given.number("twice", 0)),
        clock_(given.number("clock-start-s", 0), given.number("drift-ppm", 0)),
        random_(static_cast<std::uint64_t>(given.number("seed", 1))),
        log_(given.text("log", "")) {
    socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    to_.sin_family = AF_INET;
    to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to_.sin_port = htons(static_cast<std::uint16_t>(given.number("port", 0)));
    console_.say("ready");
  }
  MocapPeer(const MocapPeer&) = delete;
  MocapPeer& operator=(const MocapPeer&) = delete;
  ~MocapPeer() { ::close(socket_); }

  void run() {
    const std::int64_t began = true_ns();
    std::int64_t sample_at = began;
    while (true) {
      const std::int64_t next =
          waiting_.empty() ? sample_at : std::min(sample_at, waiting_.top().at_ns);
      const std::int64_t left = std::clamp<std::int64_t>(next - true_ns(), 0, 1'000'000'000);
      pollfd wanted{Console::fd(), POLLIN, 0};
      const timespec limit{left / 1'000'000'000, left % 1'000'000'000};
      (void)::ppoll(&wanted, 1, &limit, nullptr);
      for (const auto& command : console_.commands()) {
        if (!obey(command)) return;
      }
      while (!waiting_.empty() && waiting_.top().at_ns <= true_ns()) {
        send(waiting_.top().text);
        waiting_.pop();
      }
      if (true_ns() < sample_at) continue;
      sample(sample_at, static_cast<double>(sample_at - began) * 1e-9);
      sample_at = std::max(sample_at + period_ns_, true_ns() - period_ns_);
    }
  }

 private:
  void send(const std::string& text) {
    (void)::sendto(socket_, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&to_),
                   sizeof to_);
  }

  void sample(std::int64_t at_ns, double t_s) {
    std::normal_distribution<double> noise(0, 1);
    std::exponential_distribution<double> jitter(1);
    std::uniform_real_distribution<double> chance(0, 1);
    const double turn = 2 * std::numbers::pi * t_s / circle_[3];
    const double x = circle_[0] + circle_[2] * std::cos(turn) + noise_m_ * noise(random_);
    const double y = circle_[1] + circle_[2] * std::sin(turn) + noise_m_ * noise(random_);
    const double yaw = std::remainder(turn + std::numbers::pi / 2, 2 * std::numbers::pi);
    char text[320];
    std::snprintf(text, sizeof text,
                  "{\"body\":\"%s\",\"seq\":%lld,\"t\":%.9f,\"x\":%.9f,\"y\":%.9f,\"yaw\":%.9f,"
                  "\"cov\":[%.9g,%.9g,%.9g]}",
                  body_.c_str(), static_cast<long long>(++count_), clock_.seconds_at(at_ns), x, y,
                  yaw, noise_m_ * noise_m_, noise_m_ * noise_m_, 1e-6);
    const std::int64_t leaves =
        at_ns + std::llround((delay_s_ + jitter_s_ * jitter(random_)) * 1e9);
    const bool lost = chance(random_) < loss_ || mute_;
    char entry[200];
    std::snprintf(entry, sizeof entry, "%lld %lld %lld %.9f %.9f %.9f %s",
                  static_cast<long long>(count_), static_cast<long long>(at_ns),
                  static_cast<long long>(leaves), x, y, yaw, lost ? "lost" : "sent");
    log_.write(entry);
    if (lost) return;
    waiting_.push({leaves, text});
    if (chance(random_) < twice_) waiting_.push({leaves + period_ns_ / 2, text});
  }

  bool obey(const std::vector<std::string>& command) {
    const std::string& name = command.front();
    if (name == "quit") return false;
    if (name == "mute") mute_ = true;
    if (name == "speak") mute_ = false;
    if (name == "delay" && command.size() > 1) delay_s_ = std::atof(command[1].c_str());
    if (name == "restart") {  // a new program in the place of the old: both counts begin anew
      clock_.restart();
      count_ = 0;
    }
    if (name == "raw") {  // any text, as a datagram
      std::string text;
      for (std::size_t i = 1; i < command.size(); ++i) text += (i > 1 ? " " : "") + command[i];
      send(text);
    }
    console_.say("ok " + name);
    return true;
  }

  Console console_;
  std::string body_;
  std::vector<double> circle_;  // centre x, y, radius, period in seconds
  std::int64_t period_ns_;
  double noise_m_;
  double delay_s_;
  double jitter_s_;
  double loss_;
  double twice_;
  OwnClock clock_;
  std::mt19937_64 random_;
  Log log_;
  int socket_ = -1;
  sockaddr_in to_{};
  std::priority_queue<Datagram, std::vector<Datagram>, std::greater<>> waiting_;
  bool mute_ = false;
  std::int64_t count_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const peer::Arguments given(
      argc, argv,
      {"port", "body", "circle", "rate-hz", "noise-m", "delay-s", "jitter-s", "loss", "twice",
       "clock-start-s", "drift-ppm", "seed", "log"});
  MocapPeer(given).run();
}
