// How parts of a picture have moved since the one before.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace trk_bridge::delay {

/// A point of the scene in two successive frames, pixels in ROS coordinates (origin in the centre of the top left one,
/// y down).
struct MovedPoint {
  Eigen::Vector2d before, now;
};

/// Follows what is seen from frame to frame. The whole picture's motion comes from phase correlation, however far it
/// is; from there single points are followed to a small part of a pixel (Lucas and Kanade). Points are spread over the
/// picture, so that a small object with much detail has few of them. Not synchronised.
class PictureMotion {
 public:
  /// `grey` is CV_8UC1 and is not kept. Points that were found again, in no order: none for the first frame, for one of
  /// another size than the one before, and where there is nothing to see. They are some that move otherwise than the
  /// camera, and some that are wrong. The result holds until the next call.
  const std::vector<MovedPoint>& next(const cv::Mat& grey);

 private:
  /// Where the points are now, if they are near to where the motion of the whole picture puts them.
  struct Followed {
    cv::Point2f whole;
    std::vector<cv::Point2f> points;
    std::vector<unsigned char> is_found;
    float difference = 0;  // between what is about a point before and now, levels of grey: the median
  };

  cv::Point2f correlated_motion();
  Followed follow(const cv::Point2f& whole) const;

  cv::Size size_;
  cv::Mat before_, now_;              // reduced
  cv::Mat small_before_, small_now_;  // reduced further, for phase correlation
  cv::Mat correlated_before_, correlated_now_, window_;
  cv::Point2f whole_;  // motion from before_ to now_
  std::vector<cv::Point2f> points_;
  std::vector<MovedPoint> moved_;
};

}  // namespace trk_bridge::delay
