// SPDX-License-Identifier: Apache-2.0
#include "signed_text.hpp"

#include <sodium.h>

#include "rave/base/check.hpp"

namespace rave::direct_line {
namespace {

constexpr int kVariant = sodium_base64_VARIANT_URLSAFE_NO_PADDING;
static_assert(crypto_sign_PUBLICKEYBYTES == sizeof(PublicKey));
static_assert(crypto_sign_SECRETKEYBYTES == sizeof(SigningKey::secret));

const unsigned char* bytes_at(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

std::string message_of(std::string_view what, std::string_view content) {
  // The kind of the text is part of what is signed, so that no withdrawal can be shown as a ticket.
  return "rave " + std::string(what) + " 1\n" + std::string(content);
}

}  // namespace

std::string base64_of(std::string_view bytes) {
  // The length counts the zero at the end, which is removed below.
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), kVariant), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes_at(bytes), bytes.size(), kVariant);
  text.pop_back();
  return text;
}

std::optional<std::string> from_base64(std::string_view text) {
  std::string bytes(text.size() * 3 / 4 + 1, '\0');
  std::size_t size = 0;
  const char* end = nullptr;
  const int good = sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                     text.data(), text.size(), nullptr, &size, &end, kVariant);
  if (good != 0 || end != text.data() + text.size()) return std::nullopt;
  bytes.resize(size);
  return bytes;
}

std::string random_bytes(std::size_t count) {
  RAVE_CHECK(sodium_init() >= 0);
  std::string bytes(count, '\0');
  randombytes_buf(bytes.data(), bytes.size());
  return bytes;
}

SigningKey new_signing_key() {
  RAVE_CHECK(sodium_init() >= 0);
  SigningKey key;
  crypto_sign_keypair(key.open.data(), key.secret.data());
  return key;
}

std::string sign_text(std::string_view what, std::string_view content, const SigningKey& key) {
  RAVE_CHECK(sodium_init() >= 0);
  const std::string message = message_of(what, content);
  std::string signature(crypto_sign_BYTES, '\0');
  crypto_sign_detached(reinterpret_cast<unsigned char*>(signature.data()), nullptr,
                       bytes_at(message), message.size(), key.secret.data());
  return base64_of(content) + "." + base64_of(signature);
}

Result<std::string> verify_text(std::string_view what, std::string_view text,
                                const PublicKey& key) {
  RAVE_CHECK(sodium_init() >= 0);
  const std::size_t dot = text.find('.');
  // Before anything is decoded: these bytes come from strangers.
  if (text.size() > kLongestTicket || dot == std::string_view::npos) {
    return fail(ErrorCode::kParse, "not a valid {}", what);
  }
  auto content = from_base64(text.substr(0, dot));
  const auto signature = from_base64(text.substr(dot + 1));
  if (!content || !signature || signature->size() != crypto_sign_BYTES) {
    return fail(ErrorCode::kParse, "not a valid {}", what);
  }
  // Nothing in the content is read before the signature holds.
  const std::string message = message_of(what, *content);
  if (crypto_sign_verify_detached(bytes_at(*signature), bytes_at(message), message.size(),
                                  key.data()) != 0) {
    return fail(ErrorCode::kState, "the {} is not signed by the GUI Server of this run", what);
  }
  return *std::move(content);
}

}  // namespace rave::direct_line
