// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_session.hpp"

namespace rave::scip {
namespace {

using line::ReadEnd;

constexpr line::Wait kAnswer{500};   // devices answer within some ten milliseconds
constexpr line::Wait kPerhaps{300};  // for commands that some devices do not answer

}  // namespace

Status ScipSession::send(std::string_view command) {
  return line_.write(std::string(command) + "\n", kAnswer, wake_);
}

ScipSession::Next ScipSession::next(line::HostTime limit) {
  while (true) {
    while (used_ < have_) {
      // The time of the chunk with the first byte of the reply: later bytes of a long scan arrive
      // up to several milliseconds after it.
      if (decoder_.between_replies()) reply_came_ = chunk_came_;
      const Reply* const reply = decoder_.push(room_[used_++]);
      if (reply != nullptr) return {ReadEnd::kBytes, reply, reply_came_};
    }
    used_ = 0;
    have_ = 0;
    const auto got = line_.read(room_, line::until(limit), wake_);
    if (got.end != ReadEnd::kBytes) return {got.end, nullptr, {}};
    chunk_came_ = line::host_now();
    have_ = got.size;
  }
}

Result<const Reply*> ScipSession::ask(std::string_view command, line::Wait limit) {
  RAVE_TRY(send(command));
  const line::HostTime end = line::host_now() + limit;
  while (true) {
    const Next got = next(end);
    switch (got.end) {
      case ReadEnd::kBytes:
        // Other replies are scans of a stream that an earlier host left running.
        if (got.reply->echo == command) return got.reply;
        break;
      case ReadEnd::kTimeout:
        return fail(ErrorCode::kTimeout, "no answer to `{}`", command);
      case ReadEnd::kWoken:
        return fail(ErrorCode::kState, "closed while waiting for an answer to `{}`", command);
      case ReadEnd::kLost:
        return fail(ErrorCode::kIo, "the line was lost while waiting for an answer to `{}`: {}",
                    command, line_.lost());
    }
  }
}

Result<const Reply*> ScipSession::ask_well(std::string_view command) {
  RAVE_TRY_ASSIGN(const Reply* const reply, ask(command, kAnswer));
  if (reply->status != "00") {
    return fail(ErrorCode::kIo, "the device refused `{}`: {}", command,
                describe_status(reply->status));
  }
  return reply;
}

Result<Identity> ScipSession::identify() {
  decoder_.reset();
  // The empty line ends a command that an earlier host left unfinished.
  RAVE_TRY(send(""));
  // QT stops a stream that an earlier host left running. SCIP2.0 changes the protocol of devices
  // that begin with an older one. Not all devices answer all three, so no answer is required.
  for (const std::string_view command : {"QT", "SCIP2.0", "QT"}) {
    const auto answer = ask(command, kPerhaps);
    if (!answer && answer.error().code != ErrorCode::kTimeout) {
      return tl::unexpected<Error>(answer.error());
    }
  }
  // A reset, because an earlier host may have changed settings.
  RAVE_TRY(ask_well("RS"));
  Identity identity;
  RAVE_TRY_ASSIGN(const Reply* const version, ask_well("VV"));
  identity.product = value_of(version->lines, "PROD");
  identity.firmware = value_of(version->lines, "FIRM");
  identity.serial = value_of(version->lines, "SERI");
  identity.protocol = value_of(version->lines, "PROT");
  RAVE_TRY_ASSIGN(const Reply* const parameters, ask_well("PP"));
  RAVE_TRY_ASSIGN(identity.parameters, parse_parameters(parameters->lines));
  return identity;
}

Status ScipSession::begin(const ScanRequest& request) {
  RAVE_TRY_ASSIGN(const Reply* const lit, ask("BM", kAnswer));
  // 02: already on.
  if (lit->status != "00" && lit->status != "02") {
    return fail(ErrorCode::kIo, "the laser cannot be switched on: {}",
                describe_status(lit->status));
  }
  if (!request.continuous) return {};
  RAVE_TRY(ask_well(request.command()));
  return {};
}

Status ScipSession::poll(const ScanRequest& request) { return send(request.command()); }

void ScipSession::end() noexcept {
  // Not interrupted by the bell that ends the session.
  (void)line_.write("QT\n", line::Wait(50), nullptr);
}

}  // namespace rave::scip
