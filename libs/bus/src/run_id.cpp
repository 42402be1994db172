// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/run_id.hpp"

#include <fmt/ranges.h>

#include <bit>
#include <charconv>
#include <random>
#include <span>

#include "rave/base/hash.hpp"

namespace rave::bus {

RunId RunId::random() {
  std::random_device chance;
  RunId id;
  for (std::size_t i = 0; i < id.bytes.size(); i += sizeof(std::uint32_t)) {
    const std::uint32_t bits = chance();
    std::memcpy(id.bytes.data() + i, &bits, sizeof bits);
  }
  return id;
}

Result<RunId> RunId::parse(std::string_view text) {
  RunId id;
  if (text.size() != 2 * id.bytes.size()) {
    return fail(ErrorCode::kParse, "a run id has 32 hexadecimal digits, not {} characters",
                text.size());
  }
  for (std::size_t i = 0; i < id.bytes.size(); ++i) {
    const char* const digits = text.data() + 2 * i;
    const auto [end, error] = std::from_chars(digits, digits + 2, id.bytes[i], 16);
    if (error != std::errc() || end != digits + 2) {
      return fail(ErrorCode::kParse, "a run id has hexadecimal digits only, not `{}`",
                  text.substr(2 * i, 2));
    }
  }
  return id;
}

std::string RunId::text() const { return fmt::format("{:02x}", fmt::join(bytes, "")); }

RunId run_of_number(std::uint64_t number) noexcept {
  RunId run;
  // Two different hashes of the number, so that near numbers give ids without common bytes.
  const std::array<std::uint64_t, 2> halves = {mix64(number), mix64(~number)};
  run.bytes = std::bit_cast<std::array<std::uint8_t, 16>>(halves);
  return run;
}

RunId run_of_name(std::string_view name) noexcept {
  return run_of_number(content_hash(std::as_bytes(std::span(name.data(), name.size()))));
}

std::uint64_t random_writer_id() {
  std::random_device chance;
  std::uint64_t id = 0;
  // 0 means that there is no writer.
  while (id == 0) id = (std::uint64_t{chance()} << 32U) | chance();
  return id;
}

}  // namespace rave::bus
