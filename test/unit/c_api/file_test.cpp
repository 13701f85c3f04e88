// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Transfer by file, and all its misuses.
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "c_records.h"
#include "temporary_directory.h"
#include "trk_file.h"

namespace trk_bridge::c_api::file_test {

using trk_bridge::test::constants_in_c;
using trk_bridge::test::no_handles;
using trk_bridge::test::params_in_c;
using trk_bridge::test::text_of;

class File : public ::testing::Test {
 protected:
  trk_bridge::test::TemporaryDirectory directory;
  std::string name = directory.path() + "/take.trk";
  trkHandle handle = nullptr;
  char time_code[trkTimeCodeSize] = "";
  trkCameraParams p{};
  trkCameraConstants c{};
};

TEST_F(File, passes_a_take) {
  std::ofstream(name) << "an older file";
  ASSERT_EQ(trkFileOpenWrite(name.c_str(), "10:20:30:12:2", &constants_in_c, &handle), trkOK);
  for (unsigned long i = 1; i <= 3; ++i) {
    const trkCameraParams sent = params_in_c(i);
    ASSERT_EQ(trkFileWriteParams(handle, &sent), trkOK);
  }
  EXPECT_EQ(trkFileReadParams(handle, &p), trkInvalidHandle) << "it is for writing";
  ASSERT_EQ(trkFileClose(handle), trkOK);
  ASSERT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkOK);
  EXPECT_STREQ(time_code, "10:20:30:12:2");
  EXPECT_EQ(text_of(c), text_of(constants_in_c));
  for (unsigned long i = 1; i <= 3; ++i) {
    ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
    const trkCameraParams expected = params_in_c(i);
    EXPECT_EQ(text_of(p), text_of(expected));
  }
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileWriteParams(handle, &p), trkInvalidHandle) << "it is for reading";
  EXPECT_EQ(trkFileClose(handle), trkOK);
  EXPECT_EQ(trkFileClose(handle), trkInvalidHandle);
}

constexpr const char* head = "DMC01\n10:20:30:12:2\n720 576 10 10 0 0 6.4 4.8 6.5 4.9\n";

TEST_F(File, unreadable_files_fail_and_other_files_are_of_an_invalid_version) {
  EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(directory.path().c_str(), time_code, &c, &handle), trkFailed);
  for (const char* text : {"", "DMC01\n", "DMC01\n10:20:30:12:2\n", "DMC01\n10:20:30:12:2\n720 576\n", "DMC02\n"}) {
    std::ofstream(name) << text;
    EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkInvalidVersion) << text;
  }
  EXPECT_EQ(handle, nullptr);
  EXPECT_STREQ(time_code, "");
}

TEST_F(File, a_truncated_take_gives_all_complete_lines) {
  std::ofstream(name) << head << "1 1 2 3 4 5 6 7 0 0 0 0 0 0 1\n1 1 2 3 4 5 6 7 0 0 0 0 0 0 2\n1 1 2 3 4 5 6";
  ASSERT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkOK);
  ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
  ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
  EXPECT_EQ(p.counter, 2U);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileClose(handle), trkOK);
}

TEST_F(File, only_the_malformed_line_is_lost) {
  std::ofstream(name) << head
                      << "1 1 2 3 4 5 6 7 0 0 0 0 0 0 1\nno record\n# a comment\n1 1 2 3 4 5 6 7 0 0 0 0 0 0 3\n";
  ASSERT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, &handle), trkOK);
  ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkInvalidVersion);
  EXPECT_EQ(p.counter, 1U) << "unchanged";
  ASSERT_EQ(trkFileReadParams(handle, &p), trkOK);
  EXPECT_EQ(p.counter, 3U);
  EXPECT_EQ(trkFileReadParams(handle, &p), trkUnavailable);
  EXPECT_EQ(trkFileClose(handle), trkOK);
}

TEST_F(File, misuse_gives_the_documents_codes) {
  EXPECT_EQ(trkFileOpenRead(nullptr, time_code, &c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(name.c_str(), nullptr, &c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, nullptr, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenRead(name.c_str(), time_code, &c, nullptr), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(nullptr, "10:20:30:12:2", &constants_in_c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(name.c_str(), nullptr, &constants_in_c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(name.c_str(), "ten past five", &constants_in_c, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(name.c_str(), "10:20:30:12:2", nullptr, &handle), trkFailed);
  EXPECT_EQ(trkFileOpenWrite(name.c_str(), "10:20:30:12:2", &constants_in_c, nullptr), trkFailed);
  EXPECT_EQ(trkFileOpenWrite("/nowhere/at/all.trk", "10:20:30:12:2", &constants_in_c, &handle), trkFailed);
  for (const trkHandle bad : no_handles) {
    EXPECT_EQ(trkFileReadParams(bad, &p), trkInvalidHandle);
    EXPECT_EQ(trkFileWriteParams(bad, &p), trkInvalidHandle);
    EXPECT_EQ(trkFileClose(bad), trkInvalidHandle);
  }
}

}  // namespace trk_bridge::c_api::file_test
