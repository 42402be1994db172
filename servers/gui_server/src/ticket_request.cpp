// SPDX-License-Identifier: Apache-2.0
#include "ticket_request.hpp"

#include <sodium.h>

#include <nlohmann/json.hpp>

namespace rave::gui_server {
namespace {

constexpr std::size_t kPointBytes = 65;
constexpr std::size_t kLongestRequest = 1000;

tl::unexpected<Error> wrong() {
  return fail(ErrorCode::kParse, "expected {{\"key\": \"...\"}} with a public key of P-256");
}

}  // namespace

Result<std::string> page_key_of(const std::string& text) {
  std::string key(kPointBytes, '\0');
  std::size_t size = 0;
  const int good = sodium_base642bin(reinterpret_cast<unsigned char*>(key.data()), kPointBytes,
                                     text.data(), text.size(), nullptr, &size, nullptr,
                                     sodium_base64_VARIANT_URLSAFE_NO_PADDING);
  // 4: the point is not compressed.
  if (good != 0 || size != kPointBytes || key.front() != 4) return wrong();
  return key;
}

Result<TicketRequest> parse_ticket_request(std::string_view body) {
  if (body.size() > kLongestRequest) return wrong();
  const auto object = nlohmann::json::parse(body, nullptr, false);
  if (!object.is_object() || object.size() != 1 || !object.contains("key")) return wrong();
  const nlohmann::json& key = object["key"];
  if (!key.is_string()) return wrong();
  TicketRequest request;
  RAVE_TRY_ASSIGN(request.page_key, page_key_of(key.get_ref<const std::string&>()));
  return request;
}

}  // namespace rave::gui_server
