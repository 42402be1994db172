// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "rave/line/byte_line.hpp"
#include "scip_laser/scip_decoder.hpp"
#include "scip_laser/scip_parameters.hpp"
#include "scip_laser/scip_scan.hpp"

namespace rave::scip {

/// The properties of a device from its replies to VV and PP.
struct Identity {
  std::string product;
  std::string firmware;
  std::string serial;
  std::string protocol;
  Parameters parameters;
};

/// A session with a device over an open line. For one thread; every wait ends when `wake` rings
/// (null: none), which must outlive the session.
class ScipSession {
 public:
  ScipSession(line::ByteLine line, const line::Wake* wake) : line_(std::move(line)), wake_(wake) {}

  /// Stops any measurement (QT), selects SCIP 2.0, resets (RS), and reads VV and PP. It also
  /// recovers a device that is sending a scan or is in SCIP 1.1 mode. Errors: kTimeout (no answer),
  /// kIo (the line is lost), kParse, kState (woken).
  [[nodiscard]] Result<Identity> identify();
  /// Switches the laser on (BM) and, in continuous mode, requests scans.
  [[nodiscard]] Status begin(const ScanRequest& request);
  /// Requests one scan, in polled mode.
  [[nodiscard]] Status poll(const ScanRequest& request);
  /// Switches the laser off if the line permits, without waiting for an answer.
  void end() noexcept;

  struct Next {
    line::ReadEnd end = line::ReadEnd::kTimeout;  ///< kBytes: `reply` is set.
    const Reply* reply = nullptr;                 ///< Valid until the next call.
    line::HostTime arrived;                       ///< When the first byte of the reply was read.
  };
  /// Reads the next reply of any kind.
  [[nodiscard]] Next next(line::HostTime limit);

  [[nodiscard]] const std::string& lost() const noexcept { return line_.lost(); }
  [[nodiscard]] const ScipDecoder::Counts& counts() const noexcept { return decoder_.counts(); }

 private:
  [[nodiscard]] Status send(std::string_view command);
  /// Sends a command and waits for the reply with its echo; other replies are skipped.
  [[nodiscard]] Result<const Reply*> ask(std::string_view command, line::Wait limit);
  /// Like ask(), but the status must be 00.
  [[nodiscard]] Result<const Reply*> ask_well(std::string_view command);

  line::ByteLine line_;
  const line::Wake* wake_;
  ScipDecoder decoder_;
  std::array<char, 4096> room_{};
  std::size_t have_ = 0;  // bytes in room_
  std::size_t used_ = 0;  // of these, passed to the decoder
  line::HostTime chunk_came_{};
  line::HostTime reply_came_{};
};

}  // namespace rave::scip
