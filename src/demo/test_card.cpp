// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "test_card.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <random>

#include <ros/console.h>
#include <sensor_msgs/image_encodings.h>
#include <std_msgs/Float64.h>
#include <visualization_msgs/MarkerArray.h>
#include <opencv2/imgproc.hpp>

#include "mains.h"
#include "nodes/node.h"
#include "test_card_markers.h"
#include "test_card_parameters.h"
#include "test_card_picture.h"
#include "test_card_view.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::demo {
namespace {

/// Limits the memory; no screen has more pixels.
constexpr std::int64_t most_pixels = 64 << 20;

/// The weight of the newest picture in the average cost.
constexpr double newest_cost = 0.1;
/// Share of the period below which the machine counts as fast enough again.
constexpr double enough_room = 0.8;

/// CameraInfos that are kept for rectification: more than arrive while a picture is rendered.
constexpr std::size_t kept_infos = 100;

/// The data of a message as a picture of OpenCV, resized.
cv::Mat picture_of(sensor_msgs::Image& image, int width, int height) {
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.step = image.width;
  image.encoding = sensor_msgs::image_encodings::MONO8;
  image.data.resize(std::size_t{image.step} * image.height);
  return cv::Mat(height, width, CV_8UC1, image.data.data());
}

double random_video_delay() {
  std::random_device random;
  return std::uniform_real_distribution<double>(0, most_random_video_delay)(random);
}

}  // namespace

TestCard::TestCard(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string& name)
    : diagnostics_(node, private_node, name) {
  const auto parameters = nodes::read_parameters(private_node, [&](const auto& tree) {
    return read_test_card_parameters(tree, nodes::camera_name_of(node.getNamespace()));
  });
  figure_ = figure_at(parameters.place);
  period_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / parameters.rate));
  image_.header.frame_id = parameters.optical_frame;

  image_transport::ImageTransport transport(node);
  images_ = transport.advertise("image_raw", 1);
  rectified_images_ = transport.advertise("image_rect", 1);
  paired_images_ = transport.advertise("rectified/image", 1);
  paired_infos_ = node.advertise<sensor_msgs::CameraInfo>("rectified/camera_info", 1);
  markers_ = node.advertise<visualization_msgs::MarkerArray>("test_card", 1, /*latch=*/true);
  markers_.publish(markers_of(figure_, parameters.studio_frame));
  std_msgs::Float64 delay;
  delay.data = parameters.random_video_delay ? random_video_delay() : parameters.video_delay;
  video_delay_.fromSec(delay.data);
  delay_publisher_ = node.advertise<std_msgs::Float64>("video_delay", 1, /*latch=*/true);
  delay_publisher_.publish(delay);

  constants_subscriber_ = node.subscribe<trk_bridge::CameraConstants>(
      "constants", 1,
      [this](const trk_bridge::CameraConstantsConstPtr& message) { constants_ = ros1::from_msg(*message); });
  // Queue size 1: while a picture is rendered, newer params replace those in the queue.
  params_subscriber_ = node.subscribe<trk_bridge::CameraParams>(
      "params", 1, [this](const trk_bridge::CameraParamsConstPtr& message) { receive(message); });
  info_subscriber_ = node.subscribe<sensor_msgs::CameraInfo>(
      "camera_info", static_cast<std::uint32_t>(kept_infos),
      [this](const sensor_msgs::CameraInfoConstPtr& message) { receive(message); });
  diagnostics_.start();
}

void TestCard::receive(const trk_bridge::CameraParamsConstPtr& message) {
  const bool raw = images_.getNumSubscribers() > 0, rectified = rectified_wanted();
  if (!raw && !rectified) return;
  const auto now = Clock::now();
  if (now < due_) return;
  note_cost();
  // Counted from the due time, so that the average rate is right for any rate of params. Missed pictures are skipped.
  due_ = std::max(due_ + period_, now);
  to_be_rectified_ = false;
  if (!render(*message)) return;
  if (raw) images_.publish(image_);
  to_be_rectified_ = rectified;
  rectify_if_possible();
  spent_ += Clock::now() - now;
}

