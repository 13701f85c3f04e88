#include "trk_bridge/transport/endpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "trk_bridge/transport/sink.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::transport {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

template <typename E>
E parsed(const std::string& url, Direction direction) {
  const auto endpoint = parse_endpoint(url, direction);
  if (!endpoint) {
    ADD_FAILURE() << endpoint.error();
    return {};
  }
  if (!std::holds_alternative<E>(*endpoint)) {
    ADD_FAILURE() << url << " became another kind of endpoint";
    return {};
  }
  return std::get<E>(*endpoint);
}

UdpEndpoint udp_in(const std::string& url) { return parsed<UdpEndpoint>(url, Direction::read); }
UdpEndpoint udp_out(const std::string& url) { return parsed<UdpEndpoint>(url, Direction::write); }
FileEndpoint file_in(const std::string& url) { return parsed<FileEndpoint>(url, Direction::read); }

std::string error_of(const std::string& url, Direction direction) {
  const auto endpoint = parse_endpoint(url, direction);
  return endpoint ? "no error" : endpoint.error();
}
std::string read_error(const std::string& url) { return error_of(url, Direction::read); }
std::string write_error(const std::string& url) { return error_of(url, Direction::write); }

TEST(Endpoint, UdpHostsAndPorts) {
  EXPECT_EQ(udp_in("udp://:7000").host, "");
  EXPECT_EQ(udp_in("udp://:7000").port, 7000);
  EXPECT_EQ(udp_in("udp://0.0.0.0:7000").host, "0.0.0.0");
  EXPECT_EQ(udp_in("udp://[::]:7000").host, "::");
  EXPECT_EQ(udp_in("udp://[fe80::1%25eth0]:7000").host, "fe80::1%eth0");
  EXPECT_EQ(udp_in("udp://tracker-3.studio:65535").host, "tracker-3.studio");
  EXPECT_EQ(udp_in("udp://tracker-3.studio:65535").port, 65535);
  EXPECT_EQ(udp_in("udp://127.0.0.1:0").port, 0) << "reading, the kernel may pick the port";
}

TEST(Endpoint, UdpReadingOptions) {
  const auto e = udp_in(
      "udp://239.1.2.3:7000?interface=127.0.0.1&allow=192.0.2.1,[::1],host&buffer=4194304&layout=document_i386_be");
  EXPECT_EQ(e.host, "239.1.2.3");
  EXPECT_EQ(e.interface, "127.0.0.1");
  EXPECT_THAT(e.allow, ElementsAre("192.0.2.1", "::1", "host"));
  EXPECT_EQ(e.buffer, 4194304);
  EXPECT_EQ(e.layout.generation, wire::Generation::document);
  EXPECT_EQ(e.layout.abi, wire::Abi::i386);
  EXPECT_EQ(e.layout.byte_order, wire::ByteOrder::big);
}

TEST(Endpoint, UdpWritingOptions) {
  const auto e = udp_out("udp://[ff15::7]:7000?binary=1&layout=identified&ttl=0&interface=eth0&constants_period=2.5");
  EXPECT_EQ(e.host, "ff15::7");
  EXPECT_TRUE(e.binary);
  EXPECT_EQ(e.layout.generation, wire::Generation::identified);
  EXPECT_FALSE(e.layout.abi.has_value());
  EXPECT_EQ(e.ttl, 0);
  EXPECT_EQ(e.interface, "eth0");
  EXPECT_EQ(e.constants_period, 2.5);
}

TEST(Endpoint, UdpDefaults) {
  const auto in = udp_in("udp://:7000");
  EXPECT_TRUE(in.allow.empty());
  EXPECT_FALSE(in.buffer.has_value());
  EXPECT_FALSE(in.layout.generation.has_value());
  const auto out = udp_out("udp://192.0.2.7:7000");
  EXPECT_FALSE(out.binary);
  EXPECT_FALSE(out.ttl.has_value());
  EXPECT_EQ(out.constants_period, 1.0);
}

