// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "rave/record/cdr.hpp"

// Structs in CDR by one list of members that serves writing and reading, so the two cannot
// disagree. `Members<Archive>` holds a reference `archive` and has for each struct a function
// `of(T& v)` that calls `archive` with its members in order.
namespace rave::record {

/// A typed id, such as RobotId; written as its number.
template <class T>
concept CdrId = std::constructible_from<T, std::uint32_t> && requires(const T& id) {
  { id.value() } -> std::same_as<std::uint32_t>;
};

/// Writes values.
template <template <class> class Members>
class CdrPut {
 public:
  /// Not owned.
  explicit CdrPut(CdrWriter& writer) : cdr_(writer) {}

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  /// A last member that older messages do not have.
  template <class T>
  void newer(const T& value) {
    put(value);
  }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (std::same_as<T, bool>) {
      cdr_.put(static_cast<std::uint8_t>(value ? 1 : 0));
    } else if constexpr (CdrPrimitive<T>) {
      cdr_.put(value);
    } else if constexpr (std::is_enum_v<T>) {
      cdr_.put(static_cast<std::uint32_t>(value));
    } else if constexpr (CdrId<T>) {
      cdr_.put(value.value());
    } else {
      // The list takes references that a reader can fill; this class only reads them.
      Members<CdrPut>{*this}.of(const_cast<T&>(value));
    }
  }
  void put(const std::string& value) { cdr_.put_string(value); }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    cdr_.put_count(values.size());
    for (const T& value : values) put(value);
  }
  template <class Key, class T, class... More>
  void put(const std::map<Key, T, More...>& values) {
    cdr_.put_count(values.size());
    for (const auto& [key, value] : values) (*this)(key, value);
  }

  CdrWriter& cdr_;
};

/// Reads values. If the bytes do not suffice, CdrReader::ok() is false afterwards.
template <template <class> class Members>
class CdrTake {
 public:
  /// Not owned.
  explicit CdrTake(CdrReader& reader) : cdr_(reader) {}

  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }
  template <class T>
  void newer(T& value) {
    if (!cdr_.at_end()) take(value);
  }

 private:
  template <class T>
  void take(T& value) {
    if constexpr (std::same_as<T, bool>) {
      value = cdr_.get<std::uint8_t>() != 0;
    } else if constexpr (CdrPrimitive<T>) {
      value = cdr_.get<T>();
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(cdr_.get<std::uint32_t>());
    } else if constexpr (CdrId<T>) {
      value = T(cdr_.get<std::uint32_t>());
    } else {
      Members<CdrTake>{*this}.of(value);
    }
  }
  void take(std::string& value) { value = cdr_.get_string(); }
  template <class T>
  void take(std::optional<T>& value) {
    value.reset();
    if (cdr_.get<std::uint8_t>() != 0) take(value.emplace());
  }
  /// A count is accepted only if enough bytes follow.
  template <class T>
  void take(std::vector<T>& values) {
    values.clear();
    const std::uint32_t count = cdr_.get_count(1);
    for (std::uint32_t i = 0; i < count && cdr_.ok(); ++i) take(values.emplace_back());
  }
  template <class Key, class T, class... More>
  void take(std::map<Key, T, More...>& values) {
    values.clear();
    const std::uint32_t count = cdr_.get_count(1);
    for (std::uint32_t i = 0; i < count && cdr_.ok(); ++i) {
      Key key{};
      take(key);
      take(values[key]);
    }
  }

  CdrReader& cdr_;
};

}  // namespace rave::record
