// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "transport/scheme.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trk_bridge::transport::url_test {

using testing::AllOf;
using testing::HasSubstr;

TEST(Url, HasASchemeAPlaceAndOptionsInOrder) {
  const auto url = split_url("udp://[fe80::1%25eth0]:7000?allow=a,b&ttl=3&name=x%26y%3dz&empty=");
  ASSERT_TRUE(url) << url.error();
  EXPECT_EQ(url->scheme, "udp");
  EXPECT_EQ(url->place, "//[fe80::1%25eth0]:7000") << "the scheme decodes it";
  ASSERT_EQ(url->options.size(), 4u);
  EXPECT_EQ(url->options[0].key, "allow");
  EXPECT_EQ(url->options[0].value, "a,b");
  EXPECT_EQ(url->options[1].key, "ttl");
  EXPECT_EQ(url->options[2].value, "x&y=z");
  EXPECT_EQ(url->options[3].value, "");
}

TEST(Url, OmittedPartsAreEmpty) {
  const auto bare = split_url("shm:7");
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->scheme, "shm");
  EXPECT_EQ(bare->place, "7");
  EXPECT_TRUE(bare->options.empty());
  EXPECT_TRUE(split_url("shm:7?")->options.empty());
  EXPECT_EQ(split_url("take.trk")->scheme, "");
  EXPECT_EQ(split_url("take.trk")->place, "take.trk");
  EXPECT_EQ(split_url("")->place, "");
  EXPECT_EQ(split_url("file:a:b?c=d:e")->place, "a:b");
}

TEST(Url, WrongOptionsAreNamed) {
  EXPECT_THAT(split_url("shm:7?mode").error(), AllOf(HasSubstr("\"mode\""), HasSubstr("KEY=VALUE")));
  EXPECT_THAT(split_url("shm:7?=1").error(), HasSubstr("\"=1\""));
  EXPECT_THAT(split_url("shm:7?a=1&&b=2").error(), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(split_url("shm:7?a=1&b=2&a=1").error(), HasSubstr("option a is given twice"));
  EXPECT_THAT(split_url("shm:7?a=%zz").error(), AllOf(HasSubstr("option a"), HasSubstr("\"%zz\"")));
}

TEST(Url, PercentEncodesAByte) {
  EXPECT_EQ(percent_decoded(""), "");
  EXPECT_EQ(percent_decoded("a%20b%3F%3f%25"), "a b??%");
  EXPECT_EQ(percent_decoded("%ff"), "\xff");
  for (const char* text : {"%", "%2", "a%2", "%2g", "%g2", "%-1", "%+1", "% 1", "%00"}) {
    const auto decoded = percent_decoded(text);
    ASSERT_FALSE(decoded) << text;
    EXPECT_THAT(decoded.error(), AllOf(HasSubstr(text), HasSubstr("%25")));
  }
}

TEST(Url, AnIpv6AddressIsInBrackets) {
  EXPECT_EQ(udp_url("192.0.2.7", 7000), "udp://192.0.2.7:7000");
  EXPECT_EQ(udp_url("::1", 1), "udp://[::1]:1");
  EXPECT_EQ(udp_url("", 7000), "udp://:7000");
}

}  // namespace trk_bridge::transport::url_test
