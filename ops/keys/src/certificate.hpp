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

/// A new key on the curve P-256 and a certificate that it signs itself. Errors: kIo.
[[nodiscard]] Result<Credential> make_authority(const std::string& lab, const Validity& validity);

/// A new key and a certificate with which one can neither make members nor sign permissions.
/// Errors: kIo.
[[nodiscard]] Result<Credential> make_member(const Credential& authority, const std::string& name,
                                             const std::string& lab, const Validity& validity);

/// An authority for browsers, which can speak for these names and addresses alone, and a server
/// that shows itself as them. `names`: checked, see check_web_name(). Errors: kIo.
[[nodiscard]] Result<Credential> make_web_authority(const std::vector<std::string>& names,
                                                    const Validity& validity);
[[nodiscard]] Result<Credential> make_web_server(const Credential& authority,
                                                 const std::vector<std::string>& names,
                                                 const Validity& validity);
/// Whether a browser that trusts the authority takes the certificate for a server's. Errors:
/// kParse, and kState if not.
[[nodiscard]] Status check_web_server(const std::string& authority, const std::string& certificate,
                                      std::int64_t now_s);

/// The text with a signature, as S/MIME. Errors: kIo.
[[nodiscard]] Result<std::string> sign(const Credential& signer, const std::string& text);

/// The text of such a document. Errors: kParse, kState (another one has signed it, or it was
/// changed).
[[nodiscard]] Result<std::string> signed_text(const std::string& certificate,
                                              const std::string& document);

/// Errors: kParse.
[[nodiscard]] Result<CertificateFacts> read_certificate(const std::string& certificate);

/// Whether the key of `issuer` has signed `certificate`; one may be the other. Errors: kParse, and
/// kState if not.
[[nodiscard]] Status check_issued(const std::string& issuer, const std::string& certificate);

/// Whether the two belong together. Errors: kParse, and kState if not.
[[nodiscard]] Status check_pair(const Credential& credential);

}  // namespace rave::keys