TEST(Endpoint, UdpWrongHostsAndPorts) {
  EXPECT_THAT(read_error("udp://"), HasSubstr("no port"));
  EXPECT_THAT(read_error("udp://host"), AllOf(HasSubstr("udp://host"), HasSubstr("no port")));
  EXPECT_THAT(read_error("udp://:"), AllOf(HasSubstr("port = \"\""), HasSubstr("0 to 65535")));
  EXPECT_THAT(read_error("udp://:65536"), HasSubstr("port = \"65536\""));
  EXPECT_THAT(read_error("udp://:-1"), HasSubstr("port = \"-1\""));
  EXPECT_THAT(read_error("udp://:7000x"), HasSubstr("port = \"7000x\""));
  EXPECT_THAT(read_error("udp://:7000/"), HasSubstr("port = \"7000/\""));
  EXPECT_THAT(read_error("udp://::1:7000"), HasSubstr("[::1]:7000"));
  EXPECT_THAT(read_error("udp://[::1:7000"), HasSubstr("["));
  EXPECT_THAT(read_error("udp://[::1]7000"), HasSubstr("behind"));
  EXPECT_THAT(read_error("udp://a b:7000"), HasSubstr("a b"));
  EXPECT_THAT(read_error("udp:7000"), HasSubstr("udp://HOST:PORT"));
  EXPECT_THAT(write_error("udp://:7000"), HasSubstr("no host"));
  EXPECT_THAT(write_error("udp://host:0"), HasSubstr("1 to 65535"));
}

TEST(Endpoint, AnUnknownOptionListsTheKnownOfTheDirection) {
  EXPECT_THAT(
      read_error("udp://:7000?colour=red"),
      AllOf(HasSubstr("unknown option colour"), HasSubstr("allow, interface, layout, buffer"), Not(HasSubstr("ttl"))));
  EXPECT_THAT(write_error("udp://host:7000?colour=red"),
              AllOf(HasSubstr("interface, layout, binary, ttl, constants_period"), Not(HasSubstr("allow"))));
  EXPECT_THAT(write_error("shm:7?colour=red"), HasSubstr("layout, mode, recreate"));
  EXPECT_THAT(read_error("shm:7?colour=red"), HasSubstr("none"));
  EXPECT_THAT(read_error("file:a?colour=red"), HasSubstr("rate, speed, loop, time, date"));
  EXPECT_THAT(write_error("file:a?colour=red"), HasSubstr("timecode, overwrite"));
  EXPECT_THAT(read_error("memory:a?colour=red"), HasSubstr("none"));
}

TEST(Endpoint, AnOptionOfTheOtherDirectionIsToldAsSuch) {
  EXPECT_THAT(read_error("udp://:7000?ttl=3"), AllOf(HasSubstr("ttl is for writing"), HasSubstr("reading udp knows")));
  EXPECT_THAT(write_error("udp://h:7000?allow=h"), HasSubstr("allow is for reading"));
  EXPECT_THAT(read_error("shm:7?recreate=1"), HasSubstr("recreate is for writing"));
  EXPECT_THAT(read_error("file:a?overwrite=1"), HasSubstr("overwrite is for writing"));
  EXPECT_THAT(write_error("file:a?rate=50"), HasSubstr("rate is for reading"));
}

