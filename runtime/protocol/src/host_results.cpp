// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/host_results.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "rave/base/hash.hpp"
#include "rave/bus/sequence.hpp"

// The results of a host may exceed one message, so they travel as numbered parts. The manager
// assembles them and compares the hash. The host waits until DDS confirms that all bytes have
// arrived; the manager sends no answer.
namespace rave::lock_step {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kPart = rave_wire_kMaxHostResultsPart;

Status too_late(Duration patience) {
  return fail(ErrorCode::kTimeout, "the environment manager did not accept them within {} s",
              patience.seconds());
}

Status nobody(bool listened) {
  return fail(ErrorCode::kState, "{}",
              listened ? "the environment manager was lost before it had received them"
                       : "there is no environment manager to receive them");
}

}  // namespace

Status HostResultsSender::send(std::uint32_t host, std::span<const std::byte> bytes,
                               Duration patience) {
  // Remembered before sending, so that the error can tell a manager that was lost meanwhile from
  // one that was never there.
  const bool listened = readers() > 0;
  if (bytes.empty() || bytes.size() > kMostHostResults) {
    return fail(ErrorCode::kInvalidArgument, "they have {} bytes; at most {} can be sent",
                bytes.size(), kMostHostResults);
  }
  const auto end = Clock::now() + std::chrono::nanoseconds(patience.ns);
  bus::HostResultsPart part{};
  part.host = host;
  part.size = bytes.size();
  // The hash is of all bytes and the same in each part. Parts of two attempts of one process can
  // therefore not be mixed.
  part.hash = content_hash(bytes);
  std::vector<std::uint8_t> piece;
  for (std::size_t at = 0; at < bytes.size(); at += kPart, ++part.part) {
    // Each part may have to wait until the part before has been sent.
    if (at > 0 && Clock::now() >= end) return too_late(patience);
    const auto cut = bytes.subspan(at, std::min(kPart, bytes.size() - at));
    const auto* const first = reinterpret_cast<const std::uint8_t*>(cut.data());
    piece.assign(first, first + cut.size());
    bus::borrow(part.bytes, piece);
    auto written = writer_.write(part);
    // A writer waits for slow readers while much of its data is unconfirmed, and then fails with a
    // timeout.
    while (!written && written.error().code == ErrorCode::kTimeout && Clock::now() < end) {
      written = writer_.write(part);
    }
    if (!written && written.error().code == ErrorCode::kTimeout) return too_late(patience);
    RAVE_TRY(std::move(written));
  }
  if (readers() == 0) return nobody(listened);
  const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now());
  if (const Status arrived = writer_.await_arrival({left.count()}); !arrived) {
    if (arrived.error().code == ErrorCode::kTimeout) return too_late(patience);
    if (arrived.error().code == ErrorCode::kState) return nobody(true);
    return fail(ErrorCode::kIo, "their arrival was not confirmed: {}", arrived.error().message);
  }
  return readers() > 0 ? Status{} : nobody(true);
}

Status HostResultsParts::add(const bus::HostResultsPart& part) {
  // A writer that repeats its parts after completion would otherwise be collected a second time.
  if (done_.contains(part.writer)) return {};
  const auto [place, is_new] = partial_.try_emplace(part.writer);
  Partial& partial = place->second;
  if (is_new) {
    partial.host = part.host;
    partial.size = part.size;
    partial.hash = part.hash;
  }
  if (part.host != partial.host || part.size != partial.size || part.hash != partial.hash) {
    return fail(ErrorCode::kInvalidArgument,
                "part {} does not belong to the results of the previous parts: it is of host {} "
                "and {} bytes, not of host {} and {} bytes",
                part.part, part.host, part.size, partial.host, partial.size);
  }
  const auto bytes = std::as_bytes(bus::elements(part.bytes));
  // The map orders the parts, which may arrive in any order; a duplicate is ignored.
  partial.parts.try_emplace(part.part, bytes.begin(), bytes.end());
  // All parts but the last are full, so their number tells whether all have arrived.
  if (partial.parts.size() < (partial.size + kPart - 1) / kPart) return {};
  Partial all = std::move(partial);
  partial_.erase(place);
  return finish(part.writer, std::move(all));
}

Status HostResultsParts::finish(std::uint64_t writer, Partial partial) {
  // Also if the checksum is wrong: the same process cannot send better bytes later, and the manager
  // must not wait for it.
  done_.insert(writer);
  HostResults host_results{writer, partial.host, {}};
  host_results.bytes.reserve(partial.size);
  for (const auto& [number, bytes] : partial.parts) {
    host_results.bytes.insert(host_results.bytes.end(), bytes.begin(), bytes.end());
  }
  if (host_results.bytes.size() != partial.size ||
      content_hash(host_results.bytes) != partial.hash) {
    return fail(ErrorCode::kParse, "the results of host {} do not match their checksum",
                partial.host);
  }
  whole_.push_back(std::move(host_results));
  return {};
}

std::vector<HostResults> HostResultsParts::hand_out() { return std::exchange(whole_, {}); }

void HostResultsCollector::take(const std::function<bool(std::uint64_t, std::uint32_t)>& served) {
  const auto hear = [&](const bus::HostResultsPart& part) {
    if (!served(part.writer, part.host)) {
      reader_.refuse(part, fmt::format("it is not a process of host {} of this run", part.host));
      return;
    }
    if (const Status added = parts_.add(part); !added) {
      reader_.refuse(part, added.error().message);
    }
  };
  // Limits the time here, for a sender that never stops.
  constexpr int kMostRounds = 32;
  for (int round = 0; round < kMostRounds; ++round) {
    if (reader_.take(hear) < bus::ReaderCore::kMostAtOnce) break;
  }
}

}  // namespace rave::lock_step
