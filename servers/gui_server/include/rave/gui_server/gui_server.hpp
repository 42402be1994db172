// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/direct_line/lines.hpp"

namespace rave::gui_server {

class Conductor;
class Source;

struct GuiOptions {
  std::filesystem::path page;         ///< Folder of the built page.
  std::uint16_t port = 8080;          ///< If it is in use, one of the next ones.
  std::string listen = "127.0.0.1";   ///< Other addresses require TLS and accounts.
  std::filesystem::path certificate;  ///< With `key`: TLS. See `rave keys web`.
  std::filesystem::path key;
  /// Folder of the accounts; empty: only the link of entry() signs in.
  std::filesystem::path accounts;
  /// Foxglove clients may connect to `/foxglove` with a token, to view only.
  bool foxglove = false;
  /// Origins of pages that may do so, such as `https://app.foxglove.dev`; programs without an
  /// origin always may.
  std::vector<std::string> foxglove_origins;
};

/// The GUI Server: serves the page and, over WebSockets, the data of its source, to each user what
/// their rights permit. The link of entry() signs in a super-user; it works once, and its session
/// lasts as long as the server. Others sign in with an account or an invitation.
class GuiServer {
 public:
  /// Without a source, pages wait for show(). Errors: kNotFound (the page was not built),
  /// kInvalidArgument (other addresses need TLS and accounts; an invalid origin), kIo (no port),
  /// those of web::Server::start() about the certificate, and those of Accounts::open().
  [[nodiscard]] static Result<std::unique_ptr<GuiServer>> start(
      const GuiOptions& options, std::shared_ptr<Source> source = nullptr);
  GuiServer(const GuiServer&) = delete;
  GuiServer& operator=(const GuiServer&) = delete;
  ~GuiServer();

  /// Shows another source in all pages, without a reload. Any thread.
  void show(std::shared_ptr<Source> source);

  /// Lets who may do so start and end runs from a page. Any thread.
  void conduct_by(std::shared_ptr<Conductor> conductor);

  /// Gives pages tickets for these direct lines, whose hosts have the public half of `key`. Any
  /// thread.
  void offer_lines(std::shared_ptr<direct_line::Lines> lines, const direct_line::SigningKey& key);

  [[nodiscard]] std::uint16_t port() const noexcept;
  /// A link that signs in a browser once. Each call returns a new one. Any thread.
  [[nodiscard]] std::string entry();
  /// A file that leads a browser to another such link, for its command line, which other users can
  /// read; they cannot read the file. It is removed when the server ends. Error: kIo.
  [[nodiscard]] Result<std::filesystem::path> entry_file(const std::filesystem::path& folder);
  /// The address for Foxglove. On loopback: `ws://...` with a super-user token that is valid for a
  /// week or until the server ends. Elsewhere: the address of the page where signed-in users get a
  /// token. Empty: not offered. Any thread.
  [[nodiscard]] std::string foxglove_address() const;

 private:
  class Impl;
  explicit GuiServer(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::gui_server
