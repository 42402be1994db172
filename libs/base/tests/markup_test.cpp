// SPDX-License-Identifier: Apache-2.0
#include "rave/base/markup.hpp"

#include <gtest/gtest.h>

namespace rave {
namespace {

TEST(Markup, TextStaysText) {
  EXPECT_EQ(escaped_markup("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  EXPECT_EQ(escaped_markup("ä·"), "ä·");
  EXPECT_EQ(escaped_markup(""), "");
}

}  // namespace
}  // namespace rave
