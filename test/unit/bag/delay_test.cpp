// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The delay between video and tracking in bags, also with the program trk delay.
#include "bag/delay_command.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "card_video.h"
#include "fixture.h"
#include "program.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::bag::delay_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double begin = 1000;  // s
constexpr double delay = 0.0473;

class DelayOfBag : public BagTest {
 protected:
  void SetUp() override { bag_.emplace(directory / "video.bag"); }

  void put_constants(const std::string& camera = "crane1") { put_constants(test::video_constants(), camera); }
  void put_constants(const wire::CameraConstants& constants, const std::string& camera = "crane1") {
    trk_bridge::CameraConstants message;
    ros1::to_msg(constants, message);
    message.header.stamp = ::ros::Time(begin);
    bag_->put("/" + camera + "/constants", begin, message);
  }

  void put_params(const std::string& camera = "crane1") {
    trk_bridge::CameraParams message;
    for (int i = 0; i < 50 * (test::quick_pans_end + 2); ++i) {
      const double t = i / 50.0 - 1.2;
      ros1::to_msg(test::quick_pans(t), message);
      message.header.stamp = ::ros::Time(begin + t);
      bag_->put("/" + camera + "/params", begin + t, message);
    }
  }

  /// Frames of 25 Hz that are late by `delay`, rendered only once.
  void put_video(const std::function<void(double stamp, const cv_bridge::CvImage&)>& put) {
    static const std::vector<cv::Mat> frames = [] {
      std::vector<cv::Mat> made;
      test::CardVideo video;
      for (int i = 0; i < 25 * test::quick_pans_end; ++i) made.push_back(video.frame(test::quick_pans(i / 25.0), 0));
      return made;
    }();
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const double stamp = begin + static_cast<double>(i) / 25 + delay;
      std_msgs::Header header;
      header.stamp = ::ros::Time(stamp);
      put(stamp, cv_bridge::CvImage(header, "mono8", frames[i]));
    }
  }
  void put_video(const std::string& topic = "/crane1/image_raw") {
    put_video([&](double stamp, const cv_bridge::CvImage& frame) { bag_->put(topic, stamp, *frame.toImageMsg()); });
  }

  template <typename Message>
  void put(const std::string& topic, double seconds, const Message& message) {
    bag_->put(topic, seconds, message);
  }
  std::string closed() { return bag_->closed(); }

  delay::Measurement measured(const DelayOptions& options = {}) { return measure_delay(closed(), options, run, err); }
  std::string refusal(const DelayOptions& options = {}) {
    return test::error_of<BagError>([&] { (void)measured(options); });
  }

  /// Output of trk delay, and its exit code.
  std::pair<std::string, int> trk(std::vector<std::string> words) {
    words.insert(words.begin(), {TRK_TOOL, "delay"});
    test::Program program(words);
    err_text = program.rest_of_err();
    std::string out = program.rest_of_out();
    return {std::move(out), program.wait()};
  }

  std::string err_text;

 private:
  std::optional<SomeBag> bag_;
};

TEST_F(DelayOfBag, IsMeasuredAndPrintedInAllForms) {
  put_constants();
  put_params();
  put_video();
  const auto found = measured();
  ASSERT_FALSE(found.cannot_tell);
  EXPECT_NEAR(found.delay, delay, 0.001);

  const std::string bag = directory / "video.bag";
  const auto [text, code] = trk({bag, "--plot", directory / "delay.svg"});
  EXPECT_EQ(code, 0) << err_text;
  EXPECT_THAT(text, AllOf(StartsWith("the video is 47."), HasSubstr(" ms later than tracking (2.3"),
                          HasSubstr("\nfor ros_to_trk: delay:=0.047")));
  EXPECT_THAT(test::read_text(directory / "delay.svg"), HasSubstr(text.substr(0, text.find('\n'))));

  const auto [json_text, json_code] = trk({bag, "--json", "--field-rate", "100"});
  EXPECT_EQ(json_code, 0) << err_text;
  rapidjson::Document json;
  ASSERT_FALSE(json.Parse(json_text.c_str()).HasParseError()) << json_text;
  EXPECT_NEAR(json["delay"].GetDouble(), delay, 0.001);
  EXPECT_NEAR(json["fields"].GetDouble(), 4.73, 0.1);
}