TEST(Endpoint, ABadValueNamesKeyValueAndWhatIsAllowed) {
  EXPECT_THAT(write_error("udp://h:1?ttl=256"), AllOf(HasSubstr("ttl"), HasSubstr("\"256\""), HasSubstr("0 to 255")));
  EXPECT_THAT(write_error("udp://h:1?ttl="), HasSubstr("ttl = \"\""));
  EXPECT_THAT(write_error("udp://h:1?binary=yes"), AllOf(HasSubstr("\"yes\""), HasSubstr("0 and 1")));
  EXPECT_THAT(write_error("udp://h:1?constants_period=-1"), HasSubstr("0 to 86400"));
  EXPECT_THAT(write_error("udp://h:1?constants_period=nan"), HasSubstr("\"nan\""));
  EXPECT_THAT(write_error("udp://h:1?constants_period=1s"), HasSubstr("\"1s\""));
  EXPECT_THAT(read_error("udp://:1?buffer=0"), HasSubstr("1 to 1073741823"));
  EXPECT_THAT(read_error("udp://:1?buffer=99999999999"), HasSubstr("\"99999999999\""));
  EXPECT_THAT(read_error("udp://:1?layout=klingon"), AllOf(HasSubstr("klingon"), HasSubstr("identified")));
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

TEST(Endpoint, MalformedOptions) {
  EXPECT_THAT(write_error("udp://h:1?ttl=1&ttl=2"), HasSubstr("ttl is given twice"));
  EXPECT_THAT(write_error("udp://h:1?ttl"), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(write_error("udp://h:1?=1"), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(write_error("udp://h:1?ttl=1&"), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(write_error("udp://h:1?ttl=%3"), HasSubstr("hexadecimal"));
  EXPECT_EQ(udp_in("udp://:7000?").port, 7000) << "no options behind ? is none";
}

TEST(Endpoint, ALayoutWithoutBinaryWouldCountForNothing) {
  EXPECT_THAT(write_error("udp://h:1?layout=identified"), HasSubstr("binary=1"));
  EXPECT_THAT(write_error("udp://h:1?layout=identified&binary=0"), HasSubstr("binary=1"));
}

TEST(Endpoint, SharedMemory) {
  const auto defaults = parsed<ShmEndpoint>("shm:0", Direction::write);
  EXPECT_EQ(defaults.slot, 0);
  EXPECT_EQ(defaults.mode, 0666);
  EXPECT_FALSE(defaults.recreate);
  const auto e = parsed<ShmEndpoint>("shm:61?mode=0640&recreate=1&layout=identified_i386", Direction::write);
  EXPECT_EQ(e.slot, 61);
  EXPECT_EQ(e.mode, 0640);
  EXPECT_TRUE(e.recreate);
  EXPECT_EQ(e.layout.abi, wire::Abi::i386);
  EXPECT_EQ(parsed<ShmEndpoint>("shm:7", Direction::read).slot, 7);
  for (const char* url : {"shm:", "shm:62", "shm:-1", "shm:A", "shm://7", "shm:7/"}) {
    EXPECT_THAT(read_error(url), AllOf(HasSubstr("slot = "), HasSubstr("0 to 61"))) << url;
  }
}

TEST(Endpoint, FilePaths) {
  EXPECT_EQ(file_in("file:take.trk").path, "take.trk");
  EXPECT_EQ(file_in("file:./a/take.trk").path, "./a/take.trk");
  EXPECT_EQ(file_in("file:/abs/take.trk").path, "/abs/take.trk");
  EXPECT_EQ(file_in("file:///abs/take.trk").path, "/abs/take.trk");
  EXPECT_EQ(file_in("file:what%3F%20100%25.trk?loop=1").path, "what? 100%.trk");
  EXPECT_EQ(file_in("file:a:b&c=d.trk").path, "a:b&c=d.trk");
  EXPECT_THAT(read_error("file:"), HasSubstr("no path"));
  EXPECT_THAT(read_error("file://host/take.trk"), HasSubstr("file:///PATH"));
  EXPECT_THAT(read_error("file:100%.trk"), HasSubstr("%25"));
  EXPECT_THAT(read_error("file:a%00b"), HasSubstr("%00"));
}

TEST(Endpoint, FileReadingOptions) {
  const auto defaults = file_in("file:a");
  EXPECT_FALSE(defaults.rate.has_value());
  EXPECT_EQ(defaults.speed, 1.0);
  EXPECT_FALSE(defaults.loop);
  EXPECT_EQ(defaults.time, FileTime::timecode);
  const auto e = file_in("file:a?rate=59.94&speed=0&loop=1&time=now&date=2024-02-29");
  EXPECT_EQ(e.rate, 59.94);
  EXPECT_EQ(e.speed, 0.0);
  EXPECT_TRUE(e.loop);
  EXPECT_EQ(e.time, FileTime::now);
  EXPECT_EQ(e.date, 1709164800) << "date -u -d 2024-02-29 +%s";
  EXPECT_EQ(file_in("file:a?date=1970-01-01").date, 0);
}

TEST(Endpoint, DatesThatTheCalendarDoesNotHave) {
  for (const char* date : {"2023-02-29", "2024-13-01", "2024-00-10", "2024-04-31", "24-04-30", "2024/04/30", "today"}) {
    EXPECT_THAT(read_error(std::string("file:a?date=") + date), AllOf(HasSubstr(date), HasSubstr("YYYY-MM-DD")));
  }
}

TEST(Endpoint, FileWritingOptions) {
  const auto e = parsed<FileEndpoint>("file:a?timecode=10:20:30:12:2&overwrite=1", Direction::write);
  EXPECT_EQ(e.timecode, "10:20:30:12:2");
  EXPECT_TRUE(e.overwrite);
  EXPECT_FALSE(parsed<FileEndpoint>("file:a", Direction::write).overwrite);
}

TEST(Endpoint, Memory) {
  EXPECT_EQ(parsed<MemoryEndpoint>("memory:camera%201", Direction::read).name, "camera 1");
  EXPECT_THAT(read_error("memory:"), HasSubstr("no name"));
}

TEST(Endpoint, Schemes) {
  for (const char* url : {"tcp://host:1", "UDP://:1", ":7000", "udpx://:1"}) {
    EXPECT_THAT(read_error(url), AllOf(HasSubstr("scheme"), HasSubstr("udp, shm and file"), Not(HasSubstr("memory"))))
        << url;
  }
  for (const char* url : {"", "host", "7000"}) EXPECT_THAT(read_error(url), HasSubstr("no scheme")) << url;
}

TEST(Endpoint, TheFactoryTellsAWrongUrlAsATransportError) {
  EXPECT_THROW((void)open_source("shm:99"), TransportError);
  EXPECT_THROW((void)open_sink("udp://:7000"), TransportError);
}

}  // namespace
}  // namespace trk_bridge::transport
