#include <gmock/gmock.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ::testing::InitGoogleMock(&argc, argv);
  ::ros::init(argc, argv, "trk_to_ros_rostest");
  const ::ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
