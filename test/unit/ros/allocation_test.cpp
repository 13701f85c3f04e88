// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The complete path of a sample, in and out, without roscpp: it allocates nothing, and a set is one system call.
#include <gmock/gmock.h>

#include "allocations.h"
#include "bridge/camera_pipeline.h"
#include "bridge/outlet_writer.h"
#include "bridge/params_to_trk.h"
#include "ros/camera_messages.h"
#include "system_calls.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"
#include "udp.h"

namespace trk_bridge::ros1::allocation_test {

constexpr int fields = 200;

wire::CameraConstants constants() { return {0, 1920, 1080, 0, 0, 0, 0, 9.59, 5.39, 9.59, 5.39}; }

wire::CameraParams params(int i) {
  wire::CameraParams params;
  params.counter = static_cast<std::uint64_t>(i);
  params.format = wire::euler | wire::field_of_view;
  params.euler = {1.25 + i, -2, 1.75, 30, -5.0 / 3, 0.25};
  // Some fields have a lens that plumb_bob cannot represent.
  params.fov = 40 + 0.01 * i;
  params.k1 = i % 2 == 0 ? -0.002 : -1e-4;
  return params;
}

TEST(Allocation, DoesNotHappenFromADatagramToMessages) {
  const auto source = endpoints::open_source("udp://127.0.0.1:0");
  const auto sink = endpoints::open_sink("udp://127.0.0.1:" + std::to_string(test::port_of(*source)));
  bridge::CameraOptions options;
  options.stamp = bridge::StampMode::counter;
  bridge::CameraPipeline pipeline(options, std::nullopt);
  CameraMessages messages({"a studio with a long name", "a camera with a long name", "its optical frame, as long"});
  ASSERT_TRUE(sink->write(constants()));
  transport::Reception reception;
  int made = 0;
  const auto count = test::allocations_of([&] {
    for (int i = 1; i <= fields; ++i) {
      // The sink sends its constants again once a second.
      if (!sink->write(params(i))) return;
      do {
        if (source->receive(reception, std::chrono::seconds(5)) != transport::Event::sample) return;
        const auto update = pipeline.process(reception.sample, i);
        messages.make(update);
        made += update.params && update.calibration && update.pose;
      } while (!std::holds_alternative<wire::CameraParams>(reception.sample.record));
    }
  });
  EXPECT_EQ(made, fields);
  EXPECT_EQ(messages.params()->counter, static_cast<std::uint64_t>(fields));
  EXPECT_EQ(count, 0u);
}

/// From messages to a UDP port, like ros_to_trk.
class WayOut {
 public:
  explicit WayOut(int port)
      : endpoint_(*endpoints::parse_sink("udp://127.0.0.1:" + std::to_string(port) + "?format=euler+field_of_view")),
        writer_(endpoint_.open(), endpoint_.form, bridge::Feed::one_camera) {
    trk_bridge::CameraConstants message;
    to_msg(constants(), message);
    sets_.use(from_msg(message));
    // With a new camera id.
    write(0);
  }

  void write(int i) {
    to_msg(params(i), message_);
    const auto set = sets_.use(from_msg(message_), std::int64_t{i});
    if (set.constants) writer_.write(*set.constants);
    writer_.write(set.params);
  }
  std::uint64_t sent() const { return writer_.statistics().sent.params; }

 private:
  const transport::SinkEndpoint endpoint_;
  bridge::OutletWriter writer_;
  bridge::ParamsToTrk sets_;
  trk_bridge::CameraParams message_;
};

TEST(Allocation, DoesNotHappenFromAMessageToADatagram) {
  const test::PlainSocket receiver;
  WayOut way(receiver.port());
  EXPECT_EQ(test::allocations_of([&] {
              for (int i = 1; i <= fields; ++i) way.write(i);
            }),
            0u);
  EXPECT_EQ(way.sent(), fields + 1u);
}

TEST(SystemCalls, OneFromAMessageToADatagram) {
  bool is_permitted = true;
  const auto calls = test::system_calls_of(
      [](const auto& counted) {
        const test::PlainSocket receiver;
        WayOut way(receiver.port());
        counted([&] {
          for (int i = 1; i <= fields; ++i) way.write(i);
        });
        return way.sent() == fields + 1u;
      },
      is_permitted);
  if (!is_permitted) GTEST_SKIP() << "tracing processes is not permitted here";
  ASSERT_TRUE(calls);
  // Constants are repeated once a second.
  EXPECT_GE(test::total(*calls), fields);
  EXPECT_LE(test::total(*calls), fields + 5);
}

}  // namespace trk_bridge::ros1::allocation_test
