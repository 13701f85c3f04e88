#include <algorithm>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>

#include <sensor_msgs/CameraInfo.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>
#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraConstants.h>

#include "bridge/camera_info.h"
#include "cli/number_text.h"
#include "fields.h"
#include "ros/camera_info.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bag {
namespace {

using geometry_msgs::TransformStamped;

/// How far transforms may lie apart to be interpolated between, as in tf's own buffers.
const ::ros::Duration reach(10.0);

struct Recorded {
  RecordedConstants constants;
  std::vector<sensor_msgs::CameraInfo> infos;
  std::vector<TransformStamped> moving, fixed;
};

void strip_slash(std::string& frame) {
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
}

Recorded read(Reader& bag, const std::string& camera, std::uint32_t format) {
  const std::string info_topic = topic_of(camera, "camera_info");
  const std::string constants_topic = topic_of(camera, "constants");
  has_topic<sensor_msgs::CameraInfo>(bag.connections(), info_topic);
  has_topic<trk_bridge::CameraConstants>(bag.connections(), constants_topic);
  const bool has_tf = has_topic<tf2_msgs::TFMessage>(bag.connections(), "/tf");
  const bool has_tf_static = has_topic<tf2_msgs::TFMessage>(bag.connections(), "/tf_static");
  if (!has_tf && !has_tf_static) throw BagError("there is neither /tf nor /tf_static: the pose is not known");

  Recorded recorded{RecordedConstants(format), {}, {}, {}};
  const auto wanted = [&](const Connection& connection) {
    const auto& topic = connection.topic;
    return topic == info_topic || topic == constants_topic || topic == "/tf" || topic == "/tf_static";
  };
  bag.read(wanted, [&](const RawMessage& raw) {
    if (raw.connection.topic == info_topic) {
      recorded.constants.note_field();
      recorded.infos.push_back(message_of<sensor_msgs::CameraInfo>(raw));
      strip_slash(recorded.infos.back().header.frame_id);
    } else if (raw.connection.topic == constants_topic) {
      const auto message = message_of<trk_bridge::CameraConstants>(raw);
      recorded.constants.use(ros1::from_msg(message), stamp_of(message));
    } else {
      auto& into = raw.connection.topic == "/tf" ? recorded.moving : recorded.fixed;
      for (auto& transform : message_of<tf2_msgs::TFMessage>(raw).transforms) {
        strip_slash(transform.header.frame_id);
        strip_slash(transform.child_frame_id);
        into.push_back(transform);
      }
    }
  });
  return recorded;
}

/// By time, one for each child and stamp: a buffer warns of repeated ones.
void put_in_order(std::vector<TransformStamped>& transforms) {
  const auto key = [](const TransformStamped& t) { return std::tie(t.header.stamp, t.child_frame_id); };
  std::stable_sort(transforms.begin(), transforms.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  transforms.erase(
      std::unique(transforms.begin(), transforms.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
      transforms.end());
}

/// The transforms of a recording. The buffer holds only those around the requested time, because each lookup searches
/// all that it holds.
class Poses {
 public:
  Poses(std::vector<TransformStamped> moving, const std::vector<TransformStamped>& fixed)
      : moving_(std::move(moving)), buffer_(reach + reach) {
    put_in_order(moving_);
    for (const auto& transform : fixed) buffer_.setTransform(transform, "bag", /*is_static=*/true);
  }

  /// Each stamp must not be before the last one. The error is tf's own.
  tl::expected<Eigen::Isometry3d, std::string> at(::ros::Time stamp, const std::string& parent,
                                                  const std::string& child) {
    for (; next_ < moving_.size() && moving_[next_].header.stamp <= stamp + reach; ++next_) {
      buffer_.setTransform(moving_[next_], "bag", /*is_static=*/false);
    }
    try {
      return ros1::to_isometry(buffer_.lookupTransform(parent, child, stamp).transform);
    } catch (const tf2::ExtrapolationException&) {
      return tl::unexpected("no transforms around its time lead from " + child + " to " + parent);
    } catch (const tf2::TransformException& error) {
      return tl::unexpected(std::string(error.what()));
    }
  }

 private:
  std::vector<TransformStamped> moving_;
  std::size_t next_ = 0;
  tf2::BufferCore buffer_;
};

/// Those that the bag lacks, from the options.
void use_chip_options(Recorded& recorded, const BagToTakeOptions& options) {
  if (recorded.constants.converter().incoming() != nullptr) {
    if (options.chip_width || options.chip_height) refuse_chip_options();
    return;
  }
  if (!options.chip_width || !options.chip_height) {
    throw BagError(
        "there are no constants, and CameraInfo has no millimetres: set --chip-width MM and --chip-height MM");
  }
  const auto& info = recorded.infos.front();
  wire::CameraConstants constants;
  constants.image_width = static_cast<std::int32_t>(info.width);
  constants.image_height = static_cast<std::int32_t>(info.height);
  constants.chip_width = *options.chip_width;
  constants.chip_height = *options.chip_height;
  if (!camera::check(constants)) {
    throw BagError("a chip of " + cli::number_text(constants.chip_width) + " x " +
                   cli::number_text(constants.chip_height) + " mm (--chip-width, --chip-height) and an image of " +
                   std::to_string(info.width) + " x " + std::to_string(info.height) +
                   " pixels (camera_info) describe no picture");
  }
  recorded.constants.use(constants, stamp_of(info));
}

/// The lens of each CameraInfo, fitted again only when the calibration changes; and the largest errors of all fits.
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
    report(err, "tangential distortion is left out", largest_.tangential);
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
    err << "trk: " << what << ": by at most " << pixels << " pixels\n";
  }

  const wire::CameraConstants constants_;
  bridge::CameraInfo info_;
  std::optional<tl::expected<camera::FittedLens, bridge::InfoFault>> fitted_;
  camera::FittedLens largest_;  // its lens is not used
};

/// The pose of the camera's own axes: those of CameraInfo's frame are optical.
tl::expected<Eigen::Isometry3d, std::string> pose_of(Poses& poses, const sensor_msgs::CameraInfo& info,
                                                     const BagToTakeOptions& options) {
  if (info.header.stamp.isZero()) return tl::unexpected(std::string("camera_info without a stamp"));
  const bool is_optical = !options.camera_frame || options.camera_frame_is_optical;
  auto pose = poses.at(info.header.stamp, options.studio_frame, options.camera_frame.value_or(info.header.frame_id));
  if (!pose || !is_optical) return pose;
  return *pose * ros1::camera_T_optical().inverse();
}

tl::expected<wire::CameraParams, std::string> params_of(Poses& poses, LensFits& fits,
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

}  // namespace

Fields fields_from_tf(Reader& bag, const std::string& camera, const BagToTakeOptions& options, cli::LongRun& run,
                      std::ostream& err) {
  Recorded recorded = read(bag, camera, options.format.value_or(wire::euler));
  if (recorded.infos.empty()) throw BagError("there is no message on " + topic_of(camera, "camera_info"));
  std::stable_sort(recorded.infos.begin(), recorded.infos.end(),
                   [](const auto& a, const auto& b) { return a.header.stamp < b.header.stamp; });
  use_chip_options(recorded, options);
  const camera::Converter& converter = recorded.constants.converter();
  Fields fields;
  fields.has_counters = false;
  fields.constants = *converter.outgoing();
  if (options.id) fields.constants.id = *options.id;
  Poses poses(std::move(recorded.moving), recorded.fixed);
  LensFits fits(*converter.incoming());
  Omissions omissions;
  run.begin("converting");
  double done = 0;
  for (const auto& info : recorded.infos) {
    run.at(done++ / static_cast<double>(recorded.infos.size()));
    auto params = params_of(poses, fits, info, options, converter);
    if (!params) {
      omissions.add(params.error(), stamp_of(info));
      continue;
    }
    params->id = fields.constants.id;
    params->counter = fields.params.size() + 1;
    fields.params.push_back(*params);
    fields.stamps.push_back(stamp_of(info));
  }
  run.end();
  omissions.report(err);
  fits.report(err);
  if (fields.params.empty()) throw BagError("no field is left of " + topic_of(camera, "camera_info"));
  return fields;
}

}  // namespace trk_bridge::bag
