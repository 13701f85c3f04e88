// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <utility>

#include <sensor_msgs/CameraInfo.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>
#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraConstants.h>

#include "base/number_text.h"
#include "bridge/camera_info.h"
#include "fields.h"
#include "ros/camera_info.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bag {
namespace {

using geometry_msgs::TransformStamped;

/// The largest distance of transforms for interpolation, as in the buffers of tf.
constexpr std::int64_t reach = 10'000'000'000;  // ns

/// Stamps in the order of recording, ns; none is 0.
struct Stamps {
  std::uint64_t count = 0;
  std::int64_t newest = 0;
  std::int64_t disorder = 0;  ///< the largest amount by which a stamp was older than the newest before it

  void add(std::int64_t stamp) {
    ++count;
    newest = std::max(newest, stamp);
    disorder = std::max(disorder, newest - stamp);
  }
  /// Whether all stamps of `all` up to `stamp` have been read.
  bool have_reached(std::int64_t stamp, const Stamps& all) const {
    return count == all.count || stamp < newest - all.disorder;
  }
};

/// Data that is needed before the first field.
struct Survey {
  RecordedConstants constants;
  Stamps infos, transforms;
  std::optional<sensor_msgs::CameraInfo> first;   // by its stamp
  std::map<std::string, TransformStamped> fixed;  // by child
};

void strip_slash(std::string& frame) {
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
}

std::vector<TransformStamped> transforms_of(const RawMessage& raw) {
  auto transforms = message_of<tf2_msgs::TFMessage>(raw).transforms;
  for (auto& transform : transforms) {
    strip_slash(transform.header.frame_id);
    strip_slash(transform.child_frame_id);
  }
  return transforms;
}

struct TfTopics {
  std::string info, constants;

  bool operator()(const Connection& connection) const {
    const auto& topic = connection.topic;
    return topic == info || topic == constants || topic == "/tf" || topic == "/tf_static";
  }
};

TfTopics checked_topics(const Reader& bag, const std::string& camera) {
  TfTopics topics{topic_of(camera, "camera_info"), topic_of(camera, "constants")};
  has_topic<sensor_msgs::CameraInfo>(bag.connections(), topics.info);
  has_topic<trk_bridge::CameraConstants>(bag.connections(), topics.constants);
  const bool has_tf = has_topic<tf2_msgs::TFMessage>(bag.connections(), "/tf");
  const bool has_tf_static = has_topic<tf2_msgs::TFMessage>(bag.connections(), "/tf_static");
  if (!has_tf && !has_tf_static) throw BagError("there is neither /tf nor /tf_static: the pose is not known");
  return topics;
}

Survey survey_of(Reader& bag, const TfTopics& topics, std::uint32_t format) {
  Survey survey{RecordedConstants(format), {}, {}, {}, {}};
  bag.read(topics, [&](const RawMessage& raw) {
    if (raw.connection.topic == topics.info) {
      survey.constants.note_field();
      auto info = message_of<sensor_msgs::CameraInfo>(raw);
      if (!info.header.stamp.isZero()) survey.infos.add(stamp_of(info));
      if (!survey.first || stamp_of(info) < stamp_of(*survey.first)) survey.first = std::move(info);
    } else if (raw.connection.topic == topics.constants) {
      const auto message = message_of<trk_bridge::CameraConstants>(raw);
      survey.constants.use(ros1::from_msg(message), stamp_of(message));
    } else {
      for (auto& transform : transforms_of(raw)) {
        if (raw.connection.topic == "/tf_static") {
          survey.fixed[transform.child_frame_id] = transform;
        } else if (!transform.header.stamp.isZero()) {
          survey.transforms.add(stamp_of(transform));
        }
      }
    }
  });
  return survey;
}

/// The transforms of a recording, in reading order. The buffer holds only those around the requested time, because each
/// lookup searches the whole buffer.
class Poses {
 public:
  explicit Poses(const Survey& survey) : all_(survey.transforms), buffer_(::ros::Duration().fromNSec(2 * reach)) {
    for (const auto& [child, transform] : survey.fixed) buffer_.setTransform(transform, "bag", /*is_static=*/true);
  }

  /// If a child has several transforms with equal stamps, the first is used: a buffer warns about repeated ones.
  void add(const TransformStamped& transform) {
    const std::int64_t stamp = stamp_of(transform);
    if (stamp == 0) return;
    read_.add(stamp);
    waiting_.emplace(std::pair(stamp, transform.child_frame_id), transform);
  }

  /// Whether all transforms that a pose at this time may need have been read.
  bool are_read(std::int64_t stamp) const { return read_.have_reached(stamp + reach, all_); }
  /// No pose before this time will be requested any more.
  void pass_to(std::int64_t stamp) {
    while (!waiting_.empty()) {
      const auto first = waiting_.begin();
      const std::int64_t its_stamp = first->first.first;
      if (its_stamp > stamp + reach || !read_.have_reached(its_stamp, all_)) break;
      buffer_.setTransform(first->second, "bag", /*is_static=*/false);
      waiting_.erase(first);
    }
  }

