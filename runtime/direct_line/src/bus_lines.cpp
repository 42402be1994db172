// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <mutex>
#include <thread>

#include "rave/base/thread.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/direct_line/lines.hpp"

namespace rave::direct_line {
namespace {

using LineInfoReader = bus::Reader<bus::LineInfo>;
using WithdrawalWriter = bus::Writer<bus::LineWithdrawal>;
using RobotsOf = std::function<std::vector<std::string>(const std::string&)>;

/// Used only by the thread once that has started.
struct BusEnds {
  std::unique_ptr<bus::Bus> bus;
  LineInfoReader infos;
  WithdrawalWriter withdrawals;
  bus::WaitSet waits;
};

class BusLines final : public Lines {
 public:
  BusLines(BusEnds ends, std::string run, RobotsOf robots_of)
      : ends_(std::move(ends)), run_(std::move(run)), robots_of_(std::move(robots_of)) {}
  [[nodiscard]] Status start() {
    return start_thread(thread_, "the addresses of direct lines",
                        [this](const std::stop_token& stop) { work(stop); });
  }
  BusLines(const BusLines&) = delete;
  BusLines& operator=(const BusLines&) = delete;
  ~BusLines() override {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
  }

  [[nodiscard]] std::string run() const override { return run_; }
  [[nodiscard]] std::vector<HostLine> hosts() const override {
    const std::lock_guard lock(mutex_);
    std::vector<HostLine> hosts;
    for (const auto& [name, line] : hosts_) hosts.push_back(line);
    return hosts;
  }
  void withdraw(const std::string& user, const std::string& signed_text) override {
    {
      const std::lock_guard lock(mutex_);
      untold_[user] = signed_text;
    }
    ends_.waits.ring();
  }

 private:
  void work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      hear();
      tell();
      static_cast<void>(ends_.waits.wait(Duration{-1}, stop));
    }
  }
  void hear() {
    ends_.infos.take(
        [this](const bus::LineInfo& info) {
          HostLine line{info.host, info.url, robots_of_(info.host)};
          if (line.robots.empty()) return ends_.infos.refuse(info, "the run has no such host");
          const std::lock_guard lock(mutex_);
          writers_[info.writer] = line.host;
          hosts_[line.host] = std::move(line);
        },
        [this](const bus::LineInfo& info) {
          const std::lock_guard lock(mutex_);
          const auto writer = writers_.find(info.writer);
          if (writer == writers_.end()) return;
          // After a restart its new address may have arrived before the old one was withdrawn.
          const std::string host = writer->second;
          writers_.erase(writer);
          for (const auto& [other, name] : writers_) {
            if (name == host) return;
          }
          hosts_.erase(host);
        });
  }
  void tell() {
    std::map<std::string, std::string> untold;
    {
      const std::lock_guard lock(mutex_);
      untold.swap(untold_);
    }
    for (const auto& [user, text] : untold) {
      bus::LineWithdrawal withdrawal{};
      user.copy(withdrawal.user, sizeof withdrawal.user - 1);
      text.copy(withdrawal.text, sizeof withdrawal.text - 1);
      if (ends_.withdrawals.write(withdrawal)) continue;
      // A reader is too slow; the next round repeats the text.
      const std::lock_guard lock(mutex_);
      untold_.emplace(user, text);
    }
  }

  BusEnds ends_;
  std::string run_;
  RobotsOf robots_of_;
  mutable std::mutex mutex_;
  std::map<std::string, HostLine> hosts_;         ///< Guarded by the mutex.
  std::map<std::uint64_t, std::string> writers_;  ///< Guarded by the mutex.
  std::map<std::string, std::string> untold_;     ///< By person; guarded by the mutex.
  /// Declared last so that it stops before the members that it uses are destroyed.
  std::jthread thread_;
};

}  // namespace

Result<std::unique_ptr<Lines>> lines_on_bus(bus::BusConfig config, RobotsOf robots_of) {
  config.anonymous = true;
  config.beside = true;
  const std::string run = config.run.text();
  BusEnds ends;
  RAVE_TRY_ASSIGN(ends.bus, bus::Bus::open(config));
  RAVE_TRY(bus::open_all(*ends.bus, ends.infos, ends.withdrawals));
  RAVE_TRY_ASSIGN(ends.waits, bus::WaitSet::create(*ends.bus));
  RAVE_TRY(ends.waits.add(ends.infos));
  auto lines = std::make_unique<BusLines>(std::move(ends), run, std::move(robots_of));
  RAVE_TRY(lines->start());
  return std::unique_ptr<Lines>(std::move(lines));
}

}  // namespace rave::direct_line
