// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace peer {

void give_up(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(2);
}

std::vector<double> parse_numbers(const std::string& text) {
  std::string blanks = text;
  std::replace(blanks.begin(), blanks.end(), ',', ' ');
  std::istringstream stream(blanks);
  std::vector<double> numbers;
  double number = 0;
  while (stream >> number) numbers.push_back(number);
  if (!stream.eof()) give_up("not numbers: " + text);
  return numbers;
}

Arguments::Arguments(int argc, char** argv, const std::vector<std::string>& known) {
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (name.rfind("--", 0) != 0 || i + 1 >= argc ||
        std::find(known.begin(), known.end(), name.substr(2)) == known.end()) {
      std::string all = "unknown or without value: ";
      all.append(name).append("; options, each with a value:");
      for (const std::string& option : known) all.append(" --").append(option);
      give_up(all);
    }
    values_[name.substr(2)] = argv[i + 1];
  }
}

std::string Arguments::text(const std::string& name, const std::string& otherwise) const {
  const auto found = values_.find(name);
  return found == values_.end() ? otherwise : found->second;
}

double Arguments::number(const std::string& name, double otherwise) const {
  return numbers(name, {otherwise}).front();
}

std::vector<double> Arguments::numbers(const std::string& name,
                                       const std::vector<double>& otherwise) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return otherwise;
  std::vector<double> given = parse_numbers(found->second);
  if (given.size() != otherwise.size()) {
    give_up("--" + name + " takes " + std::to_string(otherwise.size()) + " numbers");
  }
  return given;
}

}  // namespace peer
