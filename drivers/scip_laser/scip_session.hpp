// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "line/byte_line.hpp"
#include "scip_laser/scip_decoder.hpp"
#include "scip_laser/scip_parameters.hpp"
#include "scip_laser/scip_scan.hpp"

namespace rave::scip {

/// What a device says of itself in answer to VV and PP.
struct Identity {
  std::string product;
  std::string firmware;
  std::string serial;
  std::string protocol;
  Parameters parameters;
};

/// A conversation with a device over an open line. For one thread; every wait ends when `wake`
/// rings (null: nobody rings), which must outlive the session.
class ScipSession {
 public:
  ScipSession(line::ByteLine line, const line::Wake* wake) : line_(std::move(line)), wake_(wake) {}

  /// Stops whatever runs (QT), changes to SCIP 2.0, resets (RS), and reads VV and PP. A device
  /// that is torn out of a scan or still speaks SCIP 1.1 is brought to order by it.
  /// Errors: kTimeout (no answer), kIo (the line is gone), kParse, kState (woken).
  [[nodiscard]] Result<Identity> identify();
  /// Lights the laser (BM) and, in continuous mode, asks for scans.
  [[nodiscard]] Status begin(const ScanRequest& request);
  /// Asks for one scan, in polled mode.
  [[nodiscard]] Status poll(const ScanRequest& request);
  /// Takes the laser out of service as far as the line allows: no answer is waited for.
  void end() noexcept;

  struct Next {
    line::ReadEnd end = line::ReadEnd::kTimeout;  ///< kBytes: `reply` is there.
    const Reply* reply = nullptr;                 ///< Valid until the next call.
    line::HostTime arrived;                       ///< When the first byte of the reply was read.
  };
  /// The next reply, whatever its kind.
  [[nodiscard]] Next next(line::HostTime limit);

  [[nodiscard]] const std::string& lost() const noexcept { return line_.lost(); }
  [[nodiscard]] const ScipDecoder::Counts& counts() const noexcept { return decoder_.counts(); }

 private:
  [[nodiscard]] Status send(std::string_view command);
  /// Sends a command and waits for the reply with its echo; others are passed over.
  [[nodiscard]] Result<const Reply*> ask(std::string_view command, line::Wait limit);
  /// The same, and the status must be 00.
  [[nodiscard]] Result<const Reply*> ask_well(std::string_view command);

  line::ByteLine line_;
  const line::Wake* wake_;
  ScipDecoder decoder_;
  std::array<char, 4096> room_{};
  std::size_t have_ = 0;  // bytes in room_
  std::size_t used_ = 0;  // of them, those the decoder has had
  line::HostTime chunk_came_{};
  line::HostTime reply_came_{};
};

}  // namespace rave::scip
