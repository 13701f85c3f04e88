// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Conditions of a display: it is added and removed, topics change, messages stop, are missing or invalid.
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <rviz/display_factory.h>
#include <rviz/load_resource.h>
#include <tf2_msgs/TFMessage.h>

#include "camera_display.h"
#include "published_camera.h"

namespace trk_bridge::test::conditions_test {

constexpr auto ok = rviz::StatusProperty::Ok;
constexpr auto warn = rviz::StatusProperty::Warn;
constexpr auto error = rviz::StatusProperty::Error;

class Conditions : public ::testing::Test {
 protected:
  void SetUp() override {
    window().load(TRK_BRIDGE_RVIZ_TEST_CONFIGURATION);
    window().look({{0, 1.5, 1}, 10, -1.2, 0.4});
  }
  void TearDown() override { window().remove_all(); }

  static std::string unique(const std::string& name) {
    static int made = 0;
    return name + std::to_string(++made);
  }
};

TEST_F(Conditions, TheDialogShowsOurIconAndADescription) {
  auto& factory = *window().manager().getDisplayFactory();
  const QString id = "trk_bridge/Camera";
  ASSERT_TRUE(factory.getDeclaredClassIds().contains(id));
  EXPECT_FALSE(factory.getClassDescription(id).isEmpty());
  const auto picture_of = [](const QIcon& icon) { return icon.pixmap(64, 64).toImage(); };
  const auto icon = picture_of(factory.getIcon(id));
  ASSERT_FALSE(icon.isNull());
  EXPECT_NE(icon, picture_of(rviz::loadPixmap("package://rviz/icons/default_class_icon.png"))) << "rviz's placeholder";
  EXPECT_TRUE(factory.getMessageTypes(id).contains("sensor_msgs/CameraInfo")) << "found by topic, too";
}

TEST_F(Conditions, AddedAtRunTimeItWaitsForItsTopicAndThenDraws) {
  const std::string name = unique("added");
  auto& display = add_frustum("Camera", "/" + name + "/camera_info", "/" + name + "/params");
  EXPECT_TRUE(window().shows_status(display, "Camera Info", warn, "no messages received"));
  EXPECT_TRUE(window().shows_status(display, "Camera Info", warn, "/" + name + "/camera_info"));
  const auto tracked = plain_camera(0, 15);
  const PublishedCamera camera(name, tracked);
  EXPECT_TRUE(becomes(tracked)) << statuses(display);
  for (const char* line : {"Camera Info", "Camera Params", "Constants", "Transform", "Lens", "Age"}) {
    EXPECT_TRUE(window().shows_status(display, line, ok)) << line;
  }
}

TEST_F(Conditions, AddedByTopicItFindsTheOtherTopicOfTheCamera) {
  const auto tracked = plain_camera(0, 15);
  const PublishedCamera camera(unique("by_topic"), tracked);
  const auto topics =
      std::pair(QString::fromStdString(camera.info_topic()), QString::fromStdString(camera.params_topic()));
  const auto topics_of = [](rviz::Display& display) {
    return std::pair(property(display, {"Camera Info Topic"}).getValue().toString(),
                     property(display, {"Camera Params Topic"}).getValue().toString());
  };
  auto& by_info = add_frustum("By info", "");
  by_info.setTopic(topics.first, "sensor_msgs/CameraInfo");
  EXPECT_EQ(topics_of(by_info), topics);
  EXPECT_TRUE(becomes(tracked)) << statuses(by_info);
  auto& by_params = add_frustum("By params", "");
  by_params.setTopic(topics.second, "trk_bridge/CameraParams");
  EXPECT_EQ(topics_of(by_params), topics);
  auto& alone = add_frustum("Alone", "");
  alone.setTopic("/nobody/camera_info", "sensor_msgs/CameraInfo");
  EXPECT_EQ(topics_of(alone), std::pair(QString("/nobody/camera_info"), QString())) << "no params are published there";
}

TEST_F(Conditions, TheCameraChangesWithTheTopic) {
  const auto left = plain_camera(-1.5, 10), right = plain_camera(1.5, -20);
  const PublishedCamera one(unique("left"), left), other(unique("right"), right);
  auto& display = add_frustum("Camera", one.info_topic());
  EXPECT_TRUE(becomes(left)) << statuses(display);
  property(display, {"Camera Info Topic"}).setValue(QString::fromStdString(other.info_topic()));
  EXPECT_TRUE(becomes(right)) << statuses(display);
  property(display, {"Camera Info Topic"}).setValue(QString::fromStdString("/nobody/camera_info"));
  EXPECT_TRUE(vanishes());
  EXPECT_TRUE(window().shows_status(display, "Camera Info", warn, "/nobody/camera_info"));
  property(display, {"Camera Info Topic"}).setValue("");
  EXPECT_TRUE(window().draws());
  property(display, {"Camera Info Topic"}).setValue(QString::fromStdString(one.info_topic()));
  EXPECT_TRUE(becomes(left)) << statuses(display);
}

TEST_F(Conditions, ACameraThatMovesIsFollowed) {
  auto tracked = plain_camera();
  PublishedCamera camera(unique("moving"), tracked);
  const auto& display = add_frustum("Camera", camera.info_topic(), camera.params_topic());
  for (const double pan : {0.0, 30.0, -30.0}) {
    tracked.params.euler.pan = pan;
    tracked.params.fov = 9 + pan / 10;
    camera.is(tracked);
    EXPECT_TRUE(becomes(tracked)) << "pan " << pan << statuses(display);
  }
}

TEST_F(Conditions, ACameraThatIsGoneIsNotDrawnAfterTheTimeout) {
  const auto tracked = plain_camera();
  PublishedCamera camera(unique("leaving"), tracked);
  auto& display = add_frustum("Camera", camera.info_topic(), camera.params_topic());
  property(display, {"Timeout"}).setValue(1);
  EXPECT_TRUE(becomes(tracked));
  EXPECT_TRUE(window().shows_status(display, "Age", ok));
  camera.publishes({false, false, false});
  EXPECT_TRUE(vanishes()) << statuses(display);
  EXPECT_TRUE(window().shows_status(display, "Camera Info", warn, "no messages on " + camera.info_topic()));
  EXPECT_TRUE(window().shows_status(display, "Age", warn, "older than"));
  EXPECT_TRUE(window().shows_status(display, "Camera Params", warn, "no messages on " + camera.params_topic()));
  camera.publishes({});
  EXPECT_TRUE(becomes(tracked)) << "it is shown again" << statuses(display);
  EXPECT_TRUE(window().shows_status(display, "Camera Info", ok));
  EXPECT_TRUE(window().shows_status(display, "Age", ok));
}

TEST_F(Conditions, WithoutATimeoutTheLastOfACameraStays) {
  const auto tracked = plain_camera();
  PublishedCamera camera(unique("staying"), tracked);
  auto& display = add_frustum("Camera", camera.info_topic());
  property(display, {"Timeout"}).setValue(1);
  EXPECT_TRUE(becomes(tracked));
  camera.publishes({false, false, false});
  EXPECT_TRUE(vanishes());
  property(display, {"Timeout"}).setValue(0);
  EXPECT_TRUE(becomes(tracked)) << statuses(display);
}

TEST_F(Conditions, WithoutATransformNothingIsDrawnAndTheReasonOfTfIsShown) {
  const auto tracked = plain_camera();
  PublishedCamera camera(unique("placeless"), tracked);
  camera.publishes({true, true, false});
  auto& display = add_frustum("Camera", camera.info_topic(), camera.params_topic());
  EXPECT_TRUE(window().shows_status(display, "Transform", error, camera.name() + "_optical"));
  EXPECT_TRUE(window().picture().pixels(magenta).empty());
  camera.publishes({});
  EXPECT_TRUE(becomes(tracked)) << statuses(display);
  EXPECT_TRUE(window().shows_status(display, "Transform", ok));
  camera.publishes({true, true, false});
  EXPECT_TRUE(vanishes()) << "its current place is unknown";
  EXPECT_TRUE(window().shows_status(display, "Transform", error));
}

TEST_F(Conditions, WithoutConstantsItReportsThat) {
  PublishedCamera camera(unique("unknown"), plain_camera());
  camera.publishes({false, true, true});
  const auto& display = add_frustum("Camera", camera.info_topic(), camera.params_topic());
  EXPECT_TRUE(window().shows_status(display, "Constants", warn, "unknown"));
  EXPECT_TRUE(window().shows_status(display, "Camera Params", ok));
  EXPECT_TRUE(window().picture().pixels(magenta).empty());
  camera.publishes({});
  EXPECT_TRUE(becomes(plain_camera())) << statuses(display);
  EXPECT_TRUE(window().shows_status(display, "Constants", ok));
}

TEST_F(Conditions, InvalidLensesAreReportedAndNotDrawn) {
  using Info = sensor_msgs::CameraInfo;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const auto tracked = plain_camera();
  PublishedCamera camera(unique("spoilt"), tracked);
  const auto& display = add_frustum("Camera", camera.info_topic());
  const std::vector<std::pair<const char*, PublishedCamera::Change>> spoilt{
      {"no K", [](Info& info) { info.K.assign(0.0); }},
      {"focal length 0", [](Info& info) { info.K[0] = 0; }},
      {"negative focal length", [](Info& info) { info.K[4] *= -1; }},
      {"focal length NaN", [=](Info& info) { info.K[0] = nan; }},
      {"infinite focal length", [=](Info& info) { info.K[0] = infinite; }},
      {"centre NaN", [=](Info& info) { info.K[2] = nan; }},
      {"infinite centre", [=](Info& info) { info.K[5] = -infinite; }},
      {"focal length of a millionth of a pixel", [](Info& info) { info.K[0] = info.K[4] = 1e-6; }},
      {"no width", [](Info& info) { info.width = 0; }},
      {"no height", [](Info& info) { info.height = 0; }},
      {"D NaN", [=](Info& info) { info.D[0] = nan; }},
      {"D infinite", [=](Info& info) { info.D[1] = infinite; }},
      {"three coefficients", [](Info& info) { info.D.resize(3); }},
      {"an image folded by its distortion", [](Info& info) { info.D[0] = -5; }},
      {"an unknown model", [](Info& info) { info.distortion_model = "fisheye"; }}};
  for (const auto& [what, change] : spoilt) {
    SCOPED_TRACE(what);
    camera.spoils(nullptr);
    ASSERT_TRUE(becomes(tracked)) << statuses(display);
    camera.spoils(change);
    EXPECT_TRUE(window().shows_status(display, "Lens", error));
    EXPECT_TRUE(vanishes());
  }
}

TEST_F(Conditions, EveryPartIsVisibleAndCanBeSwitchedOff) {
  PublishedCamera camera(unique("whole"), plain_camera());
  auto& display = window().add("trk_bridge/Camera", "Whole");
  property(display, {"Camera Info Topic"}).setValue(QString::fromStdString(camera.info_topic()));
  property(display, {"Camera Params Topic"}).setValue(QString::fromStdString(camera.params_topic()));
  property(display, {"Frustum", "Line Width"}).setValue(0.03);
  const QColor frustum_colour = colour_of(display, {"Frustum", "Color"});
  const auto drawn = [&] { return window().picture().pixels(frustum_colour).size() > 100; };
  ASSERT_TRUE(window().eventually(drawn)) << statuses(display);
  window().picture().write(results_directory() + "/everything_that_is_drawn.png");
  for (const char* part : {"Frustum", "Image Plane", "Focus Plane", "Optical Axis", "Body", "Camera Name", "Values"}) {
    const auto with = window().picture().image();
    property(display, {part}).setValue(false);
    EXPECT_TRUE(window().eventually([&] { return window().picture().image() != with; })) << part << " is not visible";
  }
  EXPECT_TRUE(window().eventually([] {
    const auto image = window().picture().image();
    QImage nothing(image.size(), image.format());
    nothing.fill(Qt::black);
    return image == nothing;
  })) << "something is drawn although all is switched off";
}

TEST_F(Conditions, ACameraAtRestIsVisibleFromEverySide) {
  const auto tracked = plain_camera();
  const PublishedCamera camera(unique("standing"), tracked);
  const auto& display = add_frustum("Camera", camera.info_topic());
  const std::vector<std::pair<double, double>> sides{{-1.2, 0.4}, {0.2, 0.1}, {1.9, 0.7}, {3.5, -0.3}, {-1.5, 1.3}};
  for (const auto& [yaw, pitch] : sides) {
    window().look({{0, 1, 1}, 10, yaw, pitch});
    EXPECT_TRUE(becomes(tracked)) << "yaw " << yaw << statuses(display);
  }
}

TEST_F(Conditions, ATrailShowsThePathAndFades) {
  auto tracked = plain_camera(-1);
  PublishedCamera camera(unique("trailing"), tracked);
  auto& display = add_frustum("Camera", camera.info_topic());
  const QColor green(0, 255, 0);
  property(display, {"Frustum"}).setValue(false);
  property(display, {"Trail"}).setValue(true);
  property(display, {"Trail", "Color"}).setValue(green);
  property(display, {"Trail", "Length"}).setValue(60);
  property(display, {"Trail", "Line Width"}).setValue(0.03);
  const auto place = [&tracked] { return Eigen::Vector3d(pose_of(tracked).translation()); };
  ASSERT_TRUE(window().shows_status(display, "Age", ok));
  ASSERT_TRUE(window().draws(3));
  Path way{place()};
  for (const auto& [x, z] : {std::pair(1.0, 1.2), std::pair(1.0, 2.0)}) {
    tracked.params.euler.x = x;
    tracked.params.euler.z = z;
    camera.is(tracked);
    way.push_back(place());
    EXPECT_TRUE(becomes({way}, green)) << statuses(display);
  }
  property(display, {"Trail", "Length"}).setValue(0.5);
  EXPECT_TRUE(vanishes(green)) << "it has stood here for longer than that";
}

TEST_F(Conditions, TheFixedFrameCanChange) {
  const auto tracked = plain_camera();
  const PublishedCamera camera(unique("framed"), tracked);
  const auto& display = add_frustum("Camera", camera.info_topic());
  EXPECT_TRUE(becomes(tracked));

  // The stage is beside the studio and turned by 90 degrees: studio = stage moved and turned.
  ::ros::NodeHandle ros;
  auto statics = ros.advertise<tf2_msgs::TFMessage>("/tf_static", 1, /*latch=*/true);
  const Eigen::Isometry3d studio_T_stage =
      Eigen::Translation3d(1, 0.5, -0.3) * Eigen::AngleAxisd(std::acos(-1.0) / 2, Eigen::Vector3d::UnitZ());
  geometry_msgs::TransformStamped stage;
  stage.header.frame_id = "studio";
  stage.header.stamp = ::ros::Time::now();
  stage.child_frame_id = "stage";
  stage.transform.translation.x = 1;
  stage.transform.translation.y = 0.5;
  stage.transform.translation.z = -0.3;
  stage.transform.rotation.z = stage.transform.rotation.w = std::sqrt(0.5);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(stage);
  statics.publish(message);

  window().manager().setFixedFrame("stage");
  window().look({{1.5, 0, 1}, 10, -1.2, 0.4});
  auto paths = frustum(tracked, near_depth, far_depth);
  for (auto& path : paths) {
    for (auto& point : path) point = studio_T_stage.inverse() * point;
  }
  EXPECT_TRUE(becomes(paths)) << statuses(display);

  window().manager().setFixedFrame("nowhere");
  EXPECT_TRUE(window().shows_status(display, "Transform", error, "nowhere"));
  EXPECT_TRUE(vanishes());

  window().manager().setFixedFrame("studio");
  window().look({{0, 1.5, 1}, 10, -1.2, 0.4});
  EXPECT_TRUE(becomes(tracked)) << statuses(display);
}

TEST_F(Conditions, DisablingHidesItAndEnablingShowsIt) {
  const auto tracked = plain_camera();
  const PublishedCamera camera(unique("switched"), tracked);
  auto& display = add_frustum("Camera", camera.info_topic(), camera.params_topic());
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(becomes(tracked)) << statuses(display);
    display.setEnabled(false);
    EXPECT_TRUE(vanishes());
    display.setEnabled(true);
  }
}

