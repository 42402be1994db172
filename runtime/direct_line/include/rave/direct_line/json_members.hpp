// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/word_table.hpp"
#include "rave/math/pose.hpp"

namespace rave::direct_line {

using Json = nlohmann::json;

inline constexpr std::size_t kLongestPlainName = 64;

/// Takes members out of an object, so that unknown members are left over and refused. Errors:
/// kParse with the name of the member and what was expected.
class JsonMembers {
 public:
  explicit JsonMembers(const Json& object) : object_(object) {}

  Result<bool> flag(const char* name);
  Result<double> number(const char* name);  ///< Finite.
  Result<double> number_in(const char* name, double least, double most);
  /// An integer from 0 to 2^53, up to which a double holds each integer.
  Result<std::uint64_t> whole(const char* name);
  Result<std::uint32_t> index(const char* name);
  Result<std::uint32_t> index_in(const char* name, std::uint32_t least, std::uint32_t most);
  Result<std::string> word(const char* name);
  /// A string of limited length in bytes, without control characters but line breaks if `lines`.
  Result<std::string> text(const char* name, std::size_t most, bool lines = false);
  /// 1 to kLongestPlainName letters, digits and `signs`, as names in files are.
  Result<std::string> plain_name(const char* name, std::string_view signs);
  /// One of the words, which outlive the result.
  Result<std::string_view> choice(const char* name, std::initializer_list<std::string_view> words);
  /// What one of the words of the table stands for.
  template <class Value, std::size_t kRows>
  Result<Value> choice(const char* name, const WordTable<Value, kRows>& words) {
    RAVE_TRY_ASSIGN(const std::size_t row, row_of(name, words.words()));
    return words.rows[row].second;
  }
  /// x and y of at most `farthest_m`, and a yaw of at most one turn.
  Result<Pose2> pose(const char* name, double farthest_m);
  /// An array of at most `most`, each as `read` takes it from a value and the name.
  template <class Value>
  Result<std::vector<Value>> list(const char* name, std::size_t most,
                                  Result<Value> (*read)(const Json&, const char*)) {
    RAVE_TRY_ASSIGN(const Json* const values, array(name, most));
    std::vector<Value> all;
    for (const Json& value : *values) {
      RAVE_TRY_ASSIGN(Value one, read(value, name));
      all.push_back(std::move(one));
    }
    return all;
  }
  Result<const Json*> any(const char* name);
  [[nodiscard]] bool has(const char* name) const { return object_.contains(name); }
  [[nodiscard]] Status finish() const;
  /// Parses an object that is not nested deeply; the error says that `what` was expected.
  static Result<Json> parse_object(std::string_view text, const char* what);

  // For list().
  static Result<double> number_of(const Json& value, const char* name);
  static Result<std::uint32_t> index_of(const Json& value, const char* name);

 private:
  Result<std::size_t> row_of(const char* name, std::span<const std::string_view> words);
  Result<const Json*> array(const char* name, std::size_t most);

  const Json& object_;
  std::size_t taken_ = 0;
};

}  // namespace rave::direct_line
