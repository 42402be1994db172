// SPDX-License-Identifier: Apache-2.0
#include "explain_page.hpp"

#include <gtest/gtest.h>

namespace rave::direct_line {
namespace {

TEST(ExplainPage, SaysWhatTheWarningWasAndHowItStaysAway) {
  const web::Response page = explain_page("left");
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  for (const char* const words :
       {"<h1>Host left</h1>", "go back to the page", "The warning before this page",
        "<code>authority.pem</code> of <code>rave keys web</code>"}) {
    EXPECT_NE(page.body->find(words), std::string::npos) << words;
  }
}

TEST(ExplainPage, TheNameOfAHostIsTextAndNeverMarkup) {
  const web::Response page = explain_page("<script>alert(1)</script>&");
  EXPECT_EQ(page.body->find("<script"), std::string::npos) << *page.body;
  EXPECT_NE(page.body->find("&lt;script&gt;alert(1)&lt;/script&gt;&amp;"), std::string::npos)
      << *page.body;
}

}  // namespace
}  // namespace rave::direct_line
