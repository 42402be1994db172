// SPDX-License-Identifier: Apache-2.0
// Experiment files come from others, and ledgers from folders that others share.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "rave/base/check.hpp"
#include "rave/config/experiment_file.hpp"
#include "rave/experiment/condition.hpp"
#include "rave/experiment/ledger.hpp"

namespace {

void check_ledger(std::string_view text) {
  rave::experiment::RunRows rows;
  rows.add(text);
  if (const auto row = rave::experiment::read_row(text)) {
    const auto again = rave::experiment::read_row(rave::experiment::write_row(*row));
    RAVE_CHECK(again && *again == *row);
  }
}

void check_experiment(std::string_view text) {
  const auto read = rave::config::read_experiment_text(text, "fuzz");
  if (!read) return;
  const auto again =
      rave::config::read_experiment_text(rave::config::write_experiment(*read), "again");
  RAVE_CHECK(again && *again == *read);
  if (read->repetitions < 1000) static_cast<void>(rave::experiment::conditions_of(*read));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check_ledger(text);
  check_experiment(text);
  return 0;
}
