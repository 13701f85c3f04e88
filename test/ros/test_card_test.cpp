// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The complete path from a tracker to pictures of the test card: their content is compared with CameraInfo and tf, as
// used by nodes that process images.
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <image_geometry/pinhole_camera_model.h>
#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/spinner.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Float64.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <trk_bridge/CameraParams.h>
#include <visualization_msgs/MarkerArray.h>
#include <class_loader/class_loader.hpp>

#include "demo/test_card.h"
#include "demo/test_card_parameters.h"
#include "error_of.h"
#include "fixture.h"
#include "picture_measure.h"
#include "repeating.h"
#include "ros/parameter_reader.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::test::test_card_test {

constexpr double point_limit = 0.05;    // pixels between a point in the image and its place by CameraInfo and tf
constexpr double straight_limit = 0.1;  // pixels between a rectified line and a straight one
constexpr std::chrono::milliseconds field{20};

cv::Mat picture_of(const sensor_msgs::Image& image) {
  return cv::Mat(static_cast<int>(image.height), static_cast<int>(image.width), CV_8UC1,
                 const_cast<std::uint8_t*>(image.data.data()), image.step)
      .clone();
}

template <typename Message>
const Message* with_stamp(const std::vector<Message>& messages, const ::ros::Time& stamp) {
  const auto found = std::find_if(messages.begin(), messages.end(),
                                  [&](const Message& message) { return message.header.stamp == stamp; });
  return found == messages.end() ? nullptr : &*found;
}

Eigen::Vector3d place_of(const geometry_msgs::Point& point) { return {point.x, point.y, point.z}; }

/// Image, CameraInfo and tf of one time, and their differences.
class Moment {
 public:
  Moment(const sensor_msgs::CameraInfo& info, const Eigen::Isometry3d& optical_T_studio)
      : optical_T_studio_(optical_T_studio) {
    model_.fromCameraInfo(info);
  }

  /// In the rectified image; none behind the camera.
  std::optional<Eigen::Vector2d> pinhole(const Eigen::Vector3d& studio) const {
    const Eigen::Vector3d p = optical_T_studio_ * studio;
    if (p.z() < nearest) return std::nullopt;
    const cv::Point2d pixel = model_.project3dToPixel({p.x(), p.y(), p.z()});
    return Eigen::Vector2d(pixel.x, pixel.y);
  }

  Eigen::Vector2d unrectified(const Eigen::Vector2d& pixel) const {
    const cv::Point2d raw = model_.unrectifyPoint({pixel.x(), pixel.y()});
    return {raw.x, raw.y};
  }

  /// Ends of a line in the rectified image; none if no part of it is in front of the camera.
  std::vector<Eigen::Vector2d> pinhole_line(Eigen::Vector3d from, Eigen::Vector3d to) const {
    const auto depth = [this](const Eigen::Vector3d& p) { return (optical_T_studio_ * p).z(); };
    if (depth(from) > depth(to)) std::swap(from, to);
    constexpr double begin = 2 * nearest;
    if (depth(to) <= begin) return {};
    if (depth(from) < begin) from += (begin - depth(from)) / (depth(to) - depth(from)) * (to - from);
    return {*pinhole(from), *pinhole(to)};
  }

 private:
  static constexpr double nearest = 0.1;  // m
  Eigen::Isometry3d optical_T_studio_;
  image_geometry::PinholeCameraModel model_;
};

/// How far apart they are, pixels.
struct Agreement {
  int compared = 0;
  double worst = 0;
  double without_distortion = 0;  ///< the worst, had CameraInfo no D
  std::string worst_line;
};

/// The lens of crane_shot's camera: `wide` from 0 to 1, from barrel to pincushion distortion.
wire::CameraParams at(double pan, double tilt, double roll, double wide) {
  wire::CameraParams params;
  params.format = wire::euler;
  params.euler = {1, -1, 2.2, pan, tilt, roll};
  params.fov = 8 + 16 * (1 - wide);
  params.center_x = 0.15 * wide - 0.05;
  params.center_y = 0.1;
  params.k1 = 3e-3 * wide - 8e-4;
  params.k2 = 4e-6 * wide;
  params.focdist = 10;
  return params;
}

class TestCard : public TrkToRosTest {
 protected:
  void SetUp() override {
    set("source", any_udp_port);
    ASSERT_TRUE(starts());
    tracker_.emplace(port());
  }

