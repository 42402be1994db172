// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

#include "rave/robot/plugin_entry.hpp"

/// The entry point of the plug-in whose source is compiled into the test.
extern "C" void rave_register_plugin(rave::RegistrySink* registry);

namespace rave::testing {

using RegisterPlugin = void (*)(RegistrySink*);

/// One driver of a plug-in whose source is compiled into the test.
class PluginUnderTest {
 public:
  PluginUnderTest(RegisterPlugin register_plugin, DriverKind kind, std::string_view name) {
    struct Sink final : RegistrySink {
      void add(const DriverInfo& info, const void* ops) override { all.emplace_back(info, ops); }
      std::vector<std::pair<DriverInfo, const void*>> all;
    } sink;
    register_plugin(&sink);
    for (const auto& [info, ops] : sink.all) {
      if (info.kind == kind && info.name == name) {
        info_ = info;
        ops_ = ops;
      }
    }
    EXPECT_NE(ops_, nullptr) << "the plug-in does not register `" << name << "`";
  }

  [[nodiscard]] const DriverInfo& info() const { return info_; }
  template <class Ops>
  [[nodiscard]] const Ops& ops() const {
    return *static_cast<const Ops*>(ops_);
  }

 private:
  DriverInfo info_;
  const void* ops_ = nullptr;
};

/// Parameter values as a host passes them: all declared ones, defaults filled in.
class ParamSet {
 public:
  explicit ParamSet(const DriverInfo& info) {
    for (const ParamSpec& spec : info.param_specs()) {
      ParamValue value;
      value.name = spec.name;
      value.number = spec.default_number;
      value.text = spec.default_text;
      values_.push_back(value);
    }
  }

  ParamSet& set(std::string_view name, double number) {
    find(name).number = number;
    return *this;
  }
  ParamSet& set_text(std::string_view name, std::string text) {
    find(name).text = texts_.emplace_back(std::move(text)).c_str();
    return *this;
  }
  ParamSet& set(std::string_view name, std::vector<double> list) {
    lists_.push_back(std::move(list));
    ParamValue& value = find(name);
    value.list = lists_.back().data();
    value.list_size = lists_.back().size();
    return *this;
  }
  [[nodiscard]] const std::vector<ParamValue>& values() const { return values_; }

 private:
  ParamValue& find(std::string_view name) {
    for (ParamValue& value : values_) {
      if (name == value.name) return value;
    }
    ADD_FAILURE() << "`" << name << "` is not a parameter";
    return values_.emplace_back();
  }

  std::vector<ParamValue> values_;
  std::deque<std::vector<double>> lists_;
  std::deque<std::string> texts_;
};

/// Keeps what a driver logs.
class LogLines {
 public:
  [[nodiscard]] HostServices host() {
    return {this, [](void* context, LogLevel, const char* text, std::uint64_t size) {
              static_cast<LogLines*>(context)->lines.emplace_back(text, size);
            }};
  }
  std::vector<std::string> lines;
};

/// One instance of any driver, in memory of its own.
class Instance {
 public:
  explicit Instance(const InstanceOps& ops) : ops_(ops), memory_(ops.size + ops.alignment) {
    const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
    where_ = memory_.data() + (ops.alignment - address % ops.alignment) % ops.alignment;
    ErrorText error;
    EXPECT_EQ(ops_.construct(where_, &error), 0) << error.text;
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() { ops_.destroy(where_); }

  [[nodiscard]] void* get() const { return where_; }

 private:
  InstanceOps ops_;
  std::vector<std::byte> memory_;
  std::byte* where_ = nullptr;
};

}  // namespace rave::testing
