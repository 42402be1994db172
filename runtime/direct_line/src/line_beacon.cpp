// SPDX-License-Identifier: Apache-2.0
#include <condition_variable>
#include <mutex>
#include <thread>

#include "rave/base/thread.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/direct_line/lines.hpp"

namespace rave::direct_line {
namespace {

constexpr auto kLookForRun = std::chrono::milliseconds(50);

/// Used only by the thread of the beacon.
struct BeaconEnds {
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::LineInfo> infos;
  bus::Reader<bus::LineWithdrawal> withdrawals;
  bus::WaitSet waits;
};

Result<BeaconEnds> open_ends(const bus::BusConfig& config) {
  BeaconEnds ends;
  RAVE_TRY_ASSIGN(ends.bus, bus::Bus::open(config));
  RAVE_TRY(bus::open_all(*ends.bus, ends.infos, ends.withdrawals));
  RAVE_TRY_ASSIGN(ends.waits, bus::WaitSet::create(*ends.bus));
  RAVE_TRY(ends.waits.add(ends.withdrawals));
  return ends;
}

}  // namespace

struct LineBeacon::Impl {
  bus::BusConfig config;
  std::string host;
  LineServer& server;
  const runtime::RunControl& control;
  LogSink& log;
  std::mutex mutex{};
  std::condition_variable_any stopped{};
  std::jthread thread{};

  void work(const std::stop_token& stop) {
    if (!wait_for_run(stop)) return;
    auto ends = open_ends(config);
    const Status told = ends ? tell(*ends) : Status(tl::unexpected(ends.error()));
    if (!told) {
      log.warn("line", "cannot announce the direct line of `{}`: {}", host, told.error().message);
      return;
    }
    log.info("line", "pages reach `{}` at {}", host, server.url());
    while (!stop.stop_requested()) {
      ends->withdrawals.take(
          [this](const bus::LineWithdrawal& withdrawal) { server.withdraw(withdrawal.text); });
      static_cast<void>(ends->waits.wait(Duration{-1}, stop));
    }
    // The process is ending, so a failure here has no consequence.
    bus::LineInfo info{};
    static_cast<void>(ends->infos.dispose(info));
  }

  [[nodiscard]] bool wait_for_run(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    while (!stop.stop_requested()) {
      if (!control.status().scenario.empty()) return true;
      stopped.wait_for(lock, stop, kLookForRun, [] { return false; });
    }
    return false;
  }

  [[nodiscard]] Status tell(BeaconEnds& ends) const {
    bus::LineInfo info{};
    const std::string url = server.url();
    host.copy(info.host, sizeof info.host - 1);
    url.copy(info.url, sizeof info.url - 1);
    return ends.infos.write(info);
  }
};

LineBeacon::LineBeacon(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}

LineBeacon::~LineBeacon() {
  impl_->thread.request_stop();
  impl_->thread.join();
}

Result<std::unique_ptr<LineBeacon>> LineBeacon::start(bus::BusConfig config,
                                                      const std::string& host, LineServer& server,
                                                      const runtime::RunControl& control,
                                                      LogSink& log) {
  config.anonymous = true;
  config.beside = true;
  std::unique_ptr<Impl> impl(new Impl{std::move(config), host, server, control, log});
  RAVE_TRY(start_thread(impl->thread, "the direct line",
                        [raw = impl.get()](const std::stop_token& stop) { raw->work(stop); }));
  return std::unique_ptr<LineBeacon>(new LineBeacon(std::move(impl)));
}

}  // namespace rave::direct_line