TEST_F(Conditions, DisplaysCanBeRemovedWhileMessagesArrive) {
  const auto tracked = plain_camera();
  const PublishedCamera camera(unique("busy"), tracked, /*rate=*/500);
  const auto& staying = add_frustum("Staying", camera.info_topic(), camera.params_topic());
  const QColor green(0, 255, 0);
  for (int i = 0; i < 8; ++i) {
    auto& leaving = add_frustum("Leaving", camera.info_topic(), camera.params_topic(), green);
    const auto lives = [&] { return !window().picture().pixels(green).empty(); };
    if (i % 2 == 0) {
      property(leaving, {"Frustum", "Near"}).setValue(0.3);
      property(leaving, {"Frustum", "Far"}).setValue(2);
      EXPECT_TRUE(window().eventually(lives));
    }
    window().remove(leaving);
    EXPECT_TRUE(vanishes(green));
  }
  EXPECT_TRUE(becomes(tracked)) << statuses(staying);
}

TEST_F(Conditions, SixteenCamerasAreAllDrawn) {
  std::vector<std::unique_ptr<PublishedCamera>> cameras;
  std::vector<std::pair<QColor, TrackedCamera>> drawn;
  window().look({{0, 0, 0}, 21, -1.57, 0.9});
  for (int i = 0; i < 16; ++i) {
    auto tracked = plain_camera(-6 + 4 * (i % 4), 5 * i - 40);
    tracked.params.euler.y = -5 + 3 * (i / 4);
    tracked.params.fov = 20;
    const QColor colour(255 - 60 * (i % 4), 40 + 50 * (i / 4), 255);
    cameras.push_back(std::make_unique<PublishedCamera>(unique("crowd"), tracked, /*rate=*/120));
    add_frustum("Camera " + std::to_string(i), cameras.back()->info_topic(), cameras.back()->params_topic(), colour);
    drawn.emplace_back(colour, tracked);
  }
  for (const auto& [colour, tracked] : drawn) {
    std::vector<Path> corners;
    for (const double x : {0, 1920}) {
      for (const double y : {0, 1080}) {
        const auto corner = seen_at(tracked, {x, y}, far_depth);
        corners.push_back({corner, corner});
      }
    }
    const auto seen = [&, &colour = colour] {
      const auto picture = window().picture();
      const auto points = seen_by(window().view(), corners);
      return std::all_of(points.begin(), points.end(),
                         [&](const Polyline& point) { return picture.has(colour, point[0], line_tolerance); });
    };
    EXPECT_TRUE(window().eventually(seen)) << colour.name().toStdString();
  }
  window().picture().write(results_directory() + "/sixteen_cameras.png");
}

}  // namespace trk_bridge::test::conditions_test