  template <typename T>
  void set_card(const std::string& key, const T& value) {
    ::ros::param::set(card_name() + "/" + key, value);
  }

  void start_card() {
    make_card();
    images_.emplace(name_space + "/image_raw");
    rectified_.emplace(name_space + "/image_rect");
    infos_.emplace(name_space + "/camera_info");
    params_.emplace(name_space + "/params");
    markers_.emplace(name_space + "/test_card");
    ASSERT_TRUE(eventually([this] { return !markers_->messages.empty(); }));
  }

  /// Pictures are drawn in a separate thread, as in a separate process.
  void make_card() {
    ::ros::NodeHandle topics(name_space);
    topics.setCallbackQueue(&card_callbacks_);
    card_.emplace(topics, ::ros::NodeHandle(card_name()), card_name());
    card_spinner_.start();
  }
  std::string card_name() const { return name_space + "/test_card"; }

  const visualization_msgs::Marker& marker(const std::string& of) const {
    const auto& all = markers_->messages.back().markers;
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& marker) { return marker.ns == of; });
    if (found == all.end()) throw std::runtime_error("no marker " + of);
    return *found;
  }

  wire::CameraConstants constants() const {
    wire::CameraConstants constants;
    constants.image_width = 1280;
    constants.image_height = 720;
    constants.blank_left = 40;
    constants.blank_bottom = 16;
    constants.chip_width = 9.3;
    constants.chip_height = 5.28;
    return constants;
  }

  /// Sends the values of `motion` at the field rate, until the condition is met.
  ::testing::AssertionResult send_until(const std::function<wire::CameraParams(int)>& motion,
                                        const std::function<bool()>& condition) {
    auto next = std::chrono::steady_clock::now();
    int fields = 0;
    const bool met = eventually([&] {
      if (std::chrono::steady_clock::now() >= next) {
        if (fields % 25 == 0) tracker_->send(constants());
        auto record = motion(fields++);
        record.counter = ++counter_;
        tracker_->send(record);
        next += field;
      }
      return condition();
    });
    if (met) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << images_->messages.size() << " images, " << rectified_->messages.size()
                                         << " rectified, of " << fields << " fields";
  }

  /// None if tf or CameraInfo have no data of the image's time.
  std::optional<Moment> moment_of(const sensor_msgs::Image& image) {
    const ::ros::Time& stamp = image.header.stamp;
    const std::string& optical = image.header.frame_id;
    const auto known = [&] {
      return with_stamp(infos_->messages, stamp) != nullptr && transforms_.canTransform(optical, "studio", stamp);
    };
    if (!eventually(known)) return std::nullopt;
    return Moment(*with_stamp(infos_->messages, stamp),
                  ros1::to_isometry(transforms_.lookupTransform(optical, "studio", stamp).transform));
  }

  /// Compares every disc in the image with the nearest point by CameraInfo and tf.
  Agreement agreement_of_points(const sensor_msgs::Image& image, const Moment& moment) const {
    std::vector<Eigen::Vector2d> pinhole, expected;
    for (const auto& point : marker("points").points) {
      const auto pixel = moment.pinhole(place_of(point));
      // Far outside the image D is not defined.
      if (!pixel || pixel->x() < -200 || pixel->y() < -200 || pixel->x() > image.width + 200.0 ||
          pixel->y() > image.height + 200.0) {
        continue;
      }
      pinhole.push_back(*pixel);
      expected.push_back(moment.unrectified(*pixel));
    }
    Agreement agreement;
    if (expected.empty()) return agreement;
    for (const auto& found : disc_centers(picture_of(image))) {
      const auto nearest = std::min_element(expected.begin(), expected.end(), [&](const auto& a, const auto& b) {
        return (a - found).norm() < (b - found).norm();
      });
      const auto& straight = pinhole[static_cast<std::size_t>(nearest - expected.begin())];
      agreement.worst = std::max(agreement.worst, (*nearest - found).norm());
      agreement.without_distortion = std::max(agreement.without_distortion, (straight - found).norm());
      ++agreement.compared;
    }
    return agreement;
  }

  /// Compares lines in the rectified image, and in the raw image, with straight ones.
  Agreement agreement_of_lines(const sensor_msgs::Image& raw, const sensor_msgs::Image& rectified,
                               const Moment& moment) const {
    const cv::Mat raw_picture = picture_of(raw), picture = picture_of(rectified);
    Agreement agreement;
    for (const char* grid : {"floor", "wall"}) {
      const auto& ends = marker(grid).points;
      for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        const auto line = moment.pinhole_line(place_of(ends[i]), place_of(ends[i + 1]));
        const auto found = line_centers(picture, line);
        if (found.size() < 20) continue;
        if (const double deviation = deviation_from_straight(found); deviation > agreement.worst) {
          agreement.worst = deviation;
          std::ostringstream name;
          name << grid << " line " << i / 2 << ", " << found.size() << " middles from " << found.front().transpose()
               << " to " << found.back().transpose();
          agreement.worst_line = name.str();
        }
        std::vector<Eigen::Vector2d> bent;
        for (const auto& center : found) bent.push_back(moment.unrectified(center));
        const auto raw_found = line_centers(raw_picture, bent);
        if (raw_found.size() > 10) {
          agreement.without_distortion = std::max(agreement.without_distortion, deviation_from_straight(raw_found));
        }
        ++agreement.compared;
      }
    }
    return agreement;
  }

  std::optional<Tracker> tracker_;
  ::ros::CallbackQueue card_callbacks_;
  std::optional<demo::TestCard> card_;
  ::ros::AsyncSpinner card_spinner_{1, &card_callbacks_};  // ends before the node
  std::optional<Recorder<sensor_msgs::Image>> images_, rectified_;
  std::optional<Recorder<sensor_msgs::CameraInfo>> infos_;
  std::optional<Recorder<trk_bridge::CameraParams>> params_;
  std::optional<Recorder<visualization_msgs::MarkerArray>> markers_;
  tf2_ros::Buffer transforms_{::ros::Duration(60)};
  tf2_ros::TransformListener listener_{transforms_};
  std::uint64_t counter_ = 0;
};

