// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/endpoints/endpoints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "endpoints/schemes.h"
#include "trk_bridge/wire/format.h"
#include "url_errors.h"

namespace trk_bridge::endpoints::endpoints_test {

using test::read_error;
using test::write_error;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Endpoints, SuggestsWhatWasProbablyMeant) {
  EXPECT_THAT(read_error("/takes/crane.trk"), HasSubstr("did you mean file:/takes/crane.trk?"));
  EXPECT_THAT(read_error("crane.trk?loop=1"), HasSubstr("did you mean file:crane.trk?loop=1?"));
  EXPECT_THAT(write_error("takes/a:b.trk"), HasSubstr("did you mean file:takes/a:b.trk?"));
  EXPECT_THAT(read_error("7"), HasSubstr("did you mean shm:7?"));
  EXPECT_THAT(read_error("7000"), HasSubstr("did you mean udp://:7000?"));
  EXPECT_THAT(read_error(":7000"), HasSubstr("did you mean udp://:7000?"));
  EXPECT_THAT(write_error("192.0.2.7:7000"), HasSubstr("did you mean udp://192.0.2.7:7000?"));
  EXPECT_THAT(write_error("[::1]:7000"), HasSubstr("did you mean udp://[::1]:7000?"));
  EXPECT_THAT(read_error("upd://:7000"), HasSubstr("did you mean udp://:7000?"));
  EXPECT_THAT(read_error("carrier_pigeon://coop:7000"),
              AllOf(Not(HasSubstr("did you mean")), HasSubstr("allowed are udp://HOST:PORT, ")));
}

/// A place that is valid for the scheme.
std::string place_of(const transport::Scheme& scheme) {
  if (scheme.name == "shm") return "shm:7";
  if (scheme.name == "file") return "file:take.trk";
  return prefix_of(scheme) + "127.0.0.1:7000";
}

TEST(Endpoints, HelpNamesTheOptionsThatAreRead) {
  for (const auto* scheme : schemes()) {
    for (const auto direction : {transport::Direction::read, transport::Direction::write}) {
      const bool reads = direction == transport::Direction::read;
      for (const auto& option : scheme->options(direction)) {
        const std::string url = place_of(*scheme) + '?' + std::string(option.key) + "=%01";
        const std::string error = reads ? read_error(url) : write_error(url);
        EXPECT_THAT(error, Not(HasSubstr("unknown option"))) << url;
        EXPECT_FALSE(option.help.empty()) << url;
        // Any text may be the name of a file, a host or an interface.
        if (option.key == "lens" || option.key == "allow" || option.key == "interface") continue;
        EXPECT_THAT(error, HasSubstr("allowed are " + std::string(option.allowed))) << url;
      }
      const std::string unknown = place_of(*scheme) + "?colour=red";
      const std::string error = reads ? read_error(unknown) : write_error(unknown);
      for (const auto& option : scheme->options(direction)) EXPECT_THAT(error, HasSubstr(std::string(option.key)));
    }
  }
}

TEST(Endpoints, AnUnknownOptionListsTheKnownOfTheDirection) {
  EXPECT_THAT(
      read_error("udp://:7000?colour=red"),
      AllOf(HasSubstr("unknown option colour"), HasSubstr("allow, interface, buffer, layout"), Not(HasSubstr("ttl"))));
  EXPECT_THAT(write_error("udp://host:7000?colour=red"),
              AllOf(HasSubstr("interface, ttl, constants_period, layout, binary"), Not(HasSubstr("allow"))));
  EXPECT_THAT(write_error("shm:7?colour=red"), HasSubstr("layout, mode, recreate"));
  EXPECT_THAT(read_error("shm:7?colour=red"), HasSubstr("none"));
  EXPECT_THAT(read_error("file:a?colour=red"), HasSubstr("rate, speed, loop, time, date"));
  EXPECT_THAT(write_error("file:a?colour=red"), HasSubstr("timecode, rate, number, overwrite"));
  EXPECT_THAT(write_error("shm:7?colour=red"), HasSubstr("format, preset, id, delay, lead"));
  EXPECT_THAT(read_error("udp://:7000?format=euler"), HasSubstr("format is for writing"));
}

TEST(Endpoints, AnOptionOfTheOtherDirectionIsReportedAsSuch) {
  EXPECT_THAT(read_error("udp://:7000?ttl=3"),
              AllOf(HasSubstr("ttl is for writing"), HasSubstr("the options for reading udp are")));
  EXPECT_THAT(write_error("udp://h:7000?allow=h"), HasSubstr("allow is for reading"));
  EXPECT_THAT(read_error("shm:7?recreate=1"), HasSubstr("recreate is for writing"));
  EXPECT_THAT(read_error("file:a?overwrite=1"), HasSubstr("overwrite is for writing"));
  EXPECT_THAT(write_error("file:a?speed=2"), HasSubstr("speed is for reading"));
}

