#include "tf_input.h"

#include <tf2/exceptions.h>

#include "base/clock.h"
#include "ros/camera_info.h"
#include "trk_bridge/ros/frames.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {
namespace {

/// How often a tick looks again for a pose that is late.
constexpr int late_looks = 20;

}  // namespace

TfInput::TfInput(::ros::NodeHandle node, const ros1::RosToTrkParameters& parameters, SetWriter write)
    : write_(std::move(write)),
      parameters_(parameters),
      period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / parameters.rate))),
      gate_(parameters.studio_frame, parameters.camera_frame),
      sets_(parameters.tf),
      reporter_(parameters.name),
      sent_form_(parameters.form.format),
      tf_thread_(1, &tf_queue_) {
  const auto queue = static_cast<std::uint32_t>(parameters.queue_size);
  using TfEvent = ::ros::MessageEvent<const tf2_msgs::TFMessage>;
  auto tf_node = node;
  tf_node.setCallbackQueue(&tf_queue_);
  tf_ = tf_node.subscribe<tf2_msgs::TFMessage, const TfEvent&>(
      "/tf", queue, [this](const TfEvent& event) { receive(event, /*is_static=*/false); }, ::ros::VoidConstPtr(),
      no_delay());
  static_tf_ = tf_node.subscribe<tf2_msgs::TFMessage, const TfEvent&>(
      "/tf_static", queue, [this](const TfEvent& event) { receive(event, /*is_static=*/true); }, ::ros::VoidConstPtr(),
      no_delay());
  camera_info_ = node.subscribe<sensor_msgs::CameraInfo>(
      "camera_info", queue, [this](const sensor_msgs::CameraInfoConstPtr& message) { receive(*message); },
      ::ros::VoidConstPtr(), no_delay());
  lens_ = node.subscribe<trk_bridge::CameraParams>(
      "lens", queue,
      [this](const trk_bridge::CameraParamsConstPtr& message) {
        const std::lock_guard<std::mutex> lock(mutex_);
        sets_.use_lens(message->focdist, message->aperture);
      },
      ::ros::VoidConstPtr(), no_delay());
  sent_ = node.advertise<trk_bridge::CameraParams>("sent", queue);
  tf_thread_.start();
  thread_ = std::thread([this] { run(); });
}

TfInput::~TfInput() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
  tf_thread_.stop();
}

void TfInput::receive(const ::ros::MessageEvent<const tf2_msgs::TFMessage>& event, bool is_static) {
  const std::string& sender = event.getPublisherName();
  const auto ros_now = ros1::from_time(::ros::Time::now());
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& transform : event.getConstMessage()->transforms) {
    if (is_static) {
      gate_.add_static(transform.header.frame_id, transform.child_frame_id);
    } else if (!passes(transform, sender, ros_now)) {
      continue;
    }
    transforms_.setTransform(transform, sender, is_static);
  }
}

bool TfInput::passes(const geometry_msgs::TransformStamped& transform, const std::string& sender,
                     std::int64_t ros_now) {
  if (gate_.ros_time_went_back(ros_now)) start_over();
  const bridge::StampedLink link{transform.header.frame_id, transform.child_frame_id,
                                 ros1::from_time(transform.header.stamp), sender};
  const auto verdict = gate_.judge(link, ros_now, base::steady_now());
  if (verdict == bridge::TransformGate::Verdict::restart) start_over();
  return verdict != bridge::TransformGate::Verdict::refuse;
}

void TfInput::start_over() {
  transforms_.clear();
  sets_.restart();
}

void TfInput::receive(const sensor_msgs::CameraInfo& message) {
  const auto info = ros1::from_msg(message);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    sets_.use(info, ros1::from_time(message.header.stamp), base::steady_now());
  }
  changed_.notify_all();
}

bool TfInput::wait_until(Clock::time_point time) {
  std::unique_lock<std::mutex> lock(mutex_);
  return !changed_.wait_until(lock, time, [this] { return stopping_; });
}

void TfInput::run() {
  auto deadline = Clock::now();
  while (wait_until(deadline)) {
    deadline += period_;
    // A pose that comes a little late is this tick's. Left for the next one, it would cost one of two where tf comes at
    // our own rate.
    for (auto again = Clock::now(); !look();) {
      again += period_ / late_looks;
      if (again >= deadline) break;
      if (!wait_until(again)) return;
    }
    // Looks that were missed are left out: two at once would find the same pose.
    if (const auto now = Clock::now(); deadline < now) deadline += (now - deadline) / period_ * period_ + period_;
  }
}

TfInput::Pose TfInput::newest_pose() const {
  try {
    return transforms_.lookupTransform(parameters_.studio_frame, parameters_.camera_frame, ::ros::Time(0));
  } catch (const tf2::TransformException& error) {
    return tl::unexpected(std::string(error.what()));
  }
}

bool TfInput::look() {
  const auto ros_now = ros1::from_time(::ros::Time::now());
  Pose pose;
  std::optional<bridge::OutgoingSet> set;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    pose = newest_pose();
    pose_fault_ = pose ? std::string() : pose.error();
    if (!pose) return true;
    const auto stamp = ros1::from_time(pose->header.stamp);
    last_pose_ = stamp;
    if (!sets_.is_new(stamp)) return false;
    ahead_ = stamp == 0 || ros_now == 0 ? 0 : stamp - ros_now;
    const auto restarts = gate_.statistics().restarts;
    // tf and camera_info of one moment come on connections of their own.
    changed_.wait_for(lock, period_ / 4, [&] { return stopping_ || !sets_.expects_lens(stamp); });
    if (stopping_ || restarts != gate_.statistics().restarts) return true;
    set = sets_.make(ros1::to_isometry(pose->transform), stamp, base::steady_now());
  }
  if (!set) return true;
  write_(*set);
  publish(*set, pose->header);
  return true;
}

void TfInput::publish(const bridge::OutgoingSet& set, const std_msgs::Header& header) {
  // Constants that leave no picture are not given by the input.
  if (set.constants) static_cast<void>(sent_form_.use(*set.constants));
  auto converted = sent_form_.convert(set.params).params;
  // Sinks without a form of their own report why.
  if (!converted) return;
  converted->id = bridge::sent_id(parameters_.form, set.params.id);
  ros1::to_msg(*converted, sent_message_);
  sent_message_.header = header;
  sent_.publish(sent_message_);
}

bridge::Status TfInput::describe() {
  bridge::TfReport report;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    report.tf = sets_.statistics();
    report.pose_fault = pose_fault_;
    report.gate = gate_.statistics();
    report.last_pose = last_pose_;
    report.ahead = ahead_;
  }
  report.info_topic = camera_info_.getTopic();
  report.time = base::steady_now();
  return reporter_.status(std::move(report), parameters_.rate);
}

}  // namespace trk_bridge::nodes
