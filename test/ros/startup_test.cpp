// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// How trk_to_ros starts and ends: as a process, and with parameters that it refuses.
#include "free_slot.h"
#include "node_process.h"

namespace trk_bridge::test::startup_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Startup : public NodeProcessTest {
 protected:
  Startup() : NodeProcessTest(TRK_TO_ROS) {}
};

TEST_F(Startup, WithoutASourceItEndsAndNamesWhatIsMissing) {
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~source = ''"), HasSubstr("must be given")));
}

class Refused : public TrkToRosTest {};

TEST_F(Refused, AWrongEndpointIsNamed) {
  set("source", "udp://:7000?alow=127.0.0.1");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~source = 'udp://:7000?alow=127.0.0.1'"), HasSubstr("allow")));
}

TEST_F(Refused, AnUnknownParameterIsNamedWithTheNearestKnown) {
  set("source", any_udp_port);
  set("publish_camera_inf", false);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~publish_camera_inf = 0: unknown parameter, nearest is publish_camera_info"),
                               HasSubstr("\n  rosparam delete " + node_name + "/publish_camera_inf")));
}

TEST_F(Refused, AWrongTypeIsNamedWithWhatIsAllowed) {
  set("source", any_udp_port);
  set("field_rate", "fast");
  EXPECT_THAT(refusal(), HasSubstr("~field_rate = 'fast': must be a number"));
}

TEST_F(Refused, AWrongValueIsNamedWithWhatIsAllowed) {
  set("source", any_udp_port);
  set("delay", -1);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~delay = -1"), HasSubstr("0 to 60 seconds")));
}

TEST_F(Startup, APortInUseIsReportedWithItsNumber) {
  const PlainSocket taken;
  const std::string port = std::to_string(taken.port());
  set("source", "udp://127.0.0.1:" + port);
  EXPECT_THAT(refusal(), HasSubstr(port));
}

TEST_F(Startup, TheRemedyForAMistypedParameterMakesTheNextStartWork) {
  set("source", any_udp_port);
  Program({TRK_TO_ROS, "__ns:=" + name_space, "_formt:=euler"}).rest_of_err();
  const std::string output = refusal();
  const std::string command = "rosparam delete ";
  const auto begin = output.find(command);
  ASSERT_NE(begin, std::string::npos) << output;
  const auto name = output.substr(begin + command.size());
  Program deleting({"/usr/bin/env", "rosparam", "delete", name.substr(0, name.find_first_of("\n\x1b"))});
  EXPECT_EQ(deleting.rest_of_err(), "");
  EXPECT_EQ(deleting.wait(), 0);
  EXPECT_TRUE(starts());
}

TEST_F(Startup, AnIdOf32BitsCanBeGivenAsText) {
  set("source", any_udp_port);
  set("id", "4294967295");
  EXPECT_TRUE(starts());
}

TEST_F(Startup, AnIdOf32BitsCanBeGivenToRosrun) {
  set("source", any_udp_port);
  const Program given({TRK_TO_ROS, "__ns:=" + name_space, "_id:=4294967295", "/diagnostics:=" + diagnostics.topic()});
  EXPECT_TRUE(reports_on(camera));
}

TEST_F(Startup, AnUnknownArgumentIsRefused) {
  Program program({TRK_TO_ROS, "--source=udp://:7000", "__ns:=" + name_space});
  EXPECT_THAT(program.rest_of_err(), HasSubstr("--source=udp://:7000"));
  EXPECT_EQ(program.wait(), 2);
}

TEST_F(Startup, SigintEndsItPromptlyWhileItWaitsForRecords) {
  set("source", any_udp_port);
  ASSERT_TRUE(starts());
  EXPECT_LT(interrupted(), std::chrono::seconds(3));
}

TEST_F(Startup, SigintEndsItPromptlyWhileItWaitsForASlot) {
  const FreeSlot slot;
  set("source", "shm:" + std::to_string(slot.number()));
  ASSERT_TRUE(starts());
  EXPECT_LT(interrupted(), std::chrono::seconds(3));
}

}  // namespace trk_bridge::test::startup_test
