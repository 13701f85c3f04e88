// How trk_to_ros begins and ends: as a process, and with parameters that it refuses.
#include "free_slot.h"
#include "node_process.h"

namespace trk_bridge::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Startup : public NodeProcessTest {
 protected:
  Startup() : NodeProcessTest(TRK_TO_ROS) {}
};

TEST_F(Startup, WithoutASourceItEndsAndSaysWhatIsMissing) {
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
  EXPECT_THAT(refusal(), HasSubstr("~publish_camera_inf = 0: no such parameter, nearest is publish_camera_info"));
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

TEST_F(Startup, APortInUseIsToldWithItsNumber) {
  const PlainSocket taken;
  const std::string port = std::to_string(taken.port());
  set("source", "udp://127.0.0.1:" + port);
  EXPECT_THAT(refusal(), HasSubstr(port));
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

}  // namespace
}  // namespace trk_bridge::test
