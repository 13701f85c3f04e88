// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The parameters of delay_meter: defaults, and errors that name the key, the value and what is allowed.
#include "ros/delay_meter_parameters.h"

#include <gmock/gmock.h>

#include "error_of.h"
#include "ros/parameter_reader.h"

namespace trk_bridge::ros1::delay_meter_parameters_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(DelayMeterParameters, NoneAreNeeded) {
  const auto parameters = read_delay_meter_parameters({}, "crane");
  EXPECT_EQ(parameters.name, "crane");
  EXPECT_EQ(parameters.window, 15);
  EXPECT_EQ(parameters.most_delay, 0.5);
  EXPECT_FALSE(parameters.field_rate);
  EXPECT_FALSE(parameters.constants);
}

TEST(DelayMeterParameters, AreRead) {
  XmlRpc::XmlRpcValue tree;
  tree["window"] = 8;
  tree["most_delay"] = 0.2;
  tree["field_rate"] = 59.94;
  tree["image_transport"] = "compressed";
  const auto parameters = read_delay_meter_parameters(tree, "crane");
  EXPECT_EQ(parameters.window, 8);
  EXPECT_EQ(parameters.most_delay, 0.2);
  EXPECT_EQ(parameters.field_rate, 59.94);
}

TEST(DelayMeterParameters, EveryFaultIsShown) {
  XmlRpc::XmlRpcValue tree;
  tree["window"] = 1;
  tree["most_delay"] = "much";
  tree["field_rat"] = 50;
  EXPECT_THAT(test::error_of<ParameterError>([&] { (void)read_delay_meter_parameters(tree, "crane"); }),
              AllOf(HasSubstr("~window = 1: must be 4 to 120 seconds"), HasSubstr("~most_delay = 'much'"),
                    HasSubstr("nearest is field_rate")));
}

}  // namespace trk_bridge::ros1::delay_meter_parameters_test
