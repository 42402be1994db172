// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

// What libcrypto does for us, in texts of PEM and S/MIME; its own types stay in the source.
namespace rave::keys {

/// A certificate and the private key that belongs to it. The key must not be shown anywhere.
struct Credential {
  std::string certificate;
  std::string key;
};

/// Both ends in seconds since 1970.
struct Validity {
  std::int64_t from_s = 0;
  std::int64_t until_s = 0;
};

struct CertificateFacts {
  std::string name;     ///< The common name; `?` for characters that we do not write.
  std::string lab;      ///< The organisation, likewise.
  std::string subject;  ///< As permissions name it: `CN=left,O=lab`.
  Validity validity;
  std::string fingerprint;
  bool authority = false;
};

/// Creates a key on the curve P-256 and a self-signed certificate. Errors: kIo.
[[nodiscard]] Result<Credential> make_authority(const std::string& lab, const Validity& validity);

/// Creates a key and a certificate that can neither create members nor sign permissions. Errors:
/// kIo.
[[nodiscard]] Result<Credential> make_member(const Credential& authority, const std::string& name,
                                             const std::string& lab, const Validity& validity);

/// Creates an authority for browsers, constrained to these names and addresses, and a server
/// certificate for them. `names`: checked, see check_web_name(). Errors: kIo.
[[nodiscard]] Result<Credential> make_web_authority(const std::vector<std::string>& names,
                                                    const Validity& validity);
[[nodiscard]] Result<Credential> make_web_server(const Credential& authority,
                                                 const std::vector<std::string>& names,
                                                 const Validity& validity);
/// Checks that a browser that trusts the authority accepts the certificate of the server. Errors:
/// kParse, and kState if not.
[[nodiscard]] Status check_web_server(const std::string& authority, const std::string& certificate,
                                      std::int64_t now_s);

/// Signs a text; the result is S/MIME. Errors: kIo.
[[nodiscard]] Result<std::string> sign(const Credential& signer, const std::string& text);

/// Verifies such a document and returns its text. Errors: kParse, kState (signed by another key, or
/// changed).
[[nodiscard]] Result<std::string> signed_text(const std::string& certificate,
                                              const std::string& document);

/// Errors: kParse.
[[nodiscard]] Result<CertificateFacts> read_certificate(const std::string& certificate);

/// Checks that the key of `issuer` has signed `certificate`; both may be the same. Errors: kParse,
/// and kState if not.
[[nodiscard]] Status check_issued(const std::string& issuer, const std::string& certificate);

/// Checks that key and certificate belong together. Errors: kParse, and kState if not.
[[nodiscard]] Status check_pair(const Credential& credential);

}  // namespace rave::keys