  /// Call after pass_to() of this time. The error is that of tf.
  tl::expected<Eigen::Isometry3d, std::string> at(::ros::Time stamp, const std::string& parent,
                                                  const std::string& child) const {
    try {
      return ros1::to_isometry(buffer_.lookupTransform(parent, child, stamp).transform);
    } catch (const tf2::ExtrapolationException&) {
      return tl::unexpected("no transforms around its time lead from " + child + " to " + parent);
    } catch (const tf2::TransformException& error) {
      return tl::unexpected(std::string(error.what()));
    }
  }

 private:
  const Stamps all_;
  Stamps read_;
  std::map<std::pair<std::int64_t, std::string>, TransformStamped> waiting_;  // by stamp and child
  tf2::BufferCore buffer_;
};

/// Uses the options if the bag has no constants.
void use_chip_options(Survey& survey, const BagToTakeOptions& options) {
  if (survey.constants.converter().incoming() != nullptr) {
    if (options.chip_width || options.chip_height) refuse_chip_options();
    return;
  }
  if (!options.chip_width || !options.chip_height) {
    throw BagError(
        "there are no constants, and CameraInfo does not contain the chip size: set --chip-width MM and --chip-height "
        "MM");
  }
  const auto& info = *survey.first;
  wire::CameraConstants constants;
  constants.image_width = static_cast<std::int32_t>(info.width);
  constants.image_height = static_cast<std::int32_t>(info.height);
  constants.chip_width = *options.chip_width;
  constants.chip_height = *options.chip_height;
  if (!camera::check(constants)) {
    throw BagError("a chip of " + base::number_text(constants.chip_width) + " x " +
                   base::number_text(constants.chip_height) + " mm (--chip-width, --chip-height) and an image of " +
                   std::to_string(info.width) + " x " + std::to_string(info.height) +
                   " pixels (camera_info) describe no picture");
  }
  survey.constants.use(constants, stamp_of(info));
}

/// The lens of each CameraInfo, fitted again only if the calibration changes, and the largest errors of all fits.
class LensFits {
 public:
  explicit LensFits(const wire::CameraConstants& constants) : constants_(constants) {}

  tl::expected<camera::Lens, std::string> lens(const sensor_msgs::CameraInfo& message) {
    if (message.width != static_cast<std::uint32_t>(constants_.image_width) ||
        message.height != static_cast<std::uint32_t>(constants_.image_height)) {
      return tl::unexpected("its image is " + std::to_string(message.width) + " x " + std::to_string(message.height) +
                            ", that of the constants " + std::to_string(constants_.image_width) + " x " +
                            std::to_string(constants_.image_height));
    }
    auto info = ros1::from_msg(message);
    if (!fitted_ || !bridge::same_calibration(info, info_)) {
      info_ = std::move(info);
      fitted_ = bridge::fit_lens(info_, constants_);
      if (*fitted_) keep_largest(**fitted_);
    }
    if (!*fitted_) {
      return tl::unexpected("camera_info with distortion_model '" + info_.distortion_model + "' and " +
                            std::to_string(info_.d.size()) + " coefficients: " + bridge::describe(fitted_->error()));
    }
    return (*fitted_)->lens;
  }

  void report(std::ostream& err) const {
    report(err, "k1 and k2 differ from the distortion", largest_.residual);
    report(err, "tangential distortion is ignored", largest_.tangential);
    report(err, "fy does not agree with fx and the chip", largest_.aspect);
  }

 private:
  void keep_largest(const camera::FittedLens& fitted) {
    largest_.residual = std::max(largest_.residual, fitted.residual);
    largest_.tangential = std::max(largest_.tangential, fitted.tangential);
    largest_.aspect = std::max(largest_.aspect, fitted.aspect);
  }
  static void report(std::ostream& err, const char* what, double pixels) {
    if (pixels <= camera::plumb_bob_tolerance) return;
    err << "trk: " << what << ": by up to " << pixels << " pixels\n";
  }

