// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace peer {

/// Options of the command line, each `--name value`. A peer ends with a message on what it does
/// not know.
class Arguments {
 public:
  Arguments(int argc, char** argv, const std::vector<std::string>& known);

  [[nodiscard]] std::string text(const std::string& name, const std::string& otherwise) const;
  [[nodiscard]] double number(const std::string& name, double otherwise) const;
  /// Numbers between commas; exactly as many as `otherwise` has.
  [[nodiscard]] std::vector<double> numbers(const std::string& name,
                                            const std::vector<double>& otherwise) const;
  [[nodiscard]] bool has(const std::string& name) const { return values_.count(name) > 0; }

 private:
  std::map<std::string, std::string> values_;
};

/// Numbers between commas or blanks; ends the program on anything else.
[[nodiscard]] std::vector<double> parse_numbers(const std::string& text);
[[noreturn]] void give_up(const std::string& why);

}  // namespace peer
