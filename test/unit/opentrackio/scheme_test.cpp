// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// URLs, and packets over the loopback.
#include "opentrackio/scheme.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "camera_records.h"
#include "packets.h"
#include "reserved_port.h"
#include "trk_bridge/endpoints/endpoints.h"
#include "udp.h"
#include "url_errors.h"

namespace trk_bridge::opentrackio::scheme_test {

using endpoints::open_sink;
using endpoints::open_source;
using test::read_error;
using test::write_error;
using testing::AllOf;
using testing::HasSubstr;

template <typename Settings>
Settings ok(const tl::expected<Settings, std::string>& settings) {
  if (!settings) throw std::runtime_error(settings.error());
  return *settings;
}

SourceSettings source_of(const std::string& url) { return ok(source_settings(*transport::split_url(url))); }
SinkSettings sink_of(const std::string& url) { return ok(sink_settings(*transport::split_url(url))); }

std::vector<std::string> hosts(const SourceSettings& settings) {
  std::vector<std::string> all;
  for (const auto& place : settings.places()) all.push_back(place.host);
  return all;
}

TEST(OpenTrackIoUrl, Reading) {
  EXPECT_EQ(source_of("opentrackio://").port, 55555);
  EXPECT_EQ(source_of("opentrackio://:6000").port, 6000);
  EXPECT_THAT(hosts(source_of("opentrackio://192.0.2.7")), testing::ElementsAre("192.0.2.7"));
  for (const char* url : {"opentrackio://?source=17", "opentrackio://239.135.1.17", "opentrackio://235.135.1.17"}) {
    EXPECT_THAT(hosts(source_of(url)), testing::ElementsAre("239.135.1.17", "235.135.1.17")) << url;
    EXPECT_EQ(endpoints::parse_source(url)->place, "udp://239.135.1.17:55555");
  }
  EXPECT_THAT(hosts(source_of("opentrackio://239.135.1.0")), testing::ElementsAre("239.135.1.0"));
  EXPECT_TRUE(source_of("opentrackio://?source=any").takes_any);
  EXPECT_EQ(source_of("opentrackio://?tai_offset=36").tai_offset, 36);
  EXPECT_EQ(source_of("opentrackio://?source=3&interface=lo&allow=192.0.2.7").interface, "lo");

  EXPECT_THAT(read_error("opentrackio://?source=201"), AllOf(HasSubstr("source = \"201\""), HasSubstr("1 to 200")));
  EXPECT_THAT(read_error("opentrackio://192.0.2.7?source=3"), HasSubstr("remove one of them"));
  EXPECT_THAT(read_error("opentrackio://:0?source=3"),
              AllOf(HasSubstr("source = \"3\""), HasSubstr("a port other than 0")));
  EXPECT_THAT(read_error("opentrackio://?tai_offset=x"), HasSubstr("tai_offset"));
  EXPECT_THAT(read_error("opentrackio://?profile=unreal"), HasSubstr("is for writing"));
  EXPECT_THAT(read_error("opentrackio://?sources=3"), HasSubstr("unknown option sources"));
}

TEST(OpenTrackIoUrl, Writing) {
  const SinkSettings plain = sink_of("opentrackio://192.0.2.7?");
  EXPECT_EQ(plain.port, 55555);
  EXPECT_EQ(plain.constants_period, 2.0);
  EXPECT_EQ(plain.writer.source, 0U);
  EXPECT_EQ(plain.encoding, Encoding::json);
  EXPECT_EQ(plain.writer.profile, Profile::generic);
  EXPECT_EQ(plain.source_id, sink_of("opentrackio://192.0.2.7?encoding=cbor").source_id) << "the same at every start";
  EXPECT_NE(plain.source_id, sink_of("opentrackio://192.0.2.8").source_id);
  EXPECT_THAT(plain.source_id, testing::MatchesRegex("urn:uuid:[0-9a-f]{8}-[0-9a-f]{4}-8[0-9a-f]{3}-[89ab][0-9a-f]{3}-"
                                                     "[0-9a-f]{12}"));
  EXPECT_EQ(sink_of("opentrackio://?source=17").host, "239.135.1.17");
  EXPECT_EQ(sink_of("opentrackio://:6000?source=17").port, 6000);
  EXPECT_EQ(sink_of("opentrackio://239.135.1.17").writer.source, 17U);
  const SinkSettings all = sink_of(
      "opentrackio://192.0.2.7?source=3&encoding=cbor&profile=unreal&distortion=U-D&rate=59.94&tai_offset=0&"
      "source_id=5e1f0a6c-0000-8000-8000-000000000001&ttl=4&constants_period=1");
  EXPECT_EQ(all.writer.source, 3U);
  EXPECT_EQ(all.encoding, Encoding::cbor);
  EXPECT_EQ(all.writer.profile, Profile::unreal);
  EXPECT_EQ(all.writer.model, Model::undistorted_to_distorted);
  EXPECT_EQ(all.writer.rate, 59.94);
  EXPECT_EQ(all.writer.tai_offset, 0);
  EXPECT_EQ(all.source_id, "urn:uuid:5e1f0a6c-0000-8000-8000-000000000001");

  EXPECT_THAT(write_error("opentrackio://"), HasSubstr("source=N"));
  EXPECT_THAT(write_error("opentrackio://?source=0"), HasSubstr("source = \"0\""));
  EXPECT_THAT(write_error("opentrackio://192.0.2.7?source=any"), HasSubstr("source = \"any\""));
  EXPECT_THAT(write_error("opentrackio://192.0.2.7?encoding=xml"), HasSubstr("json and cbor"));
  EXPECT_THAT(write_error("opentrackio://192.0.2.7?profile=unity"), HasSubstr("generic and unreal"));
  EXPECT_THAT(write_error("opentrackio://192.0.2.7?distortion=none"), HasSubstr("D-U and U-D"));
  EXPECT_THAT(write_error("opentrackio://192.0.2.7?rate=0"), HasSubstr("1 to 1000"));
  EXPECT_THAT(write_error("opentrackio://192.0.2.7?source_id=5"), HasSubstr("UUID"));
}

TEST(OpenTrackIo, UnicastBothEncodings) {
  for (const char* encoding : {"json", "cbor"}) {
    const auto source = open_source("opentrackio://127.0.0.1:0");
    const auto sink =
        open_sink("opentrackio://127.0.0.1:" + std::to_string(test::port_of(*source)) + "?encoding=" + encoding);
    ASSERT_TRUE(sink->write(test::constants(720, 5)));
    for (std::uint64_t i = 1; i <= 3; ++i) ASSERT_TRUE(sink->write(test::params(i, 5), {1'000'000'000}));
    transport::Reception reception;
    ASSERT_EQ(test::next(*source, reception), transport::Event::sample);
    EXPECT_EQ(std::get<wire::CameraConstants>(reception.sample.record), test::constants(720, 5));
    for (std::uint64_t i = 1; i <= 3; ++i) {
      ASSERT_EQ(test::next(*source, reception), transport::Event::sample);
      EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record), test::params(i, 5));
      EXPECT_EQ(reception.sample.sample_time, 1'000'000'000);
    }
  }
}

TEST(OpenTrackIo, BothGroupsAreReceivedAndAMessageOfBothIsCountedOnce) {
  const test::ReservedPort port;
  const auto source = open_source("opentrackio://:" + port.text() + "?source=77&interface=127.0.0.1");
  EXPECT_THAT(source->name(), AllOf(HasSubstr("239.135.1.77"), HasSubstr("235.135.1.77")));
  const auto through = [&port](const std::string& group) {
    return open_sink("opentrackio://" + group + ":" + port.text() +
                     "?interface=127.0.0.1&ttl=0&source=77&"
                     "source_id=5e1f0a6c-0000-8000-8000-000000000001");
  };
  const auto now = through("239.135.1.77"), before = through("235.135.1.77");
  transport::Reception reception;
  for (std::uint64_t i = 1; i <= 5; ++i) {
    ASSERT_TRUE((i % 2 == 0 ? now : before)->write(test::params(i, 77)));
    EXPECT_EQ(test::next_counter(*source), i);
  }
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds::zero()), transport::Event::idle);
  // The identical packet through both groups.
  const test::PlainSocket tracker;
  const in_addr loopback{htonl(INADDR_LOOPBACK)};
  ASSERT_EQ(::setsockopt(tracker.fd(), IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback), 0);
  auto sample = test::full_sample();
  sample["sourceNumber"] = 77;
  sample.erase("static");
  for (const char* group : {"239.135.1.77", "235.135.1.77"}) {
    tracker.send(test::packet_of(sample.dump()), group, port.number());
  }
  EXPECT_EQ(test::next_counter(*source), 65535U);
  ASSERT_TRUE(now->write(test::params(6, 77)));
  EXPECT_EQ(test::next_counter(*source), 6U) << "and not the other copy";
  EXPECT_EQ(source->statistics().malformed, 0U);
  source->stop();
  EXPECT_EQ(source->receive(reception, std::chrono::nanoseconds(-1)), transport::Event::stopped);
}

}  // namespace trk_bridge::opentrackio::scheme_test
