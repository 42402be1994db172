// SPDX-License-Identifier: Apache-2.0
#include "page_key.hpp"

#include <openssl/core_names.h>
#include <openssl/ecdsa.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/params.h>

#include <array>
#include <memory>

namespace rave::direct_line {
namespace {

template <auto kFree>
struct Freed {
  template <class T>
  void operator()(T* what) const noexcept {
    kFree(what);
  }
};
using Pkey = std::unique_ptr<EVP_PKEY, Freed<&EVP_PKEY_free>>;
using PkeyContext = std::unique_ptr<EVP_PKEY_CTX, Freed<&EVP_PKEY_CTX_free>>;
using Digest = std::unique_ptr<EVP_MD_CTX, Freed<&EVP_MD_CTX_free>>;
using Ecdsa = std::unique_ptr<ECDSA_SIG, Freed<&ECDSA_SIG_free>>;

constexpr std::size_t kHalf = 32;

const unsigned char* raw(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

Pkey key_of(std::string_view point) {
  const PkeyContext context(EVP_PKEY_CTX_new_from_name(nullptr, "EC", nullptr));
  std::string group = "P-256";
  std::string copy(point);
  std::array<OSSL_PARAM, 3> params = {
      OSSL_PARAM_construct_utf8_string(OSSL_PKEY_PARAM_GROUP_NAME, group.data(), group.size()),
      OSSL_PARAM_construct_octet_string(OSSL_PKEY_PARAM_PUB_KEY, copy.data(), copy.size()),
      OSSL_PARAM_construct_end()};
  EVP_PKEY* key = nullptr;
  if (!context || EVP_PKEY_fromdata_init(context.get()) != 1 ||
      EVP_PKEY_fromdata(context.get(), &key, EVP_PKEY_PUBLIC_KEY, params.data()) != 1) {
    return nullptr;
  }
  return Pkey(key);
}

/// Converts a signature to DER, the form that OpenSSL reads.
std::string der_of(std::string_view signature) {
  const Ecdsa parts(ECDSA_SIG_new());
  BIGNUM* const r = BN_bin2bn(raw(signature), kHalf, nullptr);
  BIGNUM* const s = BN_bin2bn(raw(signature.substr(kHalf)), kHalf, nullptr);
  if (!parts || r == nullptr || s == nullptr || ECDSA_SIG_set0(parts.get(), r, s) != 1) {
    BN_free(r);
    BN_free(s);
    return {};
  }
  unsigned char* bytes = nullptr;
  const int size = i2d_ECDSA_SIG(parts.get(), &bytes);
  if (size <= 0) return {};
  std::string der(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  OPENSSL_free(bytes);
  return der;
}

}  // namespace

std::string proof_text(std::string_view challenge, std::string_view address,
                       std::string_view ticket) {
  // The first line keeps a page from being made to sign something else that means this.
  std::string text = "rave line proof 1\n";
  for (const std::string_view part : {challenge, address, ticket}) text.append(part) += '\n';
  return text;
}

bool page_key_signed(std::string_view point, std::string_view signature, std::string_view text) {
  // WebCrypto gives a signature as r and s, 32 bytes each (IEEE P1363), and a point as 4, x, y
  // (uncompressed, SEC 1, 2.3.3).
  if (signature.size() != 2 * kHalf || point.size() != 2 * kHalf + 1 || point.front() != 4) {
    return false;
  }
  const Pkey key = key_of(point);
  const std::string der = der_of(signature);
  const Digest digest(EVP_MD_CTX_new());
  const bool good =
      key && !der.empty() && digest &&
      EVP_DigestVerifyInit(digest.get(), nullptr, EVP_sha256(), nullptr, key.get()) == 1 &&
      EVP_DigestVerify(digest.get(), raw(der), der.size(), raw(text), text.size()) == 1;
  // Errors stay in a list of the thread; the next user of OpenSSL there must not find these.
  ERR_clear_error();
  return good;
}

}  // namespace rave::direct_line
