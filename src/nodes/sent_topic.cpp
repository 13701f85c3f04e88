// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "sent_topic.h"

#include <variant>

#include "base/clock.h"
#include "bridge/outlet_writer.h"
#include "trk_bridge/ros/messages.h"

namespace trk_bridge::nodes {

SentTopic::SentTopic(::ros::NodeHandle node, const ros1::RosToTrkParameters& parameters)
    : form_(parameters.form),
      converter_(parameters.form.format),
      messages_(ros1::in_frame<trk_bridge::CameraParams>(parameters.studio_frame)),
      topic_(node.advertise<trk_bridge::CameraParams>("sent", static_cast<std::uint32_t>(parameters.queue_size))) {}

void SentTopic::write(const wire::Record& record, std::int64_t time) {
  if (const auto* constants = std::get_if<wire::CameraConstants>(&record)) {
    // The input does not pass invalid constants.
    static_cast<void>(converter_.use(*constants));
    return;
  }
  const auto& params = std::get<wire::CameraParams>(record);
  ++statistics_.sets;
  statistics_.last = base::steady_now();
  statistics_.last_stamp = time;
  published_.store(statistics_);
  auto converted = converter_.convert(params).params;
  // The sinks report the reason.
  if (!converted) return;
  converted->id = bridge::sent_id(form_, params.id);
  auto& message = messages_.renew();
  ros1::to_msg(*converted, message);
  message.header.stamp = ros1::to_time(time);
  topic_.publish(messages_.current());
}

}  // namespace trk_bridge::nodes
