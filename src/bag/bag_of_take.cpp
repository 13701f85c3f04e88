#include <cerrno>
#include <map>
#include <memory>
#include <ostream>
#include <system_error>

#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

#include "base/time_text.h"
#include "bridge/camera_pipeline.h"
#include "bridge/stamper.h"
#include "cli/number_text.h"
#include "convert.h"
#include "file/part_file.h"
#include "file/take.h"
#include "ros/camera_messages.h"
#include "ros/trk_to_ros_parameters.h"
#include "timing.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::bag {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& value, const std::string& why) {
  throw BagError(std::string(option) + " = " + value + ": " + why);
}

const std::string& name_of(const TakeToBagOptions& options) {
  if (const auto sound = ros1::check_camera_name(options.camera); !sound) {
    refuse("--camera", ros1::shown(options.camera), sound.error());
  }
  return options.camera;
}

/// As trk_to_ros names and checks them.
ros1::CameraFrames frames_of(const TakeToBagOptions& options) {
  const auto frame = [](const char* option, const std::string& value) {
    const auto sound = ros1::parse_frame(value);
    if (!sound) refuse(option, ros1::shown(value), sound.error());
    return *sound;
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
      : name_(name_of(options)), frames_(frames_of(options)), pipeline_(pipeline_of(options)), messages_(frames_) {
    sample_.sender.kind = transport::SenderKind::file;
  }

  std::string topic(const char* last) const { return topic_of(name_, last); }
  geometry_msgs::TransformStamped optical_transform(std::int64_t stamp) const {
    return ros1::optical_transform(frames_, ros1::to_time(stamp));
  }

  /// Afterwards messages() has what is in the update.
  bridge::CameraUpdate process(const wire::Record& record, std::int64_t stamp,
                               std::optional<base::CountedTimeCode> time_code = {}) {
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
  const std::string name_;  // checked first: the others are named after it
  const ros1::CameraFrames frames_;
  transport::Sample sample_;
  bridge::CameraPipeline pipeline_;
  ros1::CameraMessages messages_;
};

/// When the fields of a take were.
class Schedule {
 public:
  Schedule(const base::TimeCode& code, const TakeToBagOptions& options)
      : rate_(options.field_rate), taken_(code), code_(options.start ? base::TimeCode{} : code) {
    const auto of_code = base::nanoseconds_of(code, rate_, 0);
    if (!of_code && !options.start) throw BagError(of_code.error() + "; set --field-rate HZ, or --start TIME");
    base_ = options.start.value_or(options.midnight);
    if (of_code) zero_ = options.start ? base_ - *of_code : base_;
  }

  std::int64_t at(std::uint64_t field) const { return base_ + base::nanoseconds_of(code_, rate_, field).value(); }
  /// None when the take's code does not go with the rate.
  std::optional<base::CountedTimeCode> time_code(std::uint64_t field) const {
    const auto code = base::time_code_after(taken_, rate_, field);
    if (!code) return std::nullopt;
    return base::CountedTimeCode{*code, rate_};
  }
  /// When the time code was 00:00:00:00:1; none when the code does not go with the rate.
  std::optional<std::int64_t> zero() const noexcept { return zero_; }

 private:
  double rate_;
  base::TimeCode taken_;
  base::TimeCode code_;  // that stamps are counted with
  std::int64_t base_ = 0;
  std::optional<std::int64_t> zero_;
};

/// Writes messages as a recorder would have got them from trk_to_ros. Connection headers are made here, because a
/// recorder meets publishers in a random order.
class Recording {
 public:
  Recording(const std::string& path, const TakeToBagOptions& options, std::optional<std::int64_t> zero)
      : Recording("/" + options.camera + "/trk_to_ros") {
    extra_[field_rate_key] = cli::number_text(options.field_rate);
    if (zero) extra_[time_code_zero_key] = std::to_string(*zero);
    with_reason([&] { bag_->open(path, rosbag::bagmode::Write); });
    bag_->setCompression(options.compression == "bz2"   ? rosbag::compression::BZ2
                         : options.compression == "lz4" ? rosbag::compression::LZ4
                                                        : rosbag::compression::Uncompressed);
  }
  /// A bag whose end cannot be written would throw in its destructor: that one stays in memory.
  ~Recording() {
    try {
      bag_->close();
    } catch (const rosbag::BagException&) {
      static_cast<void>(bag_.release());
    }
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  template <typename Message>
  void write(const std::string& topic, ::ros::Time stamp, const Message& message, bool is_latched = false) {
    auto& header = headers_[topic];
    if (!header) {
      header = boost::make_shared<::ros::M_string>(extra_);
      (*header)["callerid"] = caller_;
      (*header)["latching"] = is_latched ? "1" : "0";
      (*header)["md5sum"] = ::ros::message_traits::md5sum(message);
      (*header)["message_definition"] = ::ros::message_traits::definition(message);
      (*header)["topic"] = topic;
      (*header)["type"] = ::ros::message_traits::datatype(message);
    }
    with_reason([&] { bag_->write(topic, stamp, message, header); });
  }

  void write(const std::string& topic, const geometry_msgs::TransformStamped& transform, bool is_latched = false) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    write(topic, transform.header.stamp, message, is_latched);
  }

  void close() {
    with_reason([&] { bag_->close(); });
  }

 private:
  explicit Recording(std::string caller) : caller_(std::move(caller)), bag_(std::make_unique<rosbag::Bag>()) {}

  /// rosbag says how many bytes were not written, the system why.
  template <typename Action>
  static void with_reason(const Action& action) {
    errno = 0;
    try {
      action();
    } catch (const rosbag::BagException&) {
      if (errno == 0) throw;
      throw rosbag::BagIOException(std::generic_category().message(errno));
    }
  }

  const std::string caller_;
  ::ros::M_string extra_;
  std::map<std::string, boost::shared_ptr<::ros::M_string>> headers_;
  std::unique_ptr<rosbag::Bag> bag_;
};

void report(const bridge::CameraStatistics& statistics, std::ostream& err) {
  const auto line = [&err](std::uint64_t times, const std::string& what) {
    if (times > 0) err << "trk: " << times << " fields " << what << '\n';
  };
  const auto& sequence = statistics.sequence;
  line(sequence.duplicates + sequence.late,
       "are not in the bag: their counter came before, and trk_to_ros publishes none twice");
  line(statistics.dropped, "are not in the bag: " + camera::describe(statistics.drop_reason));
  line(statistics.withheld, "are without params: " + camera::describe(statistics.withhold_reason));
  line(statistics.without_camera_info, "are without camera_info: " + camera::describe(statistics.info_reason));
  if (statistics.bad_constants > 0) {
    err << "trk: the constants are not in the bag: " << camera::describe(camera::CameraReason::bad_constants) << '\n';
  }
}

void record(const file::Take& take, const Schedule& schedule, TakeCamera& camera, Recording& recording,
            cli::LongRun& run) {
  const std::int64_t begin = schedule.at(0);
  if (!bridge::can_be_stamp(begin) || !bridge::can_be_stamp(schedule.at(take.params.size()))) {
    throw BagError("its fields are outside of 1970 to 2106, the range of ROS time");
  }
  const auto& messages = camera.messages();
  recording.write("/tf_static", camera.optical_transform(begin), /*is_latched=*/true);
  if (camera.process(take.constants, begin).constants) {
    recording.write(camera.topic("constants"), ros1::to_time(begin), *messages.constants(), /*is_latched=*/true);
  }
  for (std::size_t i = 0; i < take.params.size(); ++i) {
    run.at(static_cast<double>(i) / static_cast<double>(take.params.size()));
    const auto update = camera.process(take.params[i], schedule.at(i), schedule.time_code(i));
    const auto stamp = ros1::to_time(update.stamp);
    if (update.pose) recording.write("/tf", messages.transform());
    if (update.params) recording.write(camera.topic("params"), stamp, *messages.params());
    if (update.calibration) recording.write(camera.topic("camera_info"), stamp, *messages.camera_info());
    if (update.time_code) recording.write(camera.topic("time_code"), stamp, *messages.time_code());
  }
}

}  // namespace

void check_written(const std::string& path, const transport::Written& written) {
  if (!written) throw transport::TransportError(path + ": cannot be written: " + describe(written.error()));
}

void bag_of_take(const std::string& take_path, const std::string& bag_path, const TakeToBagOptions& options,
                 cli::LongRun& run, std::ostream& err) {
  const file::Take take = file::read_take(take_path);
  for (const auto& line : take.left_out) err << "trk: warning: " << take_path << ": " << describe(line.fault) << '\n';
  try {
    TakeCamera camera(options);
    const Schedule schedule(take.time_code, options);
    auto opened = file::PartFile::open(bag_path, {options.overwrite});
    if (!opened) check_written(bag_path, tl::unexpected(opened.error()));
    auto& file = *opened;
    run.begin("writing " + bag_path);
    try {
      Recording recording(file.part(), options, schedule.zero());
      record(take, schedule, camera, recording, run);
      recording.close();
    } catch (...) {
      file.discard();
      throw;
    }
    run.end();
    if (const auto published = file.publish(); !published) {
      check_written(bag_path, transport::refused_by_system(published.error()));
    }
    report(camera.statistics(), err);
    err << "trk: " << bag_path << ": " << camera.statistics().sequence.accepted << " fields of camera "
        << options.camera << ", from " << base::seconds_text(schedule.at(0)) << " at "
        << cli::number_text(options.field_rate) << " fields a second\n";
  } catch (const BagError& error) {
    throw BagError(take_path + ": " + error.what());
  } catch (const rosbag::BagException& error) {
    throw transport::TransportError(bag_path + ": cannot be written: " + error.what());
  }
}

}  // namespace trk_bridge::bag
