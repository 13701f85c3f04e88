// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Conversion of records, calibrations and stamps to messages and back. Headers are left to the caller.
#pragma once

#include <cstdint>

#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>
#include <trk_bridge/LensEncoders.h>
#include <trk_bridge/TimeCode.h>

#include "trk_bridge/base/time_code.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/transport/sample.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::ros1 {

/// Field by field, in the units of the format of the record. Of matrix and Euler angles, the one that the format does
/// not select is zero.
void to_msg(const wire::CameraParams& params, trk_bridge::CameraParams& message);
void to_msg(const wire::CameraConstants& constants, trk_bridge::CameraConstants& message);

void to_msg(const base::TimeCodeWithRate& time_code, trk_bridge::TimeCode& message);

/// Unknown counts are 0.
void to_msg(std::uint32_t id, const transport::LensEncoders& encoders, trk_bridge::LensEncoders& message);

/// Size, model, D, K, R = identity, P = [K|0]; no binning, no region of interest. Allocates only when `message` is new
/// or its model changes to a longer one.
void to_msg(const camera::Calibration& calibration, sensor_msgs::CameraInfo& message);

/// Nanoseconds since 1970 UTC as a ROS time; 0, which means "no time" in ROS, for times before 1970 or after 2106.
::ros::Time to_time(std::int64_t nanoseconds) noexcept;
/// Nanoseconds since 1970 UTC; 0 for "no time" in ROS.
std::int64_t from_time(const ::ros::Time& time) noexcept;

/// The inverse, field by field. Headers are not used.
wire::CameraParams from_msg(const trk_bridge::CameraParams& message);
wire::CameraConstants from_msg(const trk_bridge::CameraConstants& message);
base::TimeCodeWithRate from_msg(const trk_bridge::TimeCode& message);

}  // namespace trk_bridge::ros1