void expect_points(const Agreement& points) {
  EXPECT_GE(points.compared, 8);
  EXPECT_LT(points.worst, point_limit) << "pixels";
  EXPECT_GT(points.without_distortion, 20 * point_limit) << "pixels: otherwise D was not tested";
}

void expect_lines(const Agreement& lines) {
  EXPECT_GE(lines.compared, 8);
  EXPECT_LT(lines.worst, straight_limit) << "pixels: " << lines.worst_line;
  EXPECT_GT(lines.without_distortion, 10 * straight_limit) << "pixels: otherwise rectifying was not tested";
}

TEST_F(TestCard, MatchesCameraInfoAndTfWhileTheCameraMoves) {
  set_card("rate", 12.5);
  ASSERT_NO_FATAL_FAILURE(start_card());
  // Pan, roll and zoom at once: data of different times would not agree.
  ASSERT_TRUE(send_until(
      [](int i) { return at(10 * std::sin(i * 0.05), -6, 8 * std::sin(i * 0.03), 0.5 + 0.5 * std::cos(i * 0.04)); },
      [this] { return images_->messages.size() >= 12 && rectified_->messages.size() >= 8; }));
  double worst_point = 0, worst_line = 0;
  for (const auto& image : std::vector(images_->messages)) {
    EXPECT_EQ(image.header.frame_id, camera + "_optical");
    EXPECT_EQ(image.encoding, "mono8");
    EXPECT_NE(with_stamp(params_->messages, image.header.stamp), nullptr) << "has the stamp of its params";
    const auto moment = moment_of(image);
    ASSERT_TRUE(moment);
    const Agreement points = agreement_of_points(image, *moment);
    EXPECT_GE(points.compared, 8);
    worst_point = std::max(worst_point, points.worst);
    const auto* rectified = with_stamp(rectified_->messages, image.header.stamp);
    if (rectified == nullptr) continue;
    EXPECT_EQ(rectified->header.frame_id, image.header.frame_id);
    const Agreement lines = agreement_of_lines(image, *rectified, *moment);
    EXPECT_LT(lines.worst, straight_limit) << "pixels: " << lines.worst_line;
    worst_line = std::max(worst_line, lines.worst);
  }
  EXPECT_LT(worst_point, point_limit) << "pixels";
  EXPECT_GT(worst_line, 0);
  RecordProperty("worst_point_pixels", std::to_string(worst_point));
  RecordProperty("worst_line_pixels", std::to_string(worst_line));
}

