// SPDX-License-Identifier: Apache-2.0
// Certificate and key of the server, checked at the start and not by the first browser.
#include "tls.hpp"

#include <arpa/inet.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <array>
#include <boost/asio/ssl/context.hpp>

#include "rave/base/file.hpp"

namespace rave::web {
namespace {

namespace ssl = boost::asio::ssl;

constexpr std::size_t kLargestFile = std::size_t{1} << 20U;

struct NamesFree {
  void operator()(GENERAL_NAMES* names) const noexcept { GENERAL_NAMES_free(names); }
};

std::string address_text(const ASN1_OCTET_STRING* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const int family = ASN1_STRING_length(address) == 4 ? AF_INET : AF_INET6;
  const bool good = inet_ntop(family, ASN1_STRING_get0_data(address), text.data(), text.size());
  return good ? text.data() : "";
}

// Subject alternative names only: browsers ignore the common name.
std::vector<std::string> names_of(const X509* certificate) {
  const std::unique_ptr<GENERAL_NAMES, NamesFree> names(static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)));
  std::vector<std::string> found;
  for (int i = 0; names && i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* const name = sk_GENERAL_NAME_value(names.get(), i);
    if (name->type == GEN_DNS) {
      const auto* const text =
          reinterpret_cast<const char*>(ASN1_STRING_get0_data(name->d.dNSName));
      found.emplace_back(text, static_cast<std::size_t>(ASN1_STRING_length(name->d.dNSName)));
    } else if (name->type == GEN_IPADD) {
      found.push_back(address_text(name->d.iPAddress));
    }
  }
  return found;
}

Status check_dates(const X509* certificate, const std::filesystem::path& file) {
  if (X509_cmp_current_time(X509_get0_notAfter(certificate)) < 0) {
    return fail(ErrorCode::kState,
                "the certificate `{}` has expired; `rave keys web` makes another one",
                file.string());
  }
  if (X509_cmp_current_time(X509_get0_notBefore(certificate)) > 0) {
    return fail(ErrorCode::kState, "the certificate `{}` is not valid yet; is the clock right?",
                file.string());
  }
  return {};
}

}  // namespace

Tls::Tls() = default;
Tls::~Tls() = default;

Result<std::unique_ptr<Tls>> Tls::load(const std::filesystem::path& certificate,
                                       const std::filesystem::path& key) {
  RAVE_TRY_ASSIGN(const std::string chain, read_file(certificate, kLargestFile));
  RAVE_TRY(check_private_file(key));
  RAVE_TRY_ASSIGN(const std::string key_text, read_file(key, kLargestFile));
  std::unique_ptr<Tls> tls(new Tls);
  tls->context_ = std::make_unique<ssl::context>(ssl::context::tls_server);
  SSL_CTX* const raw = tls->context_->native_handle();
  SSL_CTX_set_min_proto_version(raw, TLS1_2_VERSION);
  // No renegotiation and no compression, which have been attacked.
  SSL_CTX_set_options(raw, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION |
                               SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_IGNORE_UNEXPECTED_EOF);
  // Ciphers with forward secrecy and authenticated encryption, as all of TLS 1.3 are.
  SSL_CTX_set_cipher_list(raw, "ECDHE+AESGCM:ECDHE+CHACHA20");
  // Otherwise libssl would ask for a password on the terminal.
  SSL_CTX_set_default_passwd_cb(raw, [](char*, int, int, void*) { return -1; });
  boost::system::error_code error;
  tls->context_->use_certificate_chain(boost::asio::buffer(chain), error);
  if (error) {
    return fail(ErrorCode::kParse, "`{}` is not a certificate: {}", certificate.string(),
                error.message());
  }
  tls->context_->use_private_key(boost::asio::buffer(key_text), ssl::context::pem, error);
  if (error || SSL_CTX_check_private_key(raw) != 1) {
    return fail(ErrorCode::kState, "`{}` is not the private key of `{}`", key.string(),
                certificate.string());
  }
  const X509* const shown = SSL_CTX_get0_certificate(raw);
  RAVE_TRY(check_dates(shown, certificate));
  tls->names_ = names_of(shown);
  if (tls->names_.empty()) {
    return fail(ErrorCode::kState, "the certificate `{}` names no host; browsers would refuse it",
                certificate.string());
  }
  return tls;
}

bool Tls::fits(const std::string& host) const {
  X509* const shown = SSL_CTX_get0_certificate(context_->native_handle());
  std::string address = host;
  if (address.starts_with('[') && address.ends_with(']')) {
    address = address.substr(1, address.size() - 2);
  }
  return X509_check_ip_asc(shown, address.c_str(), 0) == 1 ||
         X509_check_host(shown, host.data(), host.size(), X509_CHECK_FLAG_NEVER_CHECK_SUBJECT,
                         nullptr) == 1;
}

}  // namespace rave::web
