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

class Source;

struct GuiOptions {
  std::filesystem::path page;         ///< Folder of the built page.
  std::uint16_t port = 8080;          ///< Taken: one of the next ones.
  std::string listen = "127.0.0.1";   ///< Another address needs TLS and accounts.
  std::filesystem::path certificate;  ///< With `key`: TLS. See `rave keys web`.
  std::filesystem::path key;
  std::filesystem::path accounts;  ///< Folder; empty: nobody but who has the link comes in.
  /// Foxglove clients may connect to `/foxglove`, with a token; they only look.
  bool foxglove = false;
  /// Pages that may do so, such as `https://app.foxglove.dev`, beside programs without an origin.
  std::vector<std::string> foxglove_origins;
};

/// The GUI Server: serves the page and, over WebSockets, what its source knows, to each what their
/// rights allow. Who has the link of entry() comes in as super-user; it works once, and the session
/// that it begins lasts as long as the server. Others sign in with an account or an invitation.
class GuiServer {
 public:
  /// Without a source pages wait for show(). Errors: kNotFound (the page was not built),
  /// kInvalidArgument (to listen elsewhere needs TLS and accounts; an origin is none), kIo (no
  /// port), those of web::Server::start() of the certificate and of Accounts::open().
  [[nodiscard]] static Result<std::unique_ptr<GuiServer>> start(
      const GuiOptions& options, std::shared_ptr<Source> source = nullptr);
  GuiServer(const GuiServer&) = delete;
  GuiServer& operator=(const GuiServer&) = delete;
  ~GuiServer();

  /// All pages see this source from now on, without a reload. Any thread.
  void show(std::shared_ptr<Source> source);

  /// From now on pages get tickets for these direct lines, whose hosts know `key`. Any thread.
  void offer_lines(std::shared_ptr<direct_line::Lines> lines, const direct_line::SigningKey& key);

  [[nodiscard]] std::uint16_t port() const noexcept;
  /// A link that signs a browser in, once. Each call makes another one. Any thread.
  [[nodiscard]] std::string entry();
  /// Where Foxglove connects: on loopback `ws://...` with the token of a super-user, which is good
  /// for a week or until the server ends; elsewhere the address of the page that gives people who
  /// are signed in their own. Empty: it is not offered. Any thread.
  [[nodiscard]] std::string foxglove_address() const;

 private:
  class Impl;
  explicit GuiServer(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::gui_server
