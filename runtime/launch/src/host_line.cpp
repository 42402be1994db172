// SPDX-License-Identifier: Apache-2.0
#include "rave/launch/host_line.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "rave/base/number.hpp"
#include "rave/direct_line/key_files.hpp"

namespace rave::launch {
namespace {

Result<std::uint16_t> port_of(std::string_view text, const std::string& whole) {
  if (const auto port = number_of<std::uint16_t>(text)) return *port;
  return fail(ErrorCode::kInvalidArgument,
              "--web {}: expected ADDRESS:PORT, such as 192.168.1.20:8090", whole);
}

/// Reads LineArguments::web. Error kInvalidArgument.
Status read_place(const std::string& text, direct_line::LineOptions& options) {
  if (text.empty()) return {};
  // Digits alone are a port: `--web 8090`.
  const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
  const std::size_t bracket = text.rfind(']');
  const std::size_t colon = text.rfind(':');
  // Colons inside the brackets of an IPv6 address are part of it.
  const bool has_port =
      colon != std::string::npos && (bracket == std::string::npos || colon > bracket);
  std::string address = digits ? "" : text.substr(0, has_port ? colon : std::string::npos);
  if (address.starts_with('[') && address.ends_with(']')) {
    address = address.substr(1, address.size() - 2);
  }
  if (!address.empty()) options.address = address;
  if (digits) {
    RAVE_TRY_ASSIGN(options.port, port_of(text, text));
  } else if (has_port) {
    RAVE_TRY_ASSIGN(options.port, port_of(std::string_view(text).substr(colon + 1), text));
  }
  return {};
}

/// The file with the public key of tickets: as given, or that beside the certificates of the host.
Result<std::filesystem::path> key_place(const LineArguments& arguments, const bus::BusConfig& bus) {
  if (!arguments.web_key.empty()) return std::filesystem::path(arguments.web_key);
  const std::filesystem::path beside = bus.security / direct_line::kMemberKeyFile;
  std::error_code error;
  if (!bus.security.empty() && std::filesystem::exists(beside, error)) return beside;
  return fail(ErrorCode::kInvalidArgument,
              "--web needs --web-key FILE, the public key of the GUI Server: `rave keys line "
              "FILE` creates FILE for `rave gui --line-key` and FILE.pub for hosts{}",
              bus.security.empty() ? std::string()
                                   : fmt::format("; there is no `{}` either", beside.string()));
}

}  // namespace

Result<direct_line::LineOptions> line_options(const LineArguments& arguments, LogSink& log) {
  direct_line::LineOptions options;
  RAVE_TRY(read_place(*arguments.web, options));
  options.certificate = arguments.certificate;
  options.key = arguments.key;
  options.log = &log;
  return options;
}

Result<HostLineEnds> open_host_line(const LineArguments& arguments, const std::string& host,
                                    const bus::BusConfig& bus, runtime::RunControl& control,
                                    LogSink& log) {
  HostLineEnds ends;
  if (!arguments.web) {
    if (arguments.web_key.empty()) return ends;
    return fail(ErrorCode::kInvalidArgument, "--web-key needs --web");
  }
  RAVE_TRY_ASSIGN(const std::filesystem::path key, key_place(arguments, bus));
  RAVE_TRY_ASSIGN(auto options, line_options(arguments, log));
  RAVE_TRY_ASSIGN(options.signer, direct_line::read_public_key(key));
  options.run = bus.run.text();
  options.host = host;
  RAVE_TRY_ASSIGN(ends.server, direct_line::LineServer::start(options, control));
  // After the server: the beacon announces the port that the system chose for it.
  RAVE_TRY_ASSIGN(ends.beacon,
                  direct_line::LineBeacon::start(bus, host, *ends.server, control, log));
  return ends;
}

}  // namespace rave::launch
