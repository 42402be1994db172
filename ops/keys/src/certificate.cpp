// SPDX-License-Identifier: Apache-2.0
#include "certificate.hpp"

#include <openssl/bn.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <ctime>
#include <memory>
#include <span>

#include "web_names.hpp"

namespace rave::keys {
namespace {

// libcrypto is a C library with a function for freeing each type. These pointers call it, so an
// error on the way leaks nothing.
template <auto kFree>
struct Freer {
  template <class T>
  void operator()(T* object) const noexcept {
    kFree(object);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Freer<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freer<X509_free>>;
using Name = std::unique_ptr<X509_NAME, Freer<X509_NAME_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freer<X509_EXTENSION_free>>;
using Number = std::unique_ptr<BIGNUM, Freer<BN_free>>;
using Stream = std::unique_ptr<BIO, Freer<BIO_free_all>>;
using Signed = std::unique_ptr<PKCS7, Freer<PKCS7_free>>;
using Store = std::unique_ptr<X509_STORE, Freer<X509_STORE_free>>;
using Check = std::unique_ptr<X509_STORE_CTX, Freer<X509_STORE_CTX_free>>;

/// The parts of a certificate that differ between kinds.
struct Extra {
  int kind = 0;
  std::string value;
};

struct StackFree {
  /// Frees the container only; others own the certificates in it.
  void operator()(STACK_OF(X509) * stack) const noexcept { sk_X509_free(stack); }
};
using Certificates = std::unique_ptr<STACK_OF(X509), StackFree>;

/// An error with `what` and the reasons in the error queue of libcrypto.
tl::unexpected<Error> failed(ErrorCode code, std::string_view what) {
  std::string reasons;
  while (const unsigned long number = ERR_get_error()) {
    const char* const reason = ERR_reason_error_string(number);
    reasons += reasons.empty() ? ": " : ", ";
    reasons += reason == nullptr ? fmt::format("error {:x}", number) : reason;
  }
  return fail(code, "{}{}", what, reasons);
}

/// A stream that reads a text, which must outlive it.
Stream reading(const std::string& text) {
  return Stream(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

Stream writing() { return Stream(BIO_new(BIO_s_mem())); }

std::string content_of(BIO* stream) {
  std::string content;
  char buffer[4096];
  int count = 0;
  while ((count = BIO_read(stream, buffer, sizeof buffer)) > 0) {
    content.append(buffer, static_cast<std::size_t>(count));
  }
  return content;
}

/// Refuses encrypted keys. Without it libcrypto would ask for a password at the terminal.
int no_passphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* /*user*/) { return -1; }

Result<Certificate> parse_certificate(const std::string& text) {
  ERR_clear_error();
  const Stream stream = reading(text);
  Certificate certificate(PEM_read_bio_X509(stream.get(), nullptr, no_passphrase, nullptr));
  if (!certificate) return failed(ErrorCode::kParse, "it is not a certificate");
  return certificate;
}

Result<Key> parse_key(const std::string& text) {
  ERR_clear_error();
  const Stream stream = reading(text);
  Key key(PEM_read_bio_PrivateKey(stream.get(), nullptr, no_passphrase, nullptr));
  if (!key) return failed(ErrorCode::kParse, "it is not a private key");
  return key;
}

bool add_entry(X509_NAME* name, const char* field, const std::string& value) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(value.data());
  return X509_NAME_add_entry_by_txt(name, field, MBSTRING_ASC, bytes,
                                    static_cast<int>(value.size()), -1, 0) == 1;
}

/// `O` before `CN`, which RFC 2253 writes the other way round.
Name make_name(const std::string& common, const std::string& lab) {
  Name name(X509_NAME_new());
  if (!add_entry(name.get(), "O", lab) || !add_entry(name.get(), "CN", common)) return nullptr;
  return name;
}

/// A random serial number: unpredictable and unique.
bool set_serial(X509* certificate) {
  const Number serial(BN_new());
  // A serial number has at most 20 octets and is positive (RFC 5280, 4.1.2.2), which leaves 159
  // bits.
  constexpr int kBits = 159;
  return BN_rand(serial.get(), kBits, BN_RAND_TOP_ANY, BN_RAND_BOTTOM_ANY) == 1 &&
         BN_to_ASN1_INTEGER(serial.get(), X509_get_serialNumber(certificate)) != nullptr;
}

bool set_validity(X509* certificate, const Validity& validity) {
  return ASN1_TIME_set(X509_getm_notBefore(certificate), validity.from_s) != nullptr &&
         ASN1_TIME_set(X509_getm_notAfter(certificate), validity.until_s) != nullptr;
}

bool add_extension(X509* issuer, X509* certificate, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  context.db = nullptr;
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value));
  return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

/// What the key may be used for. Only an authority makes members and signs permissions.
bool add_extensions(X509* issuer, X509* certificate) {
  const bool authority = issuer == certificate;
  // "critical": a program that does not understand the extension must refuse the certificate.
  // "pathlen:0": the authority makes members, but no further authorities.
  return add_extension(issuer, certificate, NID_basic_constraints,
                       authority ? "critical,CA:TRUE,pathlen:0" : "critical,CA:FALSE") &&
         add_extension(
             issuer, certificate, NID_key_usage,
             authority ? "critical,keyCertSign,digitalSignature" : "critical,digitalSignature") &&
         add_extension(issuer, certificate, NID_subject_key_identifier, "hash") &&
         (authority ||
          add_extension(issuer, certificate, NID_authority_key_identifier, "keyid:always"));
}

Result<std::string> text_of(const Key& key) {
  const Stream stream = writing();
  if (PEM_write_bio_PKCS8PrivateKey(stream.get(), key.get(), nullptr, nullptr, 0, nullptr,
                                    nullptr) != 1) {
    return failed(ErrorCode::kIo, "cannot write a private key");
  }
  return content_of(stream.get());
}

/// A fresh key with a certificate. Without an issuer it signs itself.
Result<Credential> make_credential(const Name& name, const Validity& validity, X509* issuer,
                                   EVP_PKEY* issuer_key, std::span<const Extra> extras = {}) {
  // The curve P-256, which DDS Security supports for identities.
  const Key key(EVP_PKEY_Q_keygen(nullptr, nullptr, "EC", "P-256"));
  const Certificate certificate(X509_new());
  if (!key || !certificate || !name) return failed(ErrorCode::kIo, "cannot create a key");
  X509* const made = certificate.get();
  if (issuer == nullptr) issuer = made;
  bool filled = X509_set_version(made, X509_VERSION_3) == 1 && set_serial(made) &&
                X509_set_subject_name(made, name.get()) == 1 &&
                X509_set_issuer_name(made, X509_get_subject_name(issuer)) == 1 &&
                set_validity(made, validity) && X509_set_pubkey(made, key.get()) == 1 &&
                add_extensions(issuer, made);
  for (const Extra& extra : extras) {
    filled = filled && add_extension(issuer, made, extra.kind, extra.value.c_str());
  }
  EVP_PKEY* const signer = issuer_key == nullptr ? key.get() : issuer_key;
  const Stream stream = writing();
  if (!filled || X509_sign(made, signer, EVP_sha256()) == 0 ||
      PEM_write_bio_X509(stream.get(), made) != 1) {
    return failed(ErrorCode::kIo, "cannot create a certificate");
  }
  RAVE_TRY_ASSIGN(std::string key_text, text_of(key));
  return Credential{content_of(stream.get()), std::move(key_text)};
}

/// An entry of a name, without characters that could control a terminal.
std::string entry_of(const X509_NAME* name, int field) {
  const int place = X509_NAME_get_index_by_NID(name, field, -1);
  if (place < 0) return "?";
  const ASN1_STRING* const value = X509_NAME_ENTRY_get_data(X509_NAME_get_entry(name, place));
  const auto* const bytes = reinterpret_cast<const char*>(ASN1_STRING_get0_data(value));
  std::string text(bytes, static_cast<std::size_t>(ASN1_STRING_length(value)));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

Result<std::int64_t> moment_of(const ASN1_TIME* time) {
  std::tm fields{};
  if (ASN1_TIME_to_tm(time, &fields) != 1) {
    return failed(ErrorCode::kParse, "its certificate has no dates");
  }
  return ::timegm(&fields);
}

std::string fingerprint_of(const X509* certificate) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (X509_digest(certificate, EVP_sha256(), digest, &size) != 1) return "?";
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += fmt::format("{}{:02X}", i == 0 ? "" : ":", digest[i]);
  }
  return text;
}

}  // namespace

Result<Credential> make_authority(const std::string& lab, const Validity& validity) {
  ERR_clear_error();
  // Names of members have no blanks, so no member can have this name.
  return make_credential(make_name("RAVE authority", lab), validity, nullptr, nullptr);
}

Result<Credential> make_member(const Credential& authority, const std::string& name,
                               const std::string& lab, const Validity& validity) {
  RAVE_TRY_ASSIGN(const Certificate issuer, parse_certificate(authority.certificate));
  RAVE_TRY_ASSIGN(const Key issuer_key, parse_key(authority.key));
  return make_credential(make_name(name, lab), validity, issuer.get(), issuer_key.get());
}

namespace {

constexpr const char* kWebLab = "RAVE pages";

}  // namespace

Result<Credential> make_web_authority(const std::vector<std::string>& names,
                                      const Validity& validity) {
  ERR_clear_error();
  // Browsers that trust this authority trust it for these names only. So the thief of a key
  // cannot make a certificate that they accept for another name.
  const std::vector<Extra> extras = {{NID_name_constraints, constraints_for(names)},
                                     {NID_ext_key_usage, "serverAuth"}};
  const Name name = make_name("Authority for " + names.front().substr(0, 50), kWebLab);
  return make_credential(name, validity, nullptr, nullptr, extras);
}

Result<Credential> make_web_server(const Credential& authority,
                                   const std::vector<std::string>& names,
                                   const Validity& validity) {
  RAVE_TRY_ASSIGN(const Certificate issuer, parse_certificate(authority.certificate));
  RAVE_TRY_ASSIGN(const Key issuer_key, parse_key(authority.key));
  const std::vector<Extra> extras = {{NID_subject_alt_name, alternatives_for(names)},
                                     {NID_ext_key_usage, "serverAuth"}};
  // With a blank the name cannot be taken for a host name; browsers use the list of names only.
  const Name name = make_name("Page of " + names.front().substr(0, 50), kWebLab);
  return make_credential(name, validity, issuer.get(), issuer_key.get(), extras);
}

Status check_web_server(const std::string& authority, const std::string& certificate,
                        std::int64_t now_s) {
  RAVE_TRY_ASSIGN(const Certificate trusted, parse_certificate(authority));
  RAVE_TRY_ASSIGN(const Certificate shown, parse_certificate(certificate));
  const Store store(X509_STORE_new());
  const Check check(X509_STORE_CTX_new());
  if (!store || !check || X509_STORE_add_cert(store.get(), trusted.get()) != 1 ||
      X509_STORE_CTX_init(check.get(), store.get(), shown.get(), nullptr) != 1) {
    return failed(ErrorCode::kIo, "cannot check a certificate");
  }
  // Verified as by a browser, so a mistake is found here and not at the first visit.
  X509_STORE_CTX_set_purpose(check.get(), X509_PURPOSE_SSL_SERVER);
  X509_STORE_CTX_set_time(check.get(), 0, now_s);
  if (X509_verify_cert(check.get()) != 1) {
    const int reason = X509_STORE_CTX_get_error(check.get());
    return fail(ErrorCode::kState, "{}", X509_verify_cert_error_string(reason));
  }
  return {};
}

Result<std::string> sign(const Credential& signer, const std::string& text) {
  RAVE_TRY_ASSIGN(const Certificate certificate, parse_certificate(signer.certificate));
  RAVE_TRY_ASSIGN(const Key key, parse_key(signer.key));
  const Stream in = reading(text);
  const Stream out = writing();
  // S/MIME with the text beside the signature is the form that DDS Security prescribes for
  // governance and permissions.
  constexpr int kFlags = PKCS7_DETACHED | PKCS7_TEXT | PKCS7_STREAM;
  const Signed document(PKCS7_sign(certificate.get(), key.get(), nullptr, in.get(), kFlags));
  if (!document || SMIME_write_PKCS7(out.get(), document.get(), in.get(), kFlags) != 1) {
    return failed(ErrorCode::kIo, "cannot sign");
  }
  return content_of(out.get());
}

namespace {

/// PKCS7_verify() of OpenSSL 3.0 keeps memory for ever if it does not know a digest of the
/// document.
bool has_known_digests(const PKCS7* document) {
  if (!PKCS7_type_is_signed(document)) return false;
  const STACK_OF(X509_ALGOR)* const digests = document->d.sign->md_algs;
  for (int i = 0; i < sk_X509_ALGOR_num(digests); ++i) {
    const ASN1_OBJECT* digest = nullptr;
    X509_ALGOR_get0(&digest, nullptr, nullptr, sk_X509_ALGOR_value(digests, i));
    const int id = OBJ_obj2nid(digest);
    if (id != NID_sha256 && id != NID_sha384 && id != NID_sha512) return false;
  }
  return true;
}

}  // namespace

Result<std::string> signed_text(const std::string& certificate, const std::string& document) {
  RAVE_TRY_ASSIGN(const Certificate signer, parse_certificate(certificate));
  const Stream in = reading(document);
  BIO* raw_content = nullptr;
  const Signed parsed(SMIME_read_PKCS7(in.get(), &raw_content));
  const Stream content(raw_content);
  if (!parsed) return failed(ErrorCode::kParse, "it is not a signed document");
  if (!has_known_digests(parsed.get())) {
    return fail(ErrorCode::kParse, "it is not a document signed with SHA-256, 384 or 512");
  }
  const Certificates signers(sk_X509_new_null());
  const Stream out = writing();
  if (!signers || sk_X509_push(signers.get(), signer.get()) == 0) {
    return failed(ErrorCode::kIo, "cannot check a signature");
  }
  // As in DDS Security: the signer must be exactly this certificate, whatever certificates the
  // document contains.
  if (PKCS7_verify(parsed.get(), signers.get(), nullptr, content.get(), out.get(),
                   PKCS7_TEXT | PKCS7_NOVERIFY | PKCS7_NOINTERN) != 1) {
    return failed(ErrorCode::kState, "it was not signed by the authority");
  }
  return content_of(out.get());
}

Result<CertificateFacts> read_certificate(const std::string& certificate) {
  RAVE_TRY_ASSIGN(const Certificate parsed, parse_certificate(certificate));
  const X509_NAME* const name = X509_get_subject_name(parsed.get());
  CertificateFacts facts;
  facts.name = entry_of(name, NID_commonName);
  facts.lab = entry_of(name, NID_organizationName);
  const Stream subject = writing();
  X509_NAME_print_ex(subject.get(), name, 0, XN_FLAG_RFC2253);
  facts.subject = content_of(subject.get());
  RAVE_TRY_ASSIGN(facts.validity.from_s, moment_of(X509_get0_notBefore(parsed.get())));
  RAVE_TRY_ASSIGN(facts.validity.until_s, moment_of(X509_get0_notAfter(parsed.get())));
  facts.fingerprint = fingerprint_of(parsed.get());
  facts.authority = X509_check_ca(parsed.get()) == 1;
  return facts;
}

Status check_issued(const std::string& issuer, const std::string& certificate) {
  RAVE_TRY_ASSIGN(const Certificate parsed_issuer, parse_certificate(issuer));
  RAVE_TRY_ASSIGN(const Certificate parsed, parse_certificate(certificate));
  EVP_PKEY* const key = X509_get0_pubkey(parsed_issuer.get());
  if (key == nullptr || X509_verify(parsed.get(), key) != 1) {
    return failed(ErrorCode::kState, "the authority has not signed it");
  }
  return {};
}

Status check_pair(const Credential& credential) {
  RAVE_TRY_ASSIGN(const Certificate certificate, parse_certificate(credential.certificate));
  RAVE_TRY_ASSIGN(const Key key, parse_key(credential.key));
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    return failed(ErrorCode::kState, "the certificate does not match the key");
  }
  return {};
}

}  // namespace rave::keys
