// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Free-D through its URLs: options, sources, sinks.
#include <gmock/gmock.h>

#include <fstream>

#include "freed/scheme.h"
#include "freed_messages.h"
#include "temporary_directory.h"
#include "udp.h"
#include "url_errors.h"

namespace trk_bridge::freed::stream_test {

using endpoints::open_sink;
using endpoints::open_source;
using test::read_error;
using test::write_error;
using testing::AllOf;
using testing::HasSubstr;
using transport::Event;
using transport::Reception;

SourceSettings freed_in(const std::string& url) {
  const auto settings = source_settings(transport::split_url(url).value());
  if (!settings) ADD_FAILURE() << settings.error();
  return settings.value_or(SourceSettings{});
}

TEST(FreeDUrl, ReadingOptions) {
  EXPECT_EQ(freed_in("freed://:40000").profile, Profile::generic);
  EXPECT_FALSE(freed_in("freed://:40000").lenient);
  EXPECT_EQ(freed_in("freed://:40000").table, nullptr);
  const auto e = freed_in("freed://239.1.2.3:6301?interface=127.0.0.1&profile=zcam&checksum=lenient&allow=192.0.2.1");
  EXPECT_EQ(e.host, "239.1.2.3");
  EXPECT_EQ(e.port, 6301);
  EXPECT_EQ(e.profile, Profile::zcam);
  EXPECT_TRUE(e.lenient);
  EXPECT_EQ(endpoints::parse_source("freed://:7000")->place, endpoints::parse_source("udp://:7000")->place)
      << "only one source can read a port";
}

TEST(FreeDUrl, WhatIsWrongIsNamed) {
  EXPECT_THAT(read_error("freed://:40000?profile=viz"),
              HasSubstr("option profile = \"viz\": allowed are generic, sony, zcam, vizrt and mosys"));
  EXPECT_THAT(read_error("freed://:40000?checksum=1"), HasSubstr("allowed are strict and lenient"));
  EXPECT_THAT(read_error("freed://:40000?unwrap=1"),
              HasSubstr("option unwrap is for writing: the options for reading freed are"));
  EXPECT_THAT(write_error("freed://127.0.0.1:40000?checksum=lenient&lens=none"), HasSubstr("is for reading"));
  EXPECT_THAT(read_error("freed://:40000?lens=/nowhere/lens.yaml"),
              HasSubstr("option lens: /nowhere/lens.yaml: cannot be read"));
  EXPECT_THAT(write_error("freed://127.0.0.1:40000"), HasSubstr("option lens is missing"));
  EXPECT_EQ(write_error("freed://127.0.0.1:40000?lens=none"), "no error");
  EXPECT_EQ(write_error("freed://127.0.0.1:40000?profile=zcam"), "no error");
  EXPECT_THAT(write_error("freed://127.0.0.1:40000?lens=none&constants_period=1"), HasSubstr("no constants to repeat"));
  EXPECT_THAT(read_error("ftp:x"), HasSubstr("freed://HOST:PORT"));
}

TEST(FreeDUrl, AnErrorOfALensTableNamesTheRow) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory / "lens.yaml") << "points:\n- {zoom: 0, focal_length: 8}\n- {zoom: 0, focal_length: 9}\n";
  EXPECT_THAT(read_error("freed://:40000?lens=" + std::string(directory / "lens.yaml")),
              AllOf(HasSubstr("lens.yaml:3: "), HasSubstr("zoom 0: must be more than that of the row before")));
}

TEST(FreeDStream, ASourceReadsWhatASinkSends) {
  const auto source = open_source("freed://127.0.0.1:0?profile=zcam");
  const auto sink = open_sink("freed://127.0.0.1:" + std::to_string(test::port_of(*source)) + "?profile=zcam");
  ASSERT_TRUE(sink->write(test::constants(720, 7)));
  auto params = test::params(5, 7);
  params.aperture = 4;
  ASSERT_TRUE(sink->write(params));
  Reception reception;
  ASSERT_EQ(test::next(*source, reception), Event::sample);
  params.counter = 0;
  EXPECT_EQ(std::get<wire::CameraParams>(reception.sample.record), params)
      << "exact: all values are multiples of the units";
  const auto refused = sink->write(test::params(6));
  ASSERT_FALSE(refused);
  EXPECT_THAT(transport::describe(refused.error()), HasSubstr("camera number"));
}

TEST(FreeDStream, DoubtfulRecordsAreCounted) {
  const auto source = open_source("freed://127.0.0.1:0?checksum=lenient");
  const test::PlainSocket tracker;
  std::string zero = test::worked_message();
  zero.back() = 0;
  Reception reception;
  for (const std::string& datagram : {test::worked_message(), zero, std::string("\xD2")}) {
    tracker.send(datagram, "127.0.0.1", test::port_of(*source));
    (void)test::next(*source, reception);
  }
  const auto statistics = source->statistics();
  EXPECT_EQ(statistics.records, 2u);
  EXPECT_EQ(statistics.malformed, 1u);
  EXPECT_EQ(statistics.doubtful, 1u);
  EXPECT_STREQ(statistics.last_doubt, "wrong checksum");
}

}  // namespace trk_bridge::freed::stream_test
