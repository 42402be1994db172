// SPDX-License-Identifier: Apache-2.0
#include "rave/direct_line/key_files.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <span>

#include "rave/base/file.hpp"

namespace rave::direct_line {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSecretWord = "rave-line-secret ";
constexpr std::string_view kPublicWord = "rave-line-public ";
constexpr std::size_t kLargestKeyFile = 4096;

std::string hex_of(std::span<const unsigned char> bytes) {
  std::string text(2 * bytes.size() + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  text.pop_back();
  return text;
}

/// Reads a file of the form `WORD HEX`.
Status read_line(const fs::path& file, std::string_view word, std::span<unsigned char> bytes) {
  RAVE_TRY_ASSIGN(std::string text, read_file(file, kLargestKeyFile));
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const bool secret = word == kSecretWord;
  if (text.starts_with(secret ? kPublicWord : kSecretWord)) {
    return fail(ErrorCode::kParse, "`{}` is the {} half of the key; expected the {} half",
                file.string(), secret ? "public" : "secret", secret ? "secret" : "public");
  }
  std::size_t size = 0;
  const char* end = nullptr;
  const std::string_view hex =
      text.starts_with(word) ? std::string_view(text).substr(word.size()) : std::string_view();
  const int good =
      sodium_hex2bin(bytes.data(), bytes.size(), hex.data(), hex.size(), nullptr, &size, &end);
  if (hex.empty() || good != 0 || size != bytes.size() || end != hex.data() + hex.size()) {
    return fail(ErrorCode::kParse,
                "`{}` is not a key of direct lines; `rave keys line FILE` creates one",
                file.string());
  }
  return {};
}

}  // namespace

Status write_public_key(const fs::path& file, const PublicKey& key) {
  return write_file_atomically(file, fmt::format("{}{}\n", kPublicWord, hex_of(key)));
}

Status make_key_files(const fs::path& file) {
  fs::path open = file;
  open += ".pub";
  std::error_code error;
  for (const fs::path& each : {file, open}) {
    if (fs::exists(each, error)) {
      return fail(ErrorCode::kInvalidArgument, "`{}` already exists; choose another name",
                  each.string());
    }
  }
  const SigningKey key = new_signing_key();
  const std::string text = fmt::format("{}{}\n", kSecretWord, hex_of(key.secret));
  RAVE_TRY(write_private_file(file, text));
  return write_public_key(open, key.open);
}

Result<SigningKey> read_signing_key(const fs::path& file) {
  SigningKey key;
  RAVE_TRY(read_line(file, kSecretWord, key.secret));
  RAVE_TRY(check_private_file(file));
  crypto_sign_ed25519_sk_to_pk(key.open.data(), key.secret.data());
  return key;
}

Result<PublicKey> read_public_key(const fs::path& file) {
  PublicKey key{};
  RAVE_TRY(read_line(file, kPublicWord, key));
  return key;
}

}  // namespace rave::direct_line
