// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The meter with video of the test card whose delay is known.
#include <functional>
#include <random>
#include <string>

#include <gmock/gmock.h>

#include "card_video.h"
#include "delay/meter.h"
#include "delay/plot.h"
#include "delay/report.h"

namespace trk_bridge::delay::test_card_test {

using test::quick_pans;
using test::quick_pans_end;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Motion = std::function<wire::CameraParams(double)>;

constexpr double begin = 1e9;                // s: of all stamps
constexpr double tenth_of_field = 0.1 / 50;  // s
constexpr double tracking_rate = 50;         // Hz
constexpr double before = 1.2, after = 0.8;  // s of tracking before and after the video

std::int64_t stamp(double seconds) {
  return static_cast<std::int64_t>(begin) * 1'000'000'000 + static_cast<std::int64_t>(seconds * 1e9);
}

/// Frames are stamped with the time that they show.
void add_video(Meter& meter, test::CardVideo& video, double rate, double seconds, const Motion& motion) {
  constexpr double phase = 0.0033;  // of frames to samples
  for (int i = 0; i < seconds * rate; ++i) {
    const double t = phase + i / rate;
    meter.add(stamp(t), video.frame(motion(t), t));
  }
}

/// Replaces the tracking by samples that are stamped so that the video is later by `delay`.
void add_tracking(Meter& meter, double delay, const Motion& motion, double jitter = 0) {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < (before + quick_pans_end + after) * tracking_rate; ++i) {
    const double t = i / tracking_rate - before;
    const double late = jitter * std::clamp(gauss(random), -4.0, 4.0);
    ASSERT_TRUE(meter.add(stamp(t - delay + late), motion(t)));
  }
}

/// With noise in the picture, a person in front of a fifth of it, and 2 ms of jitter in the stamps of tracking.
class SpoiltVideo : public ::testing::TestWithParam<double> {};

TEST_P(SpoiltVideo, GivesTheDelayToATenthOfAField) {
  Meter meter;
  (void)meter.use(test::video_constants());
  test::CardVideo video;
  video.noise = 8;
  video.foreground = true;
  add_video(meter, video, GetParam(), quick_pans_end, quick_pans);
  for (const double delay : {0.0, 0.0072, 0.02, 0.0413, 0.08, -0.03}) {
    add_tracking(meter, delay, quick_pans, 0.002);
    const auto found = meter.measure();
    EXPECT_FALSE(found.cannot_tell) << describe(*found.cannot_tell);
    EXPECT_NEAR(found.delay, delay, tenth_of_field);
    EXPECT_LT(found.accuracy, tenth_of_field);
    EXPECT_GT(found.correlation, 0.99);
    EXPECT_NEAR(1 / found.frame_interval, GetParam(), 0.01);
    EXPECT_NEAR(1 / found.tracking_interval, tracking_rate, 5);
    EXPECT_THAT(faults(found), IsEmpty());
  }
}

INSTANTIATE_TEST_SUITE_P(Hz, SpoiltVideo, ::testing::Values(25.0, 50.0));

class CleanVideo : public ::testing::Test {
 protected:
  /// With faulty tracking, and a video that is 41.3 ms late.
  static Measurement against(const Motion& tracking) {
    static const Meter with_video = [] {
      Meter meter;
      (void)meter.use(test::video_constants());
      test::CardVideo video;
      add_video(meter, video, 25, quick_pans_end, quick_pans);
      return meter;
    }();
    Meter meter = with_video;
    add_tracking(meter, delay, tracking);
    return meter.measure();
  }

  static constexpr double delay = 0.0413;
};

TEST_F(CleanVideo, GivesDelayAndScalesMoreExactly) {
  const auto found = against(quick_pans);
  ASSERT_FALSE(found.cannot_tell);
  EXPECT_NEAR(found.delay, delay, 2e-4);
  EXPECT_NEAR(found.axes[0].scale, 1, 0.002);
  EXPECT_NEAR(found.axes[1].scale, 1, 0.002);
  EXPECT_NEAR(found.axes[2].scale, 1, 0.01);
  EXPECT_EQ(summary(found, 0.02), "the video is 41.3 ms later than tracking (2.07 fields)");
  EXPECT_THAT(faults(found), IsEmpty());
}

