// Programs in C that use the interface, each in its own process.
#include <gtest/gtest.h>

#include "free_slot.h"
#include "program.h"
#include "reserved_port.h"
#include "temporary_directory.h"

namespace trk_bridge::test {
namespace {

TEST(CPrograms, c99_uses_everything_and_leaves_no_memory_behind) {
  FreeSlot slot;
  const TemporaryDirectory directory;
  const ReservedPort port;
  Program program({C99_USER, std::to_string(slot.number()), port.text(), directory / "take.trk"});
  EXPECT_EQ(program.rest_of_err(), "");
  EXPECT_EQ(program.wait(), 0);
  EXPECT_FALSE(slot.has_file()) << "closed at exit";
  EXPECT_EQ(slot.segment(), -1);
}

TEST(CPrograms, only_read_hides_what_writes) {
  Program program({ONLY_READ_USER});
  EXPECT_EQ(program.wait(), 0);
}

}  // namespace
}  // namespace trk_bridge::test