TEST(Endpoints, ABadValueNamesKeyValueAndWhatIsAllowed) {
  EXPECT_THAT(write_error("udp://h:1?ttl=256"), AllOf(HasSubstr("ttl"), HasSubstr("\"256\""), HasSubstr("0 to 255")));
  EXPECT_THAT(write_error("udp://h:1?ttl="), HasSubstr("ttl = \"\""));
  EXPECT_THAT(write_error("udp://h:1?binary=yes"), AllOf(HasSubstr("\"yes\""), HasSubstr("0 and 1")));
  EXPECT_THAT(write_error("udp://h:1?constants_period=-1"), HasSubstr("0 to 86400"));
  EXPECT_THAT(write_error("udp://h:1?constants_period=nan"), HasSubstr("\"nan\""));
  EXPECT_THAT(write_error("udp://h:1?constants_period=1s"), HasSubstr("\"1s\""));
  EXPECT_THAT(read_error("udp://:1?buffer=0"), HasSubstr("1 to 1073741823"));
  EXPECT_THAT(read_error("udp://:1?buffer=99999999999"), HasSubstr("\"99999999999\""));
  EXPECT_THAT(read_error("udp://:1?layout=klingon"),
              AllOf(HasSubstr("\"klingon\""), HasSubstr("identified"), HasSubstr("_llp64")));
  EXPECT_THAT(read_error("udp://:1?allow=a,,b"), HasSubstr("\"a,,b\""));
  EXPECT_THAT(read_error("udp://:1?allow="), HasSubstr("allow"));
  EXPECT_THAT(read_error("udp://:1?allow=[]"), HasSubstr("\"[]\""));
  EXPECT_THAT(read_error("udp://:1?interface="), HasSubstr("interface"));
  EXPECT_THAT(write_error("shm:7?mode=0888"), HasSubstr("octal"));
  EXPECT_THAT(write_error("shm:7?mode=1000"), HasSubstr("0777"));
  EXPECT_THAT(read_error("file:a?rate=0"), HasSubstr("rate"));
  EXPECT_THAT(read_error("file:a?speed=-2"), HasSubstr("speed"));
  EXPECT_THAT(read_error("file:a?time=later"), HasSubstr("timecode and now"));
  EXPECT_THAT(write_error("file:a?timecode=25"), HasSubstr("HH:MM:SS:FF:D"));
}

