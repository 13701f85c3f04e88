// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Programs that use the interface, in C and C++, each in its own process.
#include <gtest/gtest.h>

#include "free_slot.h"
#include "program.h"
#include "reserved_port.h"
#include "temporary_directory.h"

namespace trk_bridge::test::programs_test {

const std::string programs = std::string(USERS) + "/c_api_test_";

TEST(Users, use_everything_and_leave_no_memory_behind) {
  for (const char* library : {"trk", "trk_identified"}) {
    for (const char* standard : {"c89", "c99", "c++98"}) {
      FreeSlot slot;
      const TemporaryDirectory directory;
      const ReservedPort port;
      const std::string name = programs + "user_" + library + "_" + standard;
      Program program({name, std::to_string(slot.number()), port.text(), directory / "take.trk"});
      EXPECT_EQ(program.rest_of_err(), "") << name;
      EXPECT_EQ(program.wait(), 0) << name;
      EXPECT_FALSE(slot.has_file()) << "closed at exit";
      EXPECT_EQ(slot.segment(), -1);
    }
  }
}

TEST(Users, only_read_hides_what_writes) {
  for (const char* library : {"trk", "trk_identified"}) {
    Program program({programs + "only_read_user_" + library});
    EXPECT_EQ(program.wait(), 0) << library;
  }
}

}  // namespace trk_bridge::test::programs_test