TEST_F(CleanVideo, APanWithAWrongSignIsReportedAndTheDelayFound) {
  const auto found = against([](double t) {
    auto params = quick_pans(t);
    params.euler.pan *= -1;
    return params;
  });
  ASSERT_FALSE(found.cannot_tell);
  EXPECT_NEAR(found.delay, delay, tenth_of_field);
  EXPECT_NEAR(found.axes[0].scale, -1, 0.01);
  EXPECT_GT(found.axes[1].scale, 0);
  EXPECT_THAT(faults(found), ElementsAre("pan turns the wrong way"));
}

TEST_F(CleanVideo, AFocalLengthThatIsThreePercentTooLongIsNamed) {
  const auto found = against([](double t) {
    auto params = quick_pans(t);
    params.fov *= 1.03;
    return params;
  });
  ASSERT_FALSE(found.cannot_tell);
  EXPECT_NEAR(found.delay, delay, tenth_of_field);
  ASSERT_TRUE(found.focal_length_scale);
  EXPECT_NEAR(*found.focal_length_scale, 1 / 1.03, 0.002);
  EXPECT_THAT(faults(found),
              ElementsAre(::testing::MatchesRegex("tracking's focal length is (2.9|3.0|3.1) % too long")));
}

TEST_F(CleanVideo, ReportsWhyItCannotMeasure) {
  const auto why = [](const Motion& motion) { return against(motion).cannot_tell; };
  EXPECT_EQ(why([](double) { return quick_pans(0); }), CannotTell::tracking_stood);
  EXPECT_EQ(why([](double t) { return quick_pans(t + 30); }), CannotTell::tracking_stood);
  EXPECT_EQ(why([](double t) { return quick_pans(t - 0.55); }), CannotTell::out_of_range);
  const auto other_motion = [](double t) {
    auto params = quick_pans(0);
    params.euler.pan = 3 * std::sin(20 * t);
    return params;
  };
  EXPECT_EQ(why(other_motion), CannotTell::disagree);
}

TEST_F(CleanVideo, IsDrawn) {
  const std::string svg = to_svg(against(quick_pans), "a title");
  EXPECT_THAT(svg, ::testing::AllOf(::testing::StartsWith("<svg "), HasSubstr(">a title</text>"),
                                    HasSubstr("pan, pixels a second"), ::testing::EndsWith("</svg>\n")));
  EXPECT_THAT(svg, ::testing::Not(HasSubstr("nan")));
}

TEST(StillVideo, TellsNothing) {
  Meter meter;
  (void)meter.use(test::video_constants());
  test::CardVideo video;
  video.noise = 8;
  const auto still = [](double) { return quick_pans(0); };
  add_video(meter, video, 25, 3.5, still);
  EXPECT_EQ(meter.measure().cannot_tell, CannotTell::too_little) << "without tracking";
  add_tracking(meter, 0.04, still);
  EXPECT_EQ(meter.measure().cannot_tell, CannotTell::hardly_moved);
  add_tracking(meter, 0.04, quick_pans);
  EXPECT_EQ(meter.measure().cannot_tell, CannotTell::picture_stood);
  meter.keep(2.2);
  EXPECT_EQ(meter.measure().cannot_tell, CannotTell::too_little);
}

TEST(EvenPan, TellsNothing) {
  Meter meter;
  (void)meter.use(test::video_constants());
  test::CardVideo video;
  video.noise = 8;
  const auto even = [](double t) {
    auto params = quick_pans(0);
    params.euler.pan = 5 * t - 10;
    return params;
  };
  add_video(meter, video, 25, 3.5, even);
  add_tracking(meter, 0.04, even);
  EXPECT_EQ(meter.measure().cannot_tell, CannotTell::too_even);
}

TEST(Clocks, ThatDifferAreReported) {
  Meter meter;
  (void)meter.use(test::video_constants());
  test::CardVideo video;
  add_video(meter, video, 25, 0.5, quick_pans);
  add_tracking(meter, 37, quick_pans);
  EXPECT_EQ(meter.measure().cannot_tell, CannotTell::other_time);
}

}  // namespace trk_bridge::delay::test_card_test