TEST_F(DelayOfBag, ColourAndCompressionDoNotMatter) {
  put_constants();
  put_params();
  put_video([&](double stamp, const cv_bridge::CvImage& frame) {
    const auto colour = cv_bridge::cvtColor(boost::make_shared<const cv_bridge::CvImage>(frame), "bgr8");
    put("/video/compressed", stamp, *colour->toCompressedImageMsg(cv_bridge::JPG));
  });
  EXPECT_NEAR(measured().delay, delay, 0.001);
}

TEST_F(DelayOfBag, MissingTopicsAreNamed) {
  put_params();
  EXPECT_THAT(refusal(), AllOf(HasSubstr("video.bag: "), HasSubstr("no topic of type sensor_msgs/Image")));
}

TEST_F(DelayOfBag, ConstantsAreNeeded) {
  put_params();
  put_video();
  EXPECT_THAT(refusal(), HasSubstr("there is no message on /crane1/constants"));
}

TEST_F(DelayOfBag, ConstantsMustDescribeAPicture) {
  auto constants = test::video_constants();
  constants.chip_width = 0;
  put_constants(constants);
  put_params();
  put_video();
  EXPECT_THAT(refusal(), HasSubstr("constants of /crane1/constants describe no picture"));
}

TEST_F(DelayOfBag, ConstantsThatChangeAreRefusedWithTheRemedy) {
  put_constants();
  put_constants();
  auto constants = test::video_constants();
  constants.image_width += 2;
  put_constants(constants);
  put_params();
  put_video();
  EXPECT_THAT(refusal(), HasSubstr("constants of /crane1/constants change: cut the bag there (rosbag filter)"));
}

TEST_F(DelayOfBag, TheVideoIsThatOfTheCameraOrTheNamedOne) {
  put_constants();
  put_params();
  put_video("/left/image");
  put_video("/right/image");
  EXPECT_THAT(refusal(), HasSubstr("several topics with pictures, --image must name one: /left/image, /right/image"));
  DelayOptions options;
  options.image = "middle/image";
  EXPECT_THAT(refusal(options), HasSubstr("no topic /middle/image"));
  options.image = "/crane1/params";
  EXPECT_THAT(refusal(options), HasSubstr("/crane1/params is of type trk_bridge/CameraParams"));
  options.image = "right/image";
  EXPECT_NEAR(measured(options).delay, delay, 0.001);
}

TEST_F(DelayOfBag, FramesNeedStamps) {
  put_constants();
  put_params();
  put("/crane1/image_raw", begin, sensor_msgs::Image());
  EXPECT_THAT(refusal(), HasSubstr("a message of /crane1/image_raw has no stamp"));
}

TEST_F(DelayOfBag, InvalidPicturesAreRefused) {
  put_constants();
  put_params();
  sensor_msgs::Image image;
  image.header.stamp = ::ros::Time(begin);
  image.encoding = "sepia";
  put("/crane1/image_raw", begin, image);
  EXPECT_THAT(refusal(), HasSubstr("a message of /crane1/image_raw is not a picture"));
}

TEST_F(DelayOfBag, WithoutMotionTheExitCodeIsFailure) {
  put_constants();
  trk_bridge::CameraParams message;
  for (int i = 0; i < 300; ++i) {
    ros1::to_msg(test::quick_pans(0), message);
    message.header.stamp = ::ros::Time(begin - 1 + i / 50.0);
    put("/crane1/params", begin, message);
  }
  const cv::Mat frame = test::CardVideo().frame(test::quick_pans(0), 0);
  std_msgs::Header header;
  for (int i = 0; i < 75; ++i) {
    header.stamp = ::ros::Time(begin + i / 25.0);
    put("/crane1/image_raw", begin, *cv_bridge::CvImage(header, "mono8", frame).toImageMsg());
  }
  const auto [text, code] = trk({closed(), "--plot", directory / "delay.svg"});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(text, StartsWith("cannot tell: the camera hardly moved\n"));
  EXPECT_THAT(err_text, HasSubstr("delay.svg is not drawn"));
}

TEST_F(DelayOfBag, WrongArgumentsAreRefused) {
  EXPECT_EQ(trk({closed(), "--plot", "delay.png"}).second, 2);
  EXPECT_THAT(err_text, HasSubstr("must end in .svg"));
  EXPECT_EQ(trk({closed(), "--most", "0"}).second, 2);
  EXPECT_EQ(trk({directory / "missing.bag"}).second, 1);
}

}  // namespace trk_bridge::bag::delay_test
