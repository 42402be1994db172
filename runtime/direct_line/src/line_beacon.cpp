// SPDX-License-Identifier: Apache-2.0
#include <thread>

#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/direct_line/lines.hpp"

namespace rave::direct_line {

struct LineBeacon::Impl {
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::LineInfo> infos;
  bus::Reader<bus::LineWithdrawal> withdrawals;
  bus::WaitSet waits;
  LineServer& server;
  std::jthread thread{};

  void work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      withdrawals.take(
          [this](const bus::LineWithdrawal& withdrawal) { server.withdraw(withdrawal.text); });
      static_cast<void>(waits.wait(Duration{-1}, stop));
    }
  }
};

LineBeacon::LineBeacon(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}

LineBeacon::~LineBeacon() {
  impl_->thread.request_stop();
  impl_->thread.join();
  // Nobody is left to whom it matters that this does not get through.
  bus::LineInfo info{};
  static_cast<void>(impl_->infos.dispose(info));
}

Result<std::unique_ptr<LineBeacon>> LineBeacon::start(bus::BusConfig config,
                                                      const std::string& host, LineServer& server) {
  config.anonymous = true;
  config.beside = true;
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(config));
  RAVE_TRY_ASSIGN(auto infos, bus::Writer<bus::LineInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto withdrawals, bus::Reader<bus::LineWithdrawal>::create(*bus));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(*bus));
  RAVE_TRY(waits.add(withdrawals));
  bus::LineInfo info{};
  const std::string url = server.url();
  host.copy(info.host, sizeof info.host - 1);
  url.copy(info.url, sizeof info.url - 1);
  RAVE_TRY(infos.write(info));
  std::unique_ptr<Impl> impl(
      new Impl{std::move(bus), std::move(infos), std::move(withdrawals), std::move(waits), server});
  impl->thread = std::jthread([raw = impl.get()](const std::stop_token& stop) { raw->work(stop); });
  return std::unique_ptr<LineBeacon>(new LineBeacon(std::move(impl)));
}

}  // namespace rave::direct_line
