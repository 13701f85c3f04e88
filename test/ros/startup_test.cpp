// How the node begins and ends: as a process and in a nodelet manager.
#include <csignal>

#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>

#include "fixture.h"
#include "free_slot.h"

namespace trk_bridge::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Startup : public NodeTest {};

TEST_F(Startup, WithoutASourceItEndsAndSaysWhatIsMissing) {
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~source = ''"), HasSubstr("must be given")));
}

TEST_F(Startup, AWrongEndpointIsNamed) {
  set("source", "udp://:7000?alow=127.0.0.1");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~source = 'udp://:7000?alow=127.0.0.1'"), HasSubstr("allow")));
}

TEST_F(Startup, AnUnknownParameterIsNamedWithTheNearestKnown) {
  set("source", udp_url(free_udp_port()));
  set("publish_camera_inf", false);
  EXPECT_THAT(refusal(), HasSubstr("~publish_camera_inf = 0: no such parameter, nearest is publish_camera_info"));
}

TEST_F(Startup, AWrongTypeIsNamedWithWhatIsAllowed) {
  set("source", udp_url(free_udp_port()));
  set("field_rate", "fast");
  EXPECT_THAT(refusal(), HasSubstr("~field_rate = 'fast': must be a number"));
}

TEST_F(Startup, AWrongValueIsNamedWithWhatIsAllowed) {
  set("source", udp_url(free_udp_port()));
  set("delay", -1);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("~delay = -1"), HasSubstr("0 to 60 seconds")));
}

TEST_F(Startup, APortInUseIsToldWithItsNumber) {
  const auto port = free_udp_port();
  set("source", udp_url(port));
  ASSERT_TRUE(starts());
  Program second({TRK_TO_ROS, "__ns:=" + name_space, "__name:=second", "_source:=" + udp_url(port)});
  EXPECT_THAT(second.rest_of_err(), HasSubstr(std::to_string(port)));
  EXPECT_EQ(second.wait(), 1);
}

TEST_F(Startup, AnUnknownArgumentIsRefused) {
  Program program({TRK_TO_ROS, "--source=udp://:7000", "__ns:=" + name_space});
  EXPECT_THAT(program.rest_of_err(), HasSubstr("--source=udp://:7000"));
  EXPECT_EQ(program.wait(), 2);
}

TEST_F(Startup, SigintEndsItPromptlyWhileItWaitsForRecords) {
  set("source", udp_url(free_udp_port()));
  ASSERT_TRUE(starts());
  EXPECT_LT(interrupted(), std::chrono::seconds(3));
}

TEST_F(Startup, SigintEndsItPromptlyWhileItWaitsForASlot) {
  const FreeSlot slot;
  set("source", "shm:" + std::to_string(slot.number()));
  ASSERT_TRUE(starts());
  EXPECT_LT(interrupted(), std::chrono::seconds(3));
}

class InManager : public NodeTest {
 protected:
  bool load() {
    nodelet::NodeletLoad request;
    request.request.name = node_name;
    request.request.type = "trk_bridge/TrkToRos";
    EXPECT_TRUE(::ros::service::waitForService("/manager/load_nodelet", ::ros::Duration(20)));
    return ::ros::service::call("/manager/load_nodelet", request) && request.response.success;
  }
  bool unload() {
    nodelet::NodeletUnload request;
    request.request.name = node_name;
    return ::ros::service::call("/manager/unload_nodelet", request) && request.response.success;
  }
};

TEST_F(InManager, PublishesUntilItIsUnloadedAndCanBeLoadedAgain) {
  const auto port = free_udp_port();
  set("source", udp_url(port));
  for (std::uint64_t round = 1; round <= 2; ++round) {
    TransformRecorder transforms("/tf", camera);
    ASSERT_TRUE(load());
    ASSERT_TRUE(eventually([&] { return transforms.connected_to("/manager"); }));
    Tracker tracker(port);
    tracker.send(test::params(round));
    EXPECT_TRUE(eventually([&] { return transforms.transforms.size() == 1; }));
    EXPECT_TRUE(diagnostics.becomes(status_name(), "received", "1"));
    ASSERT_TRUE(unload()) << "which joins its reader and frees the port";
  }
}

TEST_F(InManager, LoadingFailsWhenItCannotStart) {
  set("sorce", udp_url(free_udp_port()));
  EXPECT_FALSE(load());
}

}  // namespace
}  // namespace trk_bridge::test
