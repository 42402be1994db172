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

/// The settings of TLS and the certificate that a server shows. One thread.
class Tls {
 public:
  /// TLS 1.2 at least. Errors: kNotFound, kIo and kParse (a file), kState (the two do not belong
  /// together, or the certificate is not valid now or is for no name).
  [[nodiscard]] static Result<std::unique_ptr<Tls>> load(const std::filesystem::path& certificate,
                                                         const std::filesystem::path& key);
  ~Tls();
  Tls(const Tls&) = delete;
  Tls& operator=(const Tls&) = delete;

  [[nodiscard]] boost::asio::ssl::context& context() noexcept { return *context_; }
  /// Whether the certificate is for that name or address.
  [[nodiscard]] bool fits(const std::string& host) const;
  /// The names and addresses of the certificate; at least one.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }

 private:
  Tls();

  std::unique_ptr<boost::asio::ssl::context> context_;
  std::vector<std::string> names_;
};

}  // namespace rave::web
