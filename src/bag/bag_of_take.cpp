// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <ostream>
#include <system_error>

#include <tf2_msgs/TFMessage.h>

#include "base/number_text.h"
#include "base/time_text.h"
#include "bridge/camera_pipeline.h"
#include "bridge/stamper.h"
#include "convert.h"
#include "file/part_file.h"
#include "file/take.h"
#include "ros/camera_messages.h"
#include "ros/trk_to_ros_parameters.h"
#include "timing.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/transport/source.h"
#include "writer.h"

namespace trk_bridge::bag {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& value, const std::string& why) {
  throw BagError(std::string(option) + " = " + value + ": " + why);
}

/// Named and checked like in trk_to_ros.
ros1::CameraFrames frames_of(const TakeToBagOptions& options) {
  if (const auto checked = ros1::check_camera_name(options.camera); !checked) {
    refuse("--camera", ros1::shown(options.camera), checked.error());
  }
  const auto frame = [](const char* option, const std::string& value) {
    const auto checked = ros1::parse_frame(value);
    if (!checked) refuse(option, ros1::shown(value), checked.error());
    return *checked;
  };
  ros1::CameraFrames frames = ros1::default_frames(options.camera);
  frames.studio = frame("--studio-frame", options.studio_frame);
  frames.camera = frame("--camera-frame", options.camera_frame.value_or(frames.camera));
  frames.optical = frame("--optical-frame", options.optical_frame.value_or(frames.optical));
  for (const auto& [one, other] :
       {std::pair(&frames.camera, &frames.studio), std::pair(&frames.optical, &frames.studio),
        std::pair(&frames.optical, &frames.camera)}) {
    if (*one == *other) throw BagError("frame " + ros1::shown(*one) + ": studio, camera and optical frame must differ");
  }
  return frames;
}

bridge::CameraPipeline pipeline_of(const TakeToBagOptions& options) {
  if (!ros1::field_rate_range.contains(options.field_rate)) {
    refuse("--field-rate", ros1::shown(options.field_rate), "must be " + ros1::field_rate_range.text());
  }
  bridge::CameraOptions camera;
  camera.format = options.format;
  return {camera, options.field_rate};
}

/// A take's camera as trk_to_ros publishes it.
class TakeCamera {
 public:
  explicit TakeCamera(const TakeToBagOptions& options)
      : frames_(frames_of(options)), pipeline_(pipeline_of(options)), messages_(frames_) {
    sample_.sender.kind = transport::SenderKind::file;
  }

  geometry_msgs::TransformStamped optical_transform(std::int64_t stamp) const {
    return ros1::optical_transform(frames_, ros1::to_time(stamp));
  }

  /// Afterwards messages() holds the content of the update.
  bridge::CameraUpdate process(const wire::Record& record, std::int64_t stamp,
                               std::optional<base::TimeCodeWithRate> time_code = {}) {
    sample_.record = record;
    sample_.arrival = stamp;
    sample_.time_code = time_code;
    auto update = pipeline_.process(sample_, stamp);
    messages_.make(update);
    return update;
  }
  const ros1::CameraMessages& messages() const noexcept { return messages_; }
  const bridge::CameraStatistics& statistics() const noexcept { return pipeline_.statistics(); }

 private:
  const ros1::CameraFrames frames_;
  transport::Sample sample_;
  bridge::CameraPipeline pipeline_;
  ros1::CameraMessages messages_;
};

/// The times of the fields of a take.
class Schedule {
 public:
  Schedule(const base::TimeCode& code, const TakeToBagOptions& options)
      : rate_(options.field_rate),
        codes_(base::TimeCodeSeries::from(code, rate_)),
        times_(options.start ? base::TimeCodeSeries::from({}, rate_) : codes_),
        base_(options.start.value_or(options.midnight)) {
    if (!times_) throw BagError(times_.error() + "; set --field-rate HZ, or --start TIME");
  }

  std::int64_t at(std::uint64_t field) const { return base_ + times_->nanoseconds(field); }
  /// None if the time code of the take does not fit the rate.
  std::optional<base::TimeCodeWithRate> time_code(std::uint64_t field) const {
    if (!codes_) return std::nullopt;
    return base::TimeCodeWithRate{codes_->code(field), rate_};
  }
  /// When the time code was 00:00:00:00:1; none if it does not fit the rate.
  std::optional<std::int64_t> zero() const {
    if (!codes_) return std::nullopt;
    return at(0) - codes_->nanoseconds(0);
  }

 private:
  using Series = tl::expected<base::TimeCodeSeries, std::string>;

  const double rate_;
  const Series codes_, times_;
  const std::int64_t base_;
};

/// The topics of a camera as a recorder would have received them from trk_to_ros. Connection headers are made here,
/// because the order in which a recorder finds publishers is random.
class Recording {
 public:
  Recording(file::PartFile& file, const TakeToBagOptions& options, std::optional<std::int64_t> zero)
      : writer_(file, options.compression), header_{{"callerid", "/" + options.camera + "/trk_to_ros"}} {
    header_[field_rate_key] = base::number_text(options.field_rate);
    if (zero) header_[time_code_zero_key] = std::to_string(*zero);
    static_transforms_ = connect<tf2_msgs::TFMessage>("/tf_static", "1");
    constants_ = connect<trk_bridge::CameraConstants>(topic_of(options.camera, "constants"), "1");
    transforms_ = connect<tf2_msgs::TFMessage>("/tf", "0");
    params_ = connect<trk_bridge::CameraParams>(topic_of(options.camera, "params"), "0");
    camera_info_ = connect<sensor_msgs::CameraInfo>(topic_of(options.camera, "camera_info"), "0");
    time_codes_ = connect<trk_bridge::TimeCode>(topic_of(options.camera, "time_code"), "0");
    transform_.transforms.resize(1);
  }

