// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace boost::asio::ssl {  // their own name. NOLINT(readability-identifier-naming)
class context;
}

namespace rave::web {

/// The TLS settings and the certificate of a server. One thread.
class Tls {
 public:
  /// Requires at least TLS 1.2. Errors: kNotFound, kIo and kParse (a file), kState (certificate and
  /// key do not match, or the certificate is not valid now or has no name).
  [[nodiscard]] static Result<std::unique_ptr<Tls>> load(const std::filesystem::path& certificate,
                                                         const std::filesystem::path& key);
  ~Tls();
  Tls(const Tls&) = delete;
  Tls& operator=(const Tls&) = delete;

  [[nodiscard]] boost::asio::ssl::context& context() noexcept { return *context_; }
  /// Whether the certificate is valid for that name or address.
  [[nodiscard]] bool fits(const std::string& host) const;
  /// The names and addresses of the certificate; at least one.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }

 private:
  Tls();

  std::unique_ptr<boost::asio::ssl::context> context_;
  std::vector<std::string> names_;
};

}  // namespace rave::web
