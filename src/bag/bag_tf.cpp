#include <algorithm>
#include <array>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>

#include <sensor_msgs/CameraInfo.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>
#include <tf2_msgs/TFMessage.h>
#include <trk_bridge/CameraConstants.h>

#include "bag_fields.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bag {
namespace {

using geometry_msgs::TransformStamped;

/// How far transforms may lie apart to be interpolated between, as in tf's own buffers.
const ::ros::Duration reach(10.0);

struct Recorded {
  BagConstants constants;
  std::vector<sensor_msgs::CameraInfo> infos;
  std::vector<TransformStamped> moving, fixed;
};

void strip_slash(std::string& frame) {
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
}

Recorded read(BagFile& bag, const std::string& camera) {
  const std::string info_topic = topic_of(camera, "camera_info");
  const std::string constants_topic = topic_of(camera, "constants");
  has_topic<sensor_msgs::CameraInfo>(bag.connections(), info_topic);
  has_topic<trk_bridge::CameraConstants>(bag.connections(), constants_topic);
  const bool has_tf = has_topic<tf2_msgs::TFMessage>(bag.connections(), "/tf");
  const bool has_tf_static = has_topic<tf2_msgs::TFMessage>(bag.connections(), "/tf_static");
  if (!has_tf && !has_tf_static) throw BagError("there is neither /tf nor /tf_static: the pose is not known");

  Recorded recorded;
  const auto wanted = [&](const BagConnection& connection) {
    const auto& topic = connection.topic;
    return topic == info_topic || topic == constants_topic || topic == "/tf" || topic == "/tf_static";
  };
  bag.read(wanted, [&](const BagMessage& raw) {
    if (raw.connection.topic == info_topic) {
      recorded.constants.note_params();
      recorded.infos.push_back(message_of<sensor_msgs::CameraInfo>(raw));
      strip_slash(recorded.infos.back().header.frame_id);
    } else if (raw.connection.topic == constants_topic) {
      const auto message = message_of<trk_bridge::CameraConstants>(raw);
      recorded.constants.take(ros1::from_msg(message), static_cast<std::int64_t>(message.header.stamp.toNSec()));
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

/// By time, one for each child and stamp: a buffer takes repeated ones for a mistake, aloud.
void put_in_order(std::vector<TransformStamped>& transforms) {
  const auto key = [](const TransformStamped& t) { return std::tie(t.header.stamp, t.child_frame_id); };
  std::stable_sort(transforms.begin(), transforms.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  transforms.erase(
      std::unique(transforms.begin(), transforms.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
      transforms.end());
}

/// The transforms of a recording, of which a buffer holds those around the time that is asked for: one with all of them
/// would search through all of them every time.
class Poses {
 public:
  Poses(std::vector<TransformStamped> moving, const std::vector<TransformStamped>& fixed)
      : moving_(std::move(moving)), buffer_(reach + reach) {
    put_in_order(moving_);
    for (const auto& transform : fixed) buffer_.setTransform(transform, "bag", /*is_static=*/true);
  }

  /// Stamps must not fall. The error is tf's own.
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

wire::CameraConstants constants_of(const Recorded& recorded, const BagToTakeOptions& options) {
  const bool is_said = options.chip_width || options.chip_height;
  if (const auto& known = recorded.constants.known()) {
    if (is_said) throw BagError("--chip-width, --chip-height: for bags without constants; this one has them");
    return *known;
  }
  if (!options.chip_width || !options.chip_height) {
    throw BagError(
        "there are no constants, and CameraInfo knows no millimetres: say --chip-width MM and --chip-height MM");
  }
  const auto& info = recorded.infos.front();
  wire::CameraConstants constants;
  constants.image_width = static_cast<std::int32_t>(info.width);
  constants.image_height = static_cast<std::int32_t>(info.height);
  constants.chip_width = *options.chip_width;
  constants.chip_height = *options.chip_height;
  return constants;
}

/// The lens, fitted anew only when the calibration changes; and the worst that trk cannot tell of any.
class Lenses {
 public:
  explicit Lenses(const wire::CameraConstants& constants) : constants_(constants) {}

  tl::expected<camera::Lens, std::string> of(const sensor_msgs::CameraInfo& info) {
    if (info.width != static_cast<std::uint32_t>(constants_.image_width) ||
        info.height != static_cast<std::uint32_t>(constants_.image_height)) {
      return tl::unexpected("its image is " + std::to_string(info.width) + " x " + std::to_string(info.height) +
                            ", that of the constants " + std::to_string(constants_.image_width) + " x " +
                            std::to_string(constants_.image_height));
    }
    const bool is_known_model =
        info.D.empty() || info.distortion_model == "plumb_bob" || info.distortion_model == "rational_polynomial";
    if (!is_known_model) {
      return tl::unexpected("distortion model " + info.distortion_model +
                            ": plumb_bob and rational_polynomial can be told in trk");
    }
    std::array<double, 9> k{};
    std::copy(info.K.begin(), info.K.end(), k.begin());
    if (!fitted_ || k != k_ || info.D != d_) {
      k_ = k;
      d_ = info.D;
      fitted_ = camera::fit_lens(k_, d_, constants_);
      note();
    }
    if (!*fitted_) return tl::unexpected(camera::describe(fitted_->error()));
    return (*fitted_)->lens;
  }

  void tell(std::ostream& err) const {
    if (residual_ > camera::plumb_bob_tolerance) tell(err, "k1 and k2 come to", residual_, "of the distortion");
    if (tangential_ > camera::plumb_bob_tolerance) tell(err, "tangential distortion is lost:", tangential_, "");
    if (aspect_ > camera::plumb_bob_tolerance) tell(err, "fy does not agree with fx and the chip:", aspect_, "");
  }

 private:
  void note() {
    if (!*fitted_) return;
    residual_ = std::max(residual_, (*fitted_)->residual);
    tangential_ = std::max(tangential_, (*fitted_)->tangential);
    aspect_ = std::max(aspect_, (*fitted_)->aspect);
  }
  static void tell(std::ostream& err, const char* what, double pixels, const char* of_what) {
    err << "trk: " << what << " within " << pixels << " pixels at worst" << (*of_what ? " " : "") << of_what << '\n';
  }

  const wire::CameraConstants constants_;
  std::array<double, 9> k_{};
  std::vector<double> d_;
  std::optional<camera::Result<camera::FittedLens>> fitted_;
  double residual_ = 0, tangential_ = 0, aspect_ = 0;
};

/// The pose of the camera's own axes: those of CameraInfo's frame are optical.
tl::expected<Eigen::Isometry3d, std::string> pose_of(Poses& poses, const sensor_msgs::CameraInfo& info,
                                                     const BagToTakeOptions& options) {
  if (info.header.stamp.isZero()) return tl::unexpected(std::string("camera_info without a stamp"));
  const bool is_optical = !options.camera_frame || options.camera_frame_is_optical;
  const auto pose =
      poses.at(info.header.stamp, options.studio_frame, options.camera_frame.value_or(info.header.frame_id));
  if (!pose || !is_optical) return pose;
  return *pose * ros1::camera_T_optical().inverse();
}

tl::expected<wire::CameraParams, std::string> params_of(Poses& poses, Lenses& lenses,
                                                        const sensor_msgs::CameraInfo& info,
                                                        const BagToTakeOptions& options,
                                                        const wire::CameraConstants& outgoing) {
  const auto pose = pose_of(poses, info, options);
  if (!pose) return tl::unexpected(pose.error());
  const auto lens = lenses.of(info);
  if (!lens) return tl::unexpected(lens.error());
  auto params = camera::encode({*pose, *lens}, options.format.value_or(wire::euler), &outgoing);
  if (!params) return tl::unexpected(camera::describe(params.error()));
  params->id = outgoing.id;
  return *params;
}

}  // namespace

BagFields fields_from_tf(BagFile& bag, const std::string& camera, const BagToTakeOptions& options, cli::LongRun& run,
                         std::ostream& err) {
  Recorded recorded = read(bag, camera);
  if (recorded.infos.empty()) throw BagError("there is no message on " + topic_of(camera, "camera_info"));
  std::stable_sort(recorded.infos.begin(), recorded.infos.end(),
                   [](const auto& a, const auto& b) { return a.header.stamp < b.header.stamp; });
  const auto incoming = constants_of(recorded, options);
  if (const auto sound = camera::check(incoming); !sound) throw BagError(camera::describe(sound.error()));
  const std::uint32_t format = options.format.value_or(wire::euler);
  BagFields fields;
  fields.has_counters = false;
  fields.constants = camera::constants_for(incoming, format);
  if (options.id) fields.constants.id = *options.id;
  Poses poses(std::move(recorded.moving), recorded.fixed);
  Lenses lenses(incoming);
  Omissions omissions;
  run.begin("converting");
  double done = 0;
  for (const auto& info : recorded.infos) {
    run.at(done++ / static_cast<double>(recorded.infos.size()));
    auto params = params_of(poses, lenses, info, options, fields.constants);
    const auto stamp = static_cast<std::int64_t>(info.header.stamp.toNSec());
    if (!params) {
      omissions.add(params.error(), stamp);
      continue;
    }
    params->counter = fields.params.size() + 1;
    fields.params.push_back(*params);
    fields.stamps.push_back(stamp);
  }
  run.end();
  omissions.tell(err);
  lenses.tell(err);
  if (fields.params.empty()) throw BagError("no field is left of " + topic_of(camera, "camera_info"));
  return fields;
}

}  // namespace trk_bridge::bag
