#include <cstdio>
#include <random>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "delay/meter.h"
#include "demo/test_card_picture.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::delay {
namespace {

wire::CameraConstants constants() {
  wire::CameraConstants c;
  c.image_width = 320; c.image_height = 180; c.chip_width = c.fake_chip_width = 9.6; c.chip_height = c.fake_chip_height = 5.4;
  return c;
}
double eased(double u) { u = std::clamp(u, 0.0, 1.0); return u * u * u * (10 + u * (6 * u - 15)); }

struct Shot {
  double delay = 0.04, rate = 50, tracking_rate = 50, seconds = 6, sigma = 0, jitter = 0; bool foreground = false; double pan_sign = 1, focal = 1; bool still = false;
};
wire::CameraParams params_at(double t, bool still) {
  wire::CameraParams p;
  p.format = wire::euler;
  double pan = 0, tilt = 0, roll = 0;
  if (!still) {
    pan = 15 * (eased((t - 1) / .6) - eased((t - 2.1) / .9) - eased((t-4)/.5)+ eased((t-5.5)/.7));
    tilt = 6 * (eased((t - 1.5) / .6) - eased((t - 3) / .8));
    roll = 6 * (eased((t - 3.5) / .6) - eased((t - 4.5) / .6));
  }
  p.euler = {0, 2, 2, pan, tilt - 3, roll};
  p.fov = 9; p.k1 = 1e-3;
  return p;
}
Measurement run(const Shot& shot) {
  Meter meter;
  (void)meter.use(constants());
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  const auto figure = demo::figure_at({});
  auto wrong = [&](double t) { auto p = params_at(t, shot.still); p.euler.pan *= shot.pan_sign; p.fov *= shot.focal; return p; };
  for (double t = -1.1; t < shot.seconds + .7; t += 1 / shot.tracking_rate) {
    auto r = meter.add(static_cast<std::int64_t>((1000 + t + shot.jitter * std::clamp(gauss(random), -3., 3.)) * 1e9), wrong(t));
    EXPECT_TRUE(r);
  }
  cv::Mat picture(180, 320, CV_8UC1), noise(180, 320, CV_32F), fg(180, 320, CV_8UC1);
  cv::theRNG().state = 5;
  cv::randu(fg, 0, 255); cv::GaussianBlur(fg, fg, {9, 9}, 2); cv::normalize(fg, fg, 0, 255, cv::NORM_MINMAX);
  for (double t = 0.0033; t < shot.seconds; t += 1 / shot.rate) {
    demo::draw(figure, *demo::View::of(params_at(t, shot.still), constants()), picture);
    if (shot.foreground) {
      const int x = static_cast<int>(120 + 100 * std::sin(t * 2.5));
      cv::Rect r(x, 50, 90, 128);
      fg(cv::Rect(20, 20, 90, 128)).copyTo(picture(r & cv::Rect(0,0,320,180)));
    }
    if (shot.sigma > 0) {
      cv::randn(noise, 0, shot.sigma);
      cv::Mat f; picture.convertTo(f, CV_32F); f += noise; f.convertTo(picture, CV_8U);
    }
    meter.add(static_cast<std::int64_t>((1000 + t + shot.delay) * 1e9), picture);
  }
  auto m = meter.measure();
  std::printf("rate %g true %5.1f got %7.3f +- %.3f ms corr %.4f followed %.3f  ", shot.rate, shot.delay * 1e3, m.delay * 1e3, m.accuracy * 1e3, m.correlation, m.followed);
  for (auto& a : m.axes) std::printf("[%d %.4f +- %.4f c %.4f] ", a.moved, a.scale, a.scale_error, a.correlation);
  std::printf(" f %.4f %s\n", m.focal_length_scale.value_or(0), m.cannot_tell ? describe(*m.cannot_tell) : "");
  return m;
}

TEST(X, Y) {
  for (double rate : {25., 50.}) {
    for (double tr : {25., 50.}) run({0.0413, rate, tr});
    for (double d : {0., 0.013, 0.08}) run({d, rate, 50});
    run({0.0413, rate, 50, 6, 8});
    run({0.0413, rate, 50, 6, 8, 0.002});
    run({0.0413, rate, rate, 6, 8, 0.002, true});
    run({0.0413, rate, 50, 6, 0, 0, false, -1});
    run({0.0413, rate, 50, 6, 0, 0, false, 1, 1.03});
    run({0.0413, rate, 50, 6, 8, 0.002, true, 1, 1.03});
    run({0.0413, rate, 50, 6, 8, 0.002, true, 1, 1, true});
  }
}

}  // namespace
}  // namespace trk_bridge::delay
