// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "shm/scheme.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "url_errors.h"

namespace trk_bridge::shm::shm_settings_test {

using test::read_error;
using testing::AllOf;
using testing::HasSubstr;

Settings shm_in(const std::string& url) {
  const auto settings = source_settings(transport::split_url(url).value());
  if (!settings) ADD_FAILURE() << settings.error();
  return settings.value_or(Settings{});
}
Settings shm_out(const std::string& url) {
  const auto settings = sink_settings(transport::split_url(url).value());
  if (!settings) ADD_FAILURE() << settings.error();
  return settings.value_or(Settings{});
}

TEST(ShmSettings, SharedMemory) {
  const auto defaults = shm_out("shm:0");
  EXPECT_EQ(defaults.slot, 0);
  EXPECT_EQ(defaults.mode, 0666);
  EXPECT_FALSE(defaults.recreate);
  const auto e = shm_out("shm:61?mode=0640&recreate=1&layout=identified_i386");
  EXPECT_EQ(e.slot, 61);
  EXPECT_EQ(e.mode, 0640);
  EXPECT_TRUE(e.recreate);
  EXPECT_EQ(e.layout.abi, wire::Abi::i386);
  EXPECT_EQ(shm_in("shm:7").slot, 7);
  for (const char* url : {"shm:", "shm:62", "shm:-1", "shm:A", "shm://7", "shm:7/"}) {
    EXPECT_THAT(read_error(url), AllOf(HasSubstr("slot = "), HasSubstr("0 to 61"))) << url;
  }
}

}  // namespace trk_bridge::shm::shm_settings_test