void TestCard::receive(const sensor_msgs::CameraInfoConstPtr& message) {
  if (infos_.size() == kept_infos) infos_.pop_front();
  infos_.push_back(message);
  const auto begin = Clock::now();
  rectify_if_possible();
  spent_ += Clock::now() - begin;
}

bool TestCard::render(const trk_bridge::CameraParams& params) {
  if (!constants_) {
    picture_problem_.report("no picture: no constants yet");
    return false;
  }
  const auto view = View::of(ros1::from_msg(params), *constants_);
  if (!view) {
    picture_problem_.report("no picture: " + camera::describe(view.error()));
    return false;
  }
  if (std::int64_t{view->width()} * view->height() > most_pixels) {
    picture_problem_.report("no picture: " + std::to_string(view->width()) + " x " + std::to_string(view->height()) +
                            " pixels are more than " + std::to_string(most_pixels));
    return false;
  }
  picture_problem_.report("");
  shown_ = params.header.stamp;
  image_.header.stamp = shown_ + video_delay_;
  cv::Mat picture = picture_of(image_, view->width(), view->height());
  draw(figure_, *view, picture);
  return true;
}

void TestCard::note_cost() {
  cost_ += newest_cost * (std::chrono::duration<double>(spent_).count() - cost_);
  spent_ = {};
  const double period = std::chrono::duration<double>(period_).count();
  // Hysteresis: after the warning, the cost must fall below enough_room before it is cleared.
  const bool is_slow = cost_ > (speed_problem_.reported.empty() ? period : enough_room * period);
  if (is_slow == !speed_problem_.reported.empty()) return;
  speed_problem_.report(!is_slow
                            ? ""
                            : "this machine is too slow: a picture takes " + std::to_string(std::lround(cost_ * 1e3)) +
                                  " ms, but one is due every " + std::to_string(std::lround(period * 1e3)) +
                                  " ms. Pictures are late, so an overlay is not reliable: lower the parameter rate");
}

bool TestCard::rectified_wanted() const {
  return rectified_images_.getNumSubscribers() > 0 || paired_images_.getNumSubscribers() > 0;
}

void TestCard::rectify_if_possible() {
  if (!to_be_rectified_) return;
  const auto found = std::find_if(infos_.rbegin(), infos_.rend(), [this](const sensor_msgs::CameraInfoConstPtr& info) {
    return info->header.stamp == shown_;
  });
  if (found == infos_.rend()) return;
  to_be_rectified_ = false;
  try {
    rectify(**found);
  } catch (const std::exception& error) {
    rectification_problem_.report(std::string("the picture cannot be rectified with camera_info: ") + error.what());
  }
}

void TestCard::rectify(const sensor_msgs::CameraInfo& info) {
  if (info.width != image_.width || info.height != image_.height) {
    rectification_problem_.report("camera_info is of " + std::to_string(info.width) + " x " +
                                  std::to_string(info.height) + " pixels, constants of " +
                                  std::to_string(image_.width) + " x " + std::to_string(image_.height));
    return;
  }
  const int width = static_cast<int>(image_.width), height = static_cast<int>(image_.height);
  model_.fromCameraInfo(info);
  rectified_.header = image_.header;
  cv::Mat rectified = picture_of(rectified_, width, height);
  model_.rectifyImage(picture_of(image_, width, height), rectified, cv::INTER_LINEAR);
  if (rectified_images_.getNumSubscribers() > 0) rectified_images_.publish(rectified_);
  if (paired_images_.getNumSubscribers() > 0) {
    sensor_msgs::CameraInfo straight = info;
    straight.header.stamp = image_.header.stamp;
    std::fill(straight.D.begin(), straight.D.end(), 0.0);
    paired_infos_.publish(straight);
    paired_images_.publish(rectified_);
  }
  rectification_problem_.report("");
}

void TestCard::Problem::report(const std::string& now) {
  if (now == reported) return;
  reported = now;
  if (!now.empty()) ROS_WARN_STREAM("test card: " << now);
}

int test_card_main(int argc, char** argv) { return nodes::node_main<TestCard>(argc, argv, "test_card"); }

}  // namespace trk_bridge::demo
