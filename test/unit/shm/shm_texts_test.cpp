// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The texts of faults, for users.
#include <cerrno>
#include <string>

#include <gmock/gmock.h>

#include "shm/segment.h"

namespace trk_bridge::shm::shm_texts_test {

SlotFault fault(SlotProblem problem, std::size_t size = 0, std::uint64_t magic = 0, int other = 0, int error = 0) {
  return {problem, 7, size, magic, other, error};
}

TEST(ShmTexts, FaultsOfASlot) {
  EXPECT_EQ(describe(SlotFault{SlotProblem::bad_slot, 62}), "slot 62: no such slot; slots are 0 to 61");
  EXPECT_EQ(describe(fault(SlotProblem::no_file)), "slot 7: no segment");
  EXPECT_EQ(describe(fault(SlotProblem::no_segment)), "slot 7: no segment");
  EXPECT_EQ(describe(fault(SlotProblem::unfinished, 544)),
            "slot 7: segment of 544 bytes is empty: its creator has not finished it");
  EXPECT_EQ(describe(fault(SlotProblem::abandoned)), "slot 7: no other program is attached to its segment");
  EXPECT_EQ(describe(fault(SlotProblem::foreign, 300)), "slot 7: segment of 300 bytes is not a trk layout");
  EXPECT_EQ(describe(fault(SlotProblem::foreign, 544, 0x12345678)),
            "slot 7: segment of 544 bytes begins with 0x12345678 instead of 0x2357BD01 and is not trk");
  EXPECT_EQ(describe(fault(SlotProblem::not_a_file)), "slot 7: /tmp/dmc_tracking_buffer.7 is not a regular file");
  EXPECT_EQ(describe(fault(SlotProblem::key_zero)),
            "slot 7: /tmp/dmc_tracking_buffer.7 has the key 0, which cannot be shared; delete the file");
  EXPECT_EQ(describe(fault(SlotProblem::key_shared, 0, 0, 9)),
            "slot 7: has the same key as slot 9; delete /tmp/dmc_tracking_buffer.7 or /tmp/dmc_tracking_buffer.9, "
            "whichever is not in use");
  EXPECT_EQ(describe(fault(SlotProblem::no_key)), "slot 7: every new file in /tmp has the key of another segment");
  EXPECT_EQ(describe(fault(SlotProblem::exists)),
            "slot 7: another program creates or removes the segment at the same time");
  EXPECT_EQ(describe(fault(SlotProblem::file_refused, 0, 0, 0, EROFS)),
            "slot 7: /tmp/dmc_tracking_buffer.7: Read-only file system");
  EXPECT_EQ(describe(fault(SlotProblem::system, 0, 0, 0, ENOSPC)), "slot 7: No space left on device");
}

}  // namespace trk_bridge::shm::shm_texts_test
