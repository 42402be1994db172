// SPDX-License-Identifier: Apache-2.0
#include "rave/line/address.hpp"

#include <gtest/gtest.h>

namespace rave::line {
namespace {

std::string error_of(const Result<Address>& address) {
  return address ? "none: " + address->text() : address.error().text();
}

TEST(Address, IsADeviceOrAServer) {
  const auto serial = parse_address("/dev/ttyACM0", 115200, "");
  ASSERT_TRUE(serial) << error_of(serial);
  EXPECT_TRUE(serial->is_serial());
  EXPECT_EQ(serial->text(), "/dev/ttyACM0");
  const auto tcp = parse_address("", 115200, "192.168.0.10:10940");
  ASSERT_TRUE(tcp) << error_of(tcp);
  EXPECT_FALSE(tcp->is_serial());
  EXPECT_EQ(tcp->host, "192.168.0.10");
  EXPECT_EQ(tcp->port, "10940");
  const auto six = parse_address("", 115200, "[::1]:7");
  ASSERT_TRUE(six) << error_of(six);
  EXPECT_EQ(six->host, "::1");
}

TEST(Address, SaysWhatIsWrong) {
  EXPECT_EQ(error_of(parse_address("", 115200, "")),
            "give exactly one of `device` (a serial line) and `address` (host:port); there is "
            "none");
  EXPECT_EQ(error_of(parse_address("/dev/x", 115200, "a:1")),
            "give exactly one of `device` (a serial line) and `address` (host:port); there are "
            "both");
  EXPECT_EQ(error_of(parse_address("/dev/x", 123, "")),
            "no serial line has 123 baud; there are 1200 2400 4800 9600 19200 38400 57600 115200 "
            "230400 460800 500000 921600 1000000");
  EXPECT_EQ(error_of(parse_address("", 0, "laser")), "`address` must be `host:port`, not `laser`");
  EXPECT_EQ(error_of(parse_address("", 0, ":80")), "`address` must be `host:port`, not `:80`");
  EXPECT_EQ(error_of(parse_address("", 0, "a:0")), "`address` must be `host:port`, not `a:0`");
  EXPECT_EQ(error_of(parse_address("", 0, "a:99999")),
            "`99999` is not a port; expected 0 to 65535");
  EXPECT_EQ(error_of(parse_address("", 0, "a:8o")), "`8o` is not a port; expected 0 to 65535");
}

}  // namespace
}  // namespace rave::line