  const wire::CameraConstants constants_;
  bridge::CameraInfo info_;
  std::optional<tl::expected<camera::FittedLens, bridge::InfoFault>> fitted_;
  camera::FittedLens largest_;  // its lens is not used
};

/// The pose of the camera axes, converted from the optical frame of CameraInfo if needed.
tl::expected<Eigen::Isometry3d, std::string> pose_of(const Poses& poses, const sensor_msgs::CameraInfo& info,
                                                     const BagToTakeOptions& options) {
  if (info.header.stamp.isZero()) return tl::unexpected(std::string("camera_info without a stamp"));
  const bool is_optical = !options.camera_frame || options.camera_frame_is_optical;
  auto pose = poses.at(info.header.stamp, options.studio_frame, options.camera_frame.value_or(info.header.frame_id));
  if (!pose || !is_optical) return pose;
  return *pose * ros1::camera_T_optical().inverse();
}

tl::expected<wire::CameraParams, std::string> params_of(const Poses& poses, LensFits& fits,
                                                        const sensor_msgs::CameraInfo& info,
                                                        const BagToTakeOptions& options,
                                                        const camera::Converter& converter) {
  const auto pose = pose_of(poses, info, options);
  if (!pose) return tl::unexpected(pose.error());
  const auto lens = fits.lens(info);
  if (!lens) return tl::unexpected(lens.error());
  const auto params = converter.convert(camera::Camera{*pose, *lens});
  if (!params) return tl::unexpected(camera::describe(params.error()));
  return *params;
}

/// Converts camera_info to fields in the order of stamps, each as soon as all transforms that it needs have been read.
class TfConversion {
 public:
  TfConversion(const Survey& survey, const BagToTakeOptions& options, const FieldVisitor& visit)
      : options_(options),
        visit_(visit),
        converter_(survey.constants.converter()),
        constants_(*converter_.outgoing()),
        all_(survey.infos),
        earliest_(stamp_of(*survey.first)),
        poses_(survey),
        fits_(*converter_.incoming()) {
    if (options.id) constants_.id = *options.id;
  }

  void add(const TransformStamped& transform) {
    poses_.add(transform);
    convert_complete();
  }
  void add(const sensor_msgs::CameraInfo& info) {
    if (info.header.stamp.isZero()) return convert(info);
    read_.add(stamp_of(info));
    waiting_.emplace(stamp_of(info), info);
    convert_complete();
  }

  std::uint64_t fields() const { return fields_; }
  void report(std::ostream& err) const {
    omissions_.report(err);
    fits_.report(err);
  }

 private:
  void convert_complete() {
    while (!waiting_.empty()) {
      const auto first = waiting_.begin();
      if (!read_.have_reached(first->first, all_) || !poses_.are_read(first->first)) break;
      poses_.pass_to(first->first);
      convert(first->second);
      waiting_.erase(first);
    }
    // Also during long gaps between camera_info, so that transforms that are not needed are not kept.
    poses_.pass_to(waiting_.empty() ? earliest_to_come() : std::min(waiting_.begin()->first, earliest_to_come()));
  }

  std::int64_t earliest_to_come() const {
    if (read_.count == all_.count) return std::numeric_limits<std::int64_t>::max() - reach;
    return std::max(earliest_, read_.newest - all_.disorder);
  }

  void convert(const sensor_msgs::CameraInfo& info) {
    const auto passed = pass(info);
    if (passed) {
      ++fields_;
    } else {
      omissions_.add(passed.error(), stamp_of(info));
    }
  }

  tl::expected<void, std::string> pass(const sensor_msgs::CameraInfo& info) {
    auto params = params_of(poses_, fits_, info, options_, converter_);
    if (!params) return tl::unexpected(params.error());
    params->id = constants_.id;
    params->counter = fields_ + 1;
    return visit_({constants_, *params, stamp_of(info)});
  }

  const BagToTakeOptions& options_;
  const FieldVisitor& visit_;
  const camera::Converter& converter_;
  wire::CameraConstants constants_;
  const Stamps all_;
  const std::int64_t earliest_;
  Stamps read_;
  std::multimap<std::int64_t, sensor_msgs::CameraInfo> waiting_;  // by stamp
  Poses poses_;
  LensFits fits_;
  Omissions omissions_;
  std::uint64_t fields_ = 0;
};

}  // namespace

void fields_from_tf(Reader& bag, const std::string& camera, const BagToTakeOptions& options, cli::LongRun& run,
                    const FieldVisitor& visit, std::ostream& err) {
  const TfTopics topics = checked_topics(bag, camera);
  Survey survey = survey_of(bag, topics, options.format.value_or(wire::euler));
  if (!survey.first) throw BagError("there is no message on " + topics.info);
  use_chip_options(survey, options);
  TfConversion conversion(survey, options, visit);
  bag.read(topics, [&](const RawMessage& raw) {
    if (raw.connection.topic == topics.info) {
      auto info = message_of<sensor_msgs::CameraInfo>(raw);
      strip_slash(info.header.frame_id);
      conversion.add(info);
    } else if (raw.connection.topic == "/tf") {
      for (const auto& transform : transforms_of(raw)) conversion.add(transform);
    }
  });
  run.end();
  conversion.report(err);
  if (conversion.fields() == 0) throw BagError("no field is left of " + topics.info);
}

}  // namespace trk_bridge::bag