TEST(Endpoints, MalformedOptions) {
  EXPECT_THAT(write_error("udp://h:1?ttl=1&ttl=2"), HasSubstr("ttl is given twice"));
  EXPECT_THAT(write_error("udp://h:1?ttl"), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(write_error("udp://h:1?=1"), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(write_error("udp://h:1?ttl=1&"), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(write_error("udp://h:1?ttl=%3"), HasSubstr("hexadecimal"));
  EXPECT_EQ(read_error("udp://:7000?"), "no error") << "no options after ?";
}

TEST(Endpoints, Schemes) {
  for (const char* url : {"tcp://host:1", "memory:queue", "UDP://:1", ":7000", "udpx://:1"}) {
    EXPECT_THAT(read_error(url),
                AllOf(HasSubstr("scheme"),
                      HasSubstr("udp://HOST:PORT, freed://HOST:PORT, opentrackio://HOST:PORT, shm:SLOT and file:PATH")))
        << url;
  }
  for (const char* url : {"", "host", "7000"}) EXPECT_THAT(read_error(url), HasSubstr("no scheme")) << url;
}

TEST(Endpoints, AWrongUrlIsATransportError) {
  EXPECT_THROW((void)open_source("shm:99"), transport::TransportError);
  EXPECT_THROW((void)open_sink("udp://:7000"), transport::TransportError);
}

TEST(Endpoints, SinksOfEverySchemeHaveAForm) {
  for (const std::string url : {"udp://192.0.2.7:7000?ttl=3&", "shm:7?", "file:take.trk?overwrite=1&"}) {
    const auto words = parse_sink(url + "format=euler,field_of_view+vertical&id=7");
    ASSERT_TRUE(words) << words.error();
    EXPECT_EQ(words->form.format, wire::euler | wire::field_of_view | wire::vertical);
    EXPECT_EQ(words->form.id, 7u);
    EXPECT_TRUE(words->form.sends_id);
    const auto preset = parse_sink(url + "preset=unreal_trackmen");
    ASSERT_TRUE(preset) << preset.error();
    EXPECT_EQ(preset->form.format, std::uint32_t{wire::euler});
    EXPECT_FALSE(preset->form.sends_id);
    const auto none = parse_sink(url.substr(0, url.size() - 1));
    ASSERT_TRUE(none) << none.error();
    EXPECT_FALSE(none->form.format || none->form.id);
  }
}

TEST(Endpoints, SinksOfEverySchemeHaveADelay) {
  using transport::Delay;
  for (const std::string url : {"udp://192.0.2.7:7000?ttl=3&", "shm:7?", "file:take.trk?overwrite=1&"}) {
    const auto one = parse_sink(url + "delay=0.04&lead=0.0125");
    ASSERT_TRUE(one) << one.error();
    EXPECT_EQ(one->form.delay, (Delay{40'000'000, 40'000'000, 40'000'000}));
    EXPECT_EQ(one->form.lead, 12'500'000);
    EXPECT_TRUE(one->form.is_timed());
    EXPECT_EQ(parse_sink(url + "delay=0.04,0.02,0")->form.delay, (Delay{40'000'000, 20'000'000, 0}));
    EXPECT_FALSE(parse_sink(url + "delay=0&lead=0")->form.is_timed());
  }
}

TEST(Endpoints, AWrongDelayNamesTheRange) {
  for (const std::string value : {"-0.01", "1.01", "40ms", "", "nan", "0.04,0.02", "0.1,0.1,0.1,0.1", "0,0,2"}) {
    EXPECT_THAT(write_error("shm:7?delay=" + value),
                AllOf(HasSubstr("delay = \"" + value + "\""), HasSubstr("0 to 1 seconds")));
  }
  for (const std::string value : {"-0.01", "0.041", "x"}) {
    EXPECT_THAT(write_error("shm:7?lead=" + value),
                AllOf(HasSubstr("lead = \"" + value + "\""), HasSubstr("0 to 0.04 seconds")));
  }
  EXPECT_THAT(read_error("udp://:7000?delay=0.04"), HasSubstr("delay is for writing"));
}

TEST(Endpoints, AWrongFormNamesKeyValueAndAllowed) {
  EXPECT_THAT(write_error("shm:7?format=eulr"), AllOf(HasSubstr("format = \"eulr\""), HasSubstr("euler")));
  EXPECT_EQ(parse_sink("shm:7?format=vertical,diagonal")->form.format, std::uint32_t{wire::diagonal})
      << "the last of opposite words is used";
  EXPECT_THAT(write_error("shm:7?preset=unrael"), AllOf(HasSubstr("'unrael'"), HasSubstr("unreal_trackmen")));
  EXPECT_THAT(write_error("shm:7?preset=unreal_trackmen&format=euler"),
              HasSubstr("must not be given together with format"));
  EXPECT_THAT(write_error("shm:7?id=-1"), AllOf(HasSubstr("id = \"-1\""), HasSubstr("0 to 4294967295")));
  EXPECT_THAT(write_error("shm:7?preset=unreal_trackmen&id=3"), HasSubstr("sends no id"));
}

TEST(Endpoints, OptionsThatAFormDoesNotSetHaveDefaults) {
  transport::SinkForm defaults;
  defaults.format = wire::euler | wire::field_of_view;
  defaults.sends_id = false;
  defaults.id = 5;
  const auto form = transport::with_defaults(parse_sink("shm:7?format=matrix")->form, defaults);
  EXPECT_EQ(form.format, 0u);
  EXPECT_TRUE(form.sends_id) << "it belongs to the default's format";
  EXPECT_EQ(form.id, 5u);
  const auto by_id = transport::with_defaults(parse_sink("shm:7?id=9")->form, defaults);
  EXPECT_EQ(by_id.format, defaults.format);
  EXPECT_FALSE(by_id.sends_id);
  EXPECT_EQ(by_id.id, 9u);
  defaults.delay = transport::Delay{1, 2, 3};
  defaults.lead = 4;
  EXPECT_EQ(transport::with_defaults(parse_sink("shm:7?format=matrix")->form, defaults).delay, defaults.delay);
  EXPECT_EQ(transport::with_defaults(parse_sink("shm:7")->form, defaults).lead, 4);
  EXPECT_EQ(transport::with_defaults(parse_sink("shm:7?delay=0")->form, defaults).delay, transport::Delay{});
}

TEST(Endpoints, OnlyATakeReadAtFullSpeedCanWait) {
  EXPECT_TRUE(parse_source("file:a?speed=0&loop=1")->can_wait);
  EXPECT_TRUE(parse_source("udp://:7000")->over_network);
  EXPECT_FALSE(parse_source("shm:7")->over_network || parse_source("file:a")->over_network);
  for (const char* url : {"file:a", "file:a?speed=1000", "udp://:7000", "shm:7"}) {
    EXPECT_FALSE(parse_source(url)->can_wait) << url;
  }
}

TEST(Endpoints, EqualPlacesAreThoseThatOnlyOneSourceCanRead) {
  EXPECT_EQ(parse_source("udp://:7000?allow=192.0.2.1")->place, parse_source("udp://:7000")->place);
  EXPECT_NE(parse_source("udp://:7001")->place, parse_source("udp://:7000")->place);
  EXPECT_EQ(parse_source("file:////net/take.trk")->place, "file:////net/take.trk") << "a URL that can be read again";
  EXPECT_EQ(parse_source("shm:7")->url, "shm:7");
}

}  // namespace trk_bridge::endpoints::endpoints_test
