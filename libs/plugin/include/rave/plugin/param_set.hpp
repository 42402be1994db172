// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <span>
#include <string>
#include <vector>

#include "rave/plugin/params.hpp"

namespace rave::plugin {

/// Owns the parameter values of one driver or program; used by the host. A move keeps the pointers
/// in values() valid. A copy would not, so copying is disabled.
class ParamSet {
 public:
  ParamSet() = default;
  ParamSet(ParamSet&&) noexcept = default;
  ParamSet& operator=(ParamSet&&) noexcept = default;

  void add_number(const std::string& name, double value) { add(name).number = value; }
  void add_text(const std::string& name, const std::string& value) {
    add(name).text = texts_.emplace_back(value).c_str();
  }
  void add_list(const std::string& name, const std::vector<double>& value) {
    const std::vector<double>& kept = lists_.emplace_back(value);
    ParamValue& entry = add(name);
    entry.list = kept.data();
    entry.list_size = kept.size();
  }

  [[nodiscard]] std::span<const ParamValue> values() const noexcept { return values_; }

 private:
  ParamValue& add(const std::string& name) {
    values_.push_back({texts_.emplace_back(name).c_str(), 0, "", nullptr, 0});
    return values_.back();
  }

  std::vector<ParamValue> values_;
  std::deque<std::string> texts_;
  std::deque<std::vector<double>> lists_;
};

}  // namespace rave::plugin
