// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A tracked camera in front of the test card: where it is at any time, and what its video shows then.
#pragma once

#include <algorithm>
#include <stdexcept>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "demo/test_card_picture.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::test {

/// 0 before `begin`, then within `time` smoothly to `change`.
inline double moved(double t, double begin, double time, double change) {
  const double u = std::clamp((t - begin) / time, 0.0, 1.0);
  return change * u * u * u * (10 + u * (6 * u - 15));
}

/// Does not move at first, pans quickly, tilts and rolls, and stands still after 4.4 s. `t` in s.
inline wire::CameraParams quick_pans(double t) {
  wire::CameraParams params;
  params.format = wire::euler;
  const double pan = moved(t, 0.5, 0.6, 15) + moved(t, 1.6, 0.5, -20) + moved(t, 3.6, 0.8, 9);
  const double tilt = -3 + moved(t, 1.0, 0.5, 5) + moved(t, 2.4, 0.6, -7);
  const double roll = moved(t, 2.8, 0.5, 6) + moved(t, 3.3, 0.6, -6);
  params.euler = {0, 2, 2, pan, tilt, roll};
  params.fov = 9;
  params.k1 = 1e-3;
  return params;
}
constexpr double quick_pans_end = 4.6;  // s

inline wire::CameraConstants video_constants() {
  wire::CameraConstants constants;
  constants.image_width = 320;
  constants.image_height = 180;
  constants.chip_width = constants.fake_chip_width = 9.6;
  constants.chip_height = constants.fake_chip_height = 5.4;
  return constants;
}

/// Frames of the card, with disturbances.
class CardVideo {
 public:
  bool foreground = false;  ///< somebody walks to and fro in front of a fifth of the picture
  double noise = 0;         ///< standard deviation, levels of grey

  /// Of a camera with these parameters. `t` in s: only the foreground depends on it.
  cv::Mat frame(const wire::CameraParams& params, double t) {
    const auto view = demo::View::of(params, video_constants());
    if (!view) throw std::runtime_error("no view");
    cv::Mat picture(view->height(), view->width(), CV_8UC1);
    demo::draw(figure_, *view, picture);
    if (foreground) {
      const cv::Rect body(static_cast<int>(115 + 100 * std::sin(2.5 * t)), 50, 90, 128);
      texture_(cv::Rect({}, body.size())).copyTo(picture(body));
    }
    if (noise > 0) {
      cv::Mat spoilt(picture.size(), CV_32F);
      random_.fill(spoilt, cv::RNG::NORMAL, 0, noise);
      cv::add(picture, spoilt, picture, cv::noArray(), CV_8U);
    }
    return picture;
  }

 private:
  static cv::Mat blobs() {
    cv::Mat texture(180, 320, CV_8UC1);
    cv::RNG random(7);
    random.fill(texture, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(texture, texture, {9, 9}, 2);
    cv::normalize(texture, texture, 0, 255, cv::NORM_MINMAX);
    return texture;
  }

  demo::Figure figure_ = demo::figure_at({});
  cv::Mat texture_ = blobs();
  cv::RNG random_{5};
};

}  // namespace trk_bridge::test