  void write_static(const geometry_msgs::TransformStamped& transform) { write(static_transforms_, transform); }

  /// Writes everything that the update contains.
  void write(const bridge::CameraUpdate& update, ::ros::Time stamp, const ros1::CameraMessages& messages) {
    if (update.constants) writer_.write(constants_, stamp, *messages.constants());
    if (update.pose) write(transforms_, messages.transform());
    if (update.params) writer_.write(params_, stamp, *messages.params());
    if (update.calibration) writer_.write(camera_info_, stamp, *messages.camera_info());
    if (update.time_code) writer_.write(time_codes_, stamp, *messages.time_code());
  }

  void close() { writer_.close(); }

 private:
  template <typename Message>
  Writer::Connection connect(const std::string& topic, const char* latching) {
    header_["latching"] = latching;
    return writer_.connect<Message>(topic, header_);
  }

  void write(Writer::Connection connection, const geometry_msgs::TransformStamped& transform) {
    transform_.transforms.front() = transform;
    writer_.write(connection, transform.header.stamp, transform_);
  }

  Writer writer_;
  ::ros::M_string header_;
  Writer::Connection static_transforms_, constants_, transforms_, params_, camera_info_, time_codes_;
  tf2_msgs::TFMessage transform_;
};

void report(const bridge::CameraStatistics& statistics, std::ostream& err) {
  const auto line = [&err](std::uint64_t times, const std::string& what) {
    if (times > 0) err << "trk: " << times << " fields " << what << '\n';
  };
  const auto& sequence = statistics.sequence;
  line(sequence.duplicates + sequence.late,
       "are not in the bag: their counter is not new, and trk_to_ros publishes each counter once");
  line(statistics.dropped, "are not in the bag: " + camera::describe(statistics.drop_reason));
  line(statistics.withheld, "are without params: " + camera::describe(statistics.withhold_reason));
  line(statistics.without_camera_info, "are without camera_info: " + camera::describe(statistics.info_reason));
  if (statistics.bad_constants > 0) {
    err << "trk: the constants are not in the bag: " << camera::describe(camera::CameraReason::bad_constants) << '\n';
  }
}

/// The stamp of a field. Throws BagError if it is outside the range of ROS time.
std::int64_t stamp_at(const Schedule& schedule, std::uint64_t field) {
  const std::int64_t stamp = schedule.at(field);
  if (!bridge::can_be_stamp(stamp)) {
    throw BagError("its fields are outside of 1970 to 2106, the range of ROS time");
  }
  return stamp;
}

/// Converts everything after the head of the take. Returns the fault of an incomplete last line.
std::optional<transport::Fault> record(file::TakeReader& take, const Schedule& schedule, TakeCamera& camera,
                                       Recording& recording, cli::LongRun& run) {
  const std::int64_t begin = stamp_at(schedule, 0);
  recording.write_static(camera.optical_transform(begin));
  recording.write(camera.process(take.constants(), begin), ros1::to_time(begin), camera.messages());
  std::optional<transport::Fault> cut;
  for (std::uint64_t field = 0;;) {
    switch (take.next()) {
      case file::TakeReader::Got::params: {
        run.at(take.progress());
        const auto update = camera.process(take.params(), stamp_at(schedule, field), schedule.time_code(field));
        recording.write(update, ros1::to_time(update.stamp), camera.messages());
        ++field;
        break;
      }
      case file::TakeReader::Got::truncated:
        cut = take.fault();
        break;
      case file::TakeReader::Got::end:
        return cut;
      default:
        throw transport::TransportError(take.error());
    }
  }
}

}  // namespace

void check_written(const std::string& path, const transport::WriteResult& written) {
  if (!written) throw transport::TransportError(path + ": cannot be written: " + describe(written.error()));
}

void bag_of_take(const std::string& take_path, const std::string& bag_path, const TakeToBagOptions& options,
                 cli::LongRun& run, std::ostream& err) {
  file::TakeReader take(take_path, file::MalformedLines::are_errors, file::Waiting::blocks);
  if (take.next() != file::TakeReader::Got::head) throw transport::TransportError(take.error());
  try {
    TakeCamera camera(options);
    const Schedule schedule(take.time_code(), options);
    auto opened = file::PartFile::open(bag_path, {options.overwrite});
    if (!opened) check_written(bag_path, tl::unexpected(opened.error()));
    auto& file = *opened;
    run.begin("writing " + bag_path);
    std::optional<transport::Fault> cut;
    try {
      Recording recording(file, options, schedule.zero());
      cut = record(take, schedule, camera, recording, run);
      recording.close();
    } catch (...) {
      file.discard();
      throw;
    }
    run.end();
    if (const auto published = file.publish(); !published) {
      check_written(bag_path, transport::refused_by_system(published.error()));
    }
    if (cut) err << "trk: warning: " << take_path << ": " << describe(*cut) << '\n';
    report(camera.statistics(), err);
    err << "trk: " << bag_path << ": " << camera.statistics().sequence.accepted << " fields of camera "
        << options.camera << ", from " << base::seconds_text(schedule.at(0)) << " at "
        << base::number_text(options.field_rate) << " fields a second\n";
  } catch (const BagError& error) {
    throw BagError(take_path + ": " + error.what());
  } catch (const std::system_error& error) {
    throw transport::TransportError(bag_path + ": cannot be written: " + error.code().message());
  }
}

}  // namespace trk_bridge::bag
