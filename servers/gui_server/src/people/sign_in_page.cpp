// SPDX-License-Identifier: Apache-2.0
#include "people/sign_in_page.hpp"

#include <fmt/format.h>

#include <memory>

#include "rave/base/markup.hpp"

namespace rave::gui_server {
namespace {

// Values of the design tokens of the page (web/app).
constexpr const char* kStyle = R"(:root{color-scheme:dark light;--bg-0:#08090c;--bg-1:#12151b;
--bg-2:#191d25;--line-2:#303745;--line-3:#6b7585;--text-1:#e8ebf1;--text-2:#a9b1c0;--text-3:#8b94a5;
--intent:#a498ff;--intent-fill:#6757e6;--danger:#ff7a7a;--danger-soft:rgba(255,90,98,.13);
--grid:#151a22}
@media (prefers-color-scheme:light){:root{--bg-0:#e9ebef;--bg-1:#fff;--bg-2:#f5f6f8;--line-2:#d3d8e0;
--line-3:#868f9e;--text-1:#171a20;--text-2:#4d5563;--text-3:#5f6877;--intent:#5847d6;
--intent-fill:#5c4bdb;--danger:#c2212b;--danger-soft:rgba(194,33,43,.08);--grid:#dfe3e9}}
*{box-sizing:border-box}
body{margin:0;min-height:100vh;display:grid;place-items:center;padding:16px;color:var(--text-1);
background:linear-gradient(var(--grid) 1px,transparent 1px) 0 0/44px 44px,
linear-gradient(90deg,var(--grid) 1px,transparent 1px) 0 0/44px 44px,var(--bg-0);
font:400 13px/1.45 "Inter",system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
main{width:100%;max-width:320px;padding:24px;background:var(--bg-1);border:1px solid var(--line-2);
border-radius:8px}
header{display:flex;gap:12px;align-items:center;margin-bottom:16px}
h1{font-size:15px;font-weight:600;line-height:1.2;margin:0}
header p{margin:2px 0 0;font-size:12px;color:var(--text-2)}
label{display:block;margin:12px 0 4px;font-size:12px;color:var(--text-2)}
input{width:100%;height:36px;padding:0 10px;font:inherit;color:var(--text-1);background:var(--bg-0);
border:1px solid var(--line-3);border-radius:6px}
button{width:100%;height:40px;margin-top:16px;font:inherit;font-weight:600;color:#fff;border:0;
background:var(--intent-fill);border-radius:6px;cursor:pointer}
input:focus-visible,button:focus-visible,a:focus-visible{outline:2px solid var(--intent);
outline-offset:1px}
.note{padding:8px 10px;border-radius:6px;color:var(--danger);background:var(--danger-soft)}
.hint{margin:12px 0 0;font-size:12px;color:var(--text-3)}
a{color:var(--intent)}
)";

constexpr const char* kMark =
    R"(<svg width="30" height="24" viewBox="0 0 30 24" aria-hidden="true"><circle cx="10" cy="12" r="8" fill="currentColor"/><path d="M20 4l8 8-8 8-8-8z" fill="none" stroke="#8b7dff" stroke-width="2"/></svg>)";

// Stricter than that of the page: no script at all.
constexpr const char* kPolicy =
    "default-src 'none'; style-src 'self'; img-src 'self'; form-action 'self'; base-uri 'none'; "
    "frame-ancestors 'none'";

web::Response page_of(int status, std::string_view title, std::string_view below,
                      std::string_view note, const std::string& content) {
  std::string html = fmt::format(
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><title>{0} · RAVE</title>"
      "<link rel=\"icon\" href=\"/icon.svg\"><link rel=\"stylesheet\" "
      "href=\"/login.css\"></head><body><main><header>{1}<div><h1>{0}</h1>"
      "<p>{2}</p></div></header>",
      escaped_markup(title), kMark, escaped_markup(below));
  if (!note.empty())
    html += fmt::format("<p class=\"note\" role=\"alert\">{}</p>", escaped_markup(note));
  html += content + "</main></body></html>\n";
  web::Response response;
  response.status = status;
  response.type = "text/html; charset=utf-8";
  response.body = std::make_shared<const std::string>(std::move(html));
  response.headers.emplace_back("Cache-Control", "no-store");
  response.headers.emplace_back("Content-Security-Policy", kPolicy);
  // With the usual `no-referrer` browsers say of a form that its origin is `null`, which is
  // refused.
  response.headers.emplace_back("Referrer-Policy", "same-origin");
  return response;
}

}  // namespace

web::Response sign_in_page(int status, std::string_view note, std::string_view name) {
  const std::string focus_name = name.empty() ? " autofocus" : "";
  const std::string focus_password = name.empty() ? "" : " autofocus";
  return page_of(
      status, "RAVE", "Sign in to watch", note,
      fmt::format(
          "<form method=\"post\" action=\"/login\">"
          "<label for=\"name\">Name</label><input id=\"name\" name=\"name\" value=\"{}\" "
          "autocomplete=\"username\" maxlength=\"400\" required{}>"
          "<label for=\"password\">Password</label><input id=\"password\" name=\"password\" "
          "type=\"password\" autocomplete=\"current-password\" maxlength=\"256\"{}>"
          "<button>Sign in</button></form>"
          "<p class=\"hint\">Have a link? Paste it as the name.</p>",
          escaped_markup(name), focus_name, focus_password));
}

web::Response join_page(int status, const JoinForm& form) {
  const std::string_view fixed = form.name_is_fixed ? " readonly" : "";
  return page_of(
      status, "RAVE", "You are invited", form.note,
      fmt::format(
          "<form method=\"post\" action=\"/join\">"
          "<input type=\"hidden\" name=\"invite\" value=\"{}\">"
          "<label for=\"name\">Name that others see</label><input id=\"name\" name=\"name\" "
          "value=\"{}\" autocomplete=\"username\" maxlength=\"32\" required autofocus{}>"
          "<label for=\"password\">Password, to come back later (may stay empty)</label>"
          "<input id=\"password\" name=\"password\" type=\"password\" "
          "autocomplete=\"new-password\" maxlength=\"256\">"
          "<button>Join</button></form>"
          "<p class=\"hint\">Without a password you are in for seven days.</p>",
          escaped_markup(form.invitation), escaped_markup(form.name), fixed));
}

web::Response told_page(int status, std::string_view sentence, bool sign_in) {
  return page_of(status, "RAVE", "", sentence,
                 sign_in ? "<p class=\"hint\"><a href=\"/login\">Sign in</a></p>" : "");
}

web::Response onward_page() {
  return page_of(200, "RAVE", "", "",
                 "<meta http-equiv=\"refresh\" content=\"0;url=/\"><p><a href=\"/\">Open the "
                 "page</a></p>");
}

web::Response sign_in_style() {
  web::Response response;
  response.type = "text/css; charset=utf-8";
  response.headers.emplace_back("Cache-Control", "max-age=3600");
  static const auto kShared = std::make_shared<const std::string>(kStyle);
  response.body = kShared;
  return response;
}

}  // namespace rave::gui_server