/// Pan, tilt, roll and how wide.
class TestCardAtRest : public TestCard, public ::testing::WithParamInterface<std::array<double, 4>> {};

TEST_P(TestCardAtRest, AgreesAndImageProcMakesStraightLines) {
  class_loader::ClassLoader library(IMAGE_PROC_LIBRARY);
  const auto rectify = library.createInstance<nodelet::Nodelet>("image_proc::RectifyNodelet");
  const std::string name = name_space + "/image_proc_rectify";
  // Enough CameraInfos to find that of an image that arrives late.
  ::ros::param::set(name + "/queue_size", 100);
  rectify->init(name,
                {{name_space + "/image_mono", name_space + "/image_raw"},
                 {name_space + "/image_rect", name_space + "/image_proc_rect"}},
                {});
  Recorder<sensor_msgs::Image> by_image_proc(name_space + "/image_proc_rect");
  ASSERT_NO_FATAL_FAILURE(start_card());

  const auto [pan, tilt, roll, wide] = GetParam();
  const auto params = at(pan, tilt, roll, wide);
  // The image that all have received.
  std::optional<sensor_msgs::Image> image;
  ASSERT_TRUE(send_until([&](int) { return params; },
                         [&] {
                           for (const auto& raw : images_->messages) {
                             const ::ros::Time& stamp = raw.header.stamp;
                             if (with_stamp(rectified_->messages, stamp) && with_stamp(by_image_proc.messages, stamp)) {
                               image = raw;
                             }
                           }
                           return image.has_value();
                         }))
      << "; image_proc: " << by_image_proc.messages.size();
  const auto moment = moment_of(*image);
  ASSERT_TRUE(moment);
  const Agreement points = agreement_of_points(*image, *moment);
  expect_points(points);
  RecordProperty("worst_point_pixels", std::to_string(points.worst));
  for (const auto* rectified : {&*rectified_, &by_image_proc}) {
    SCOPED_TRACE(rectified == &by_image_proc ? "image_proc" : "image_rect");
    const Agreement lines = agreement_of_lines(*image, *with_stamp(rectified->messages, image->header.stamp), *moment);
    expect_lines(lines);
    RecordProperty(rectified == &by_image_proc ? "worst_line_of_image_proc_pixels" : "worst_line_pixels",
                   std::to_string(lines.worst));
  }
}

INSTANTIATE_TEST_SUITE_P(Sights, TestCardAtRest,
                         ::testing::Values(std::array{0.0, -4.0, 0.0, 1.0}, std::array{14.0, -9.0, 11.0, 0.8},
                                           std::array{-5.0, -2.0, -20.0, 0.0}));

TEST_F(TestCard, PairsEveryRectifiedImageWithItsCameraInfo) {
  Recorder<sensor_msgs::Image> images(name_space + "/rectified/image");
  Recorder<sensor_msgs::CameraInfo> infos(name_space + "/rectified/camera_info");
  ASSERT_NO_FATAL_FAILURE(start_card());
  // The order between topics is undefined.
  constexpr std::size_t count = 5;
  const auto has_enough = [&](const auto& recorder) {
    return std::all_of(images.messages.begin(), images.messages.begin() + count, [&](const sensor_msgs::Image& image) {
      return with_stamp(recorder.messages, image.header.stamp) != nullptr;
    });
  };
  ASSERT_TRUE(send_until([](int i) { return at(0, -5, 0, 0.5 + 0.5 * std::cos(i * 0.04)); },
                         [&] { return images.messages.size() >= count && has_enough(infos) && has_enough(*infos_); }));
  for (std::size_t i = 0; i < count; ++i) {
    const auto& stamp = images.messages[i].header.stamp;
    const auto& info = *with_stamp(infos.messages, stamp);
    EXPECT_THAT(info.D, ::testing::Each(0.0));
    EXPECT_EQ(info.P, with_stamp(infos_->messages, stamp)->P);
    if (const auto* rectified = with_stamp(rectified_->messages, stamp); rectified != nullptr) {
      EXPECT_EQ(images.messages[i].data, rectified->data);
    }
  }
}

