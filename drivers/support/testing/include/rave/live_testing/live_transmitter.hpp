// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "rave/plugin/param_set.hpp"
#include "rave/robot/transmitter.hpp"

namespace rave::testing {

/// Records the packets of a transmitter and waits for them.
class LivePort final : public PacketSink {
 public:
  void receive(const std::byte* packet, std::uint64_t size) noexcept override {
    const std::lock_guard lock(mutex_);
    packets_.emplace_back(reinterpret_cast<const char*>(packet), size);
    changed_.notify_all();
  }
  void fail(const char* text, std::uint64_t size) noexcept override {
    const std::lock_guard lock(mutex_);
    failure_.assign(text, size);
    ++failures_;
    changed_.notify_all();
  }
  void recover() noexcept override {
    const std::lock_guard lock(mutex_);
    failure_.clear();
    ++recoveries_;
    changed_.notify_all();
  }

  /// Wait for at most a minute; false: it did not happen.
  bool wait_packets(std::size_t count) {
    return wait([&] { return packets_.size() >= count; });
  }
  bool wait_failures(int count) {
    return wait([&] { return failures_ >= count; });
  }
  bool wait_recoveries(int count) {
    return wait([&] { return recoveries_ >= count; });
  }
  [[nodiscard]] std::vector<std::string> packets() const {
    const std::lock_guard lock(mutex_);
    return packets_;
  }
  [[nodiscard]] std::string failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
  }

 private:
  template <class Condition>
  bool wait(Condition condition) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::minutes(1), condition);
  }
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> packets_;
  std::string failure_;
  int failures_ = 0;
  int recoveries_ = 0;
};

/// One instance of a transmitter driver of the build tree, called through its function table like
/// in a host.
class LiveTransmitter final : RegistrySink {
 public:
  using Given = std::map<std::string, std::variant<double, std::string>>;

  explicit LiveTransmitter(const std::string& name) {
    const std::string path = RAVE_BINARY_DIR "/lib/rave/plugins/" + name + ".so";
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      ADD_FAILURE() << dlerror();
      return;
    }
    void* symbol = dlsym(library, "rave_register_plugin");
    reinterpret_cast<void (*)(RegistrySink*)>(symbol)(this);
    instance_ = ::operator new(ops_->instance.size, std::align_val_t(ops_->instance.alignment));
    EXPECT_EQ(ops_->instance.construct(instance_, &error_), 0) << error_.text;
  }
  LiveTransmitter(const LiveTransmitter&) = delete;
  LiveTransmitter& operator=(const LiveTransmitter&) = delete;
  ~LiveTransmitter() {
    ops_->close(instance_);
    ops_->instance.destroy(instance_);
    ::operator delete(instance_, std::align_val_t(ops_->instance.alignment));
  }

  /// Return the error, or an empty text.
  std::string configure(const Given& given) {
    for (const ParamSpec& spec : info_.param_specs()) {
      const auto found = given.find(spec.name);
      const bool there = found != given.end();
      if (spec.type == ParamType::kText) {
        params_.add_text(spec.name,
                         there ? std::get<std::string>(found->second) : spec.default_text);
      } else {
        params_.add_number(spec.name,
                           there ? std::get<double>(found->second) : spec.default_number);
      }
    }
    HardwareSetup setup;
    setup.params = params_.values().data();
    setup.param_count = params_.values().size();
    return text_of(ops_->configure(instance_, &setup, &declaration_, &error_));
  }
  std::string open(PacketSink& sink) { return text_of(ops_->open(instance_, &sink, &error_)); }
  std::string send(std::string_view packet) {
    return text_of(ops_->send(instance_, reinterpret_cast<const std::byte*>(packet.data()),
                              packet.size(), &error_));
  }
  void close() { ops_->close(instance_); }
  [[nodiscard]] nlohmann::json report() {
    std::string text;
    ops_->report(instance_, &text, [](void* context, const char* bytes, std::uint64_t size) {
      static_cast<std::string*>(context)->assign(bytes, size);
    });
    return nlohmann::json::parse(text);
  }
  [[nodiscard]] const TransmitterDeclaration& declaration() const { return declaration_; }
  [[nodiscard]] const DriverInfo& info() const { return info_; }

 private:
  void add(const DriverInfo& info, const void* ops) override {
    info_ = info;
    ops_ = static_cast<const TransmitterOps*>(ops);
  }
  std::string text_of(int status) { return status == 0 ? std::string() : error_.text; }

  DriverInfo info_;
  const TransmitterOps* ops_ = nullptr;
  void* instance_ = nullptr;
  plugin::ParamSet params_;
  TransmitterDeclaration declaration_;
  ErrorText error_;
};

}  // namespace rave::testing