TEST_F(TestCard, PublishesItsMarkersForLateSubscribers) {
  ASSERT_NO_FATAL_FAILURE(start_card());
  EXPECT_EQ(marker("points").header.frame_id, "studio");
  EXPECT_EQ(marker("points").header.stamp, ::ros::Time()) << "valid at any time";
  EXPECT_EQ(marker("points").type, visualization_msgs::Marker::SPHERE_LIST);
  EXPECT_EQ(marker("wall").type, visualization_msgs::Marker::LINE_LIST);
  EXPECT_FALSE(marker("labels").text.empty());
  for (const auto& point : marker("floor").points) EXPECT_EQ(point.z, 0);
}

TEST_F(TestCard, KeepsItsRateAndDrawsTheNewestParams) {
  set_card("rate", 5);
  ASSERT_NO_FATAL_FAILURE(start_card());
  const auto params = at(0, -5, 0, 1);
  const auto begin = std::chrono::steady_clock::now();
  // Five periods, each longer by at most one field until the next params arrive; this does not accumulate. A busy
  // machine may delay some of them, but not all.
  EXPECT_TRUE(send_until([&](int) { return params; },
                         [this] {
                           const auto count = images_->messages.size();
                           if (count < 8) return false;
                           const auto& first = images_->messages[count - 6].header.stamp;
                           const double took = (images_->messages[count - 1].header.stamp - first).toSec();
                           return took > 0.9 && took < 1.5;
                         }));
  const std::chrono::duration<double> ran = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(static_cast<double>(images_->messages.size()), 5 * ran.count() + 2)
      << "never more, except for the first one";
}

TEST_F(TestCard, ReportsWhenTheMachineIsTooSlow) {
  const LogRecorder log;
  // No machine draws and rectifies a picture of this size within 4 ms.
  set_card("rate", 240);
  ASSERT_NO_FATAL_FAILURE(start_card());
  EXPECT_TRUE(send_until([](int) { return at(0, -5, 0, 1); },
                         [&] { return log.has("this machine is too slow: a picture takes"); }))
      << "it does not report that";
}

TEST_F(TestCard, ReportsThatThereIsNoPictureWithoutConstants) {
  const LogRecorder log;
  ASSERT_NO_FATAL_FAILURE(start_card());
  const Repeating sending(50, [this] {
    auto record = at(0, 0, 0, 1);
    record.counter = ++counter_;
    tracker_->send(record);
  });
  EXPECT_TRUE(eventually([&] { return log.has("no picture: no constants yet"); })) << "it does not report that";
  EXPECT_TRUE(eventually([this] { return params_->messages.size() > 5; }));
  EXPECT_TRUE(images_->messages.empty());
}

TEST_F(TestCard, ReportsWhatIsWrongWithThePicture) {
  const LogRecorder log;
  ASSERT_NO_FATAL_FAILURE(start_card());
  const auto send = [this](double fov, std::int32_t width) {
    auto with = constants();
    with.image_width = with.image_height = width;
    tracker_->send(with);
    auto record = at(0, 0, 0, 1);
    record.fov = fov;
    record.counter = ++counter_;
    tracker_->send(record);
  };
  {
    const Repeating sending(50, [&] { send(0, 720); });
    EXPECT_TRUE(eventually([&] {
      return log.has("no picture: " + camera::describe(camera::CameraReason::bad_field_of_view));
    })) << "it does not report that";
  }
  {
    const Repeating sending(50, [&] { send(60, 16384); });
    EXPECT_TRUE(eventually([&] { return log.has("no picture: 16384 x 16384 pixels are more than 67108864"); }))
        << "it does not report that";
  }
  EXPECT_TRUE(images_->messages.empty());
}

TEST_F(TestCard, ARandomDelayIsPublished) {
  set_card("random_video_delay", true);
  const Recorder<std_msgs::Float64> delay(name_space + "/video_delay");
  ASSERT_NO_FATAL_FAILURE(start_card());
  ASSERT_TRUE(eventually([&] { return !delay.messages.empty(); }));
  EXPECT_GT(delay.messages[0].data, 0);
  EXPECT_LT(delay.messages[0].data, demo::most_random_video_delay);
}

TEST_F(TestCard, RefusesUnknownParameters) {
  set_card("spacign", 2);
  EXPECT_THAT(error_of<ros1::ParameterError>([this] { make_card(); }),
              ::testing::AllOf(::testing::HasSubstr("spacign"), ::testing::HasSubstr("spacing")));
}

}  // namespace trk_bridge::test::test_card_test
