#include "trk/sender_layouts.h"

#include <gtest/gtest.h>

#include "udp.h"

namespace trk_bridge::trk {
namespace {

Sender sender(std::uint32_t port) {
  Sender s;
  s.kind = SenderKind::ipv4;
  s.address = {192, 0, 2, 7};
  s.number = port;
  return s;
}

constexpr wire::WireForm document{wire::Encoding::binary, {wire::Generation::document}};
constexpr wire::WireForm identified{wire::Encoding::binary, {wire::Generation::identified}};

/// Parameters that read alike in both generations.
std::string ambiguous() {
  wire::CameraParams p;
  p.matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1};
  p.counter = 5;
  return test::datagram(p, document);
}

wire::Generation generation_of(SenderLayouts& layouts, const Sender& of) {
  const auto decoded = layouts.decode(ambiguous(), of);
  if (!decoded) throw std::runtime_error(wire::describe(decoded.error()));
  return decoded->form.layout.generation;
}

TEST(SenderLayouts, RemembersWhatASenderTold) {
  SenderLayouts layouts({});
  ASSERT_TRUE(layouts.decode(test::datagram(test::constants(), document), sender(1)));
  ASSERT_TRUE(layouts.decode(test::datagram(test::constants(), identified), sender(2)));
  EXPECT_EQ(generation_of(layouts, sender(1)), wire::Generation::document);
  EXPECT_EQ(generation_of(layouts, sender(2)), wire::Generation::identified);
  EXPECT_EQ(generation_of(layouts, sender(1)), wire::Generation::document);
}

TEST(SenderLayouts, WhatWasSaidHoldsForAll) {
  SenderLayouts layouts({wire::Generation::document, {}, {}});
  EXPECT_EQ(generation_of(layouts, sender(1)), wire::Generation::document);
  EXPECT_EQ(generation_of(layouts, sender(2)), wire::Generation::document);
}

TEST(SenderLayouts, TheOneSilentLongestGivesWay) {
  SenderLayouts layouts({});
  for (std::uint32_t port = 0; port < SenderLayouts::capacity; ++port) {
    ASSERT_TRUE(layouts.decode(test::datagram(test::constants(), document), sender(port)));
  }
  EXPECT_EQ(generation_of(layouts, sender(0)), wire::Generation::document);
  ASSERT_TRUE(layouts.decode(test::datagram(test::constants(), document), sender(1000)));
  EXPECT_EQ(generation_of(layouts, sender(0)), wire::Generation::document) << "it was heard after 1";
  EXPECT_EQ(generation_of(layouts, sender(1000)), wire::Generation::document);
  EXPECT_EQ(generation_of(layouts, sender(1)), wire::Generation::identified) << "forgotten, so guessed";
}

TEST(SenderLayouts, RubbishPushesNobodyOut) {
  SenderLayouts layouts({});
  ASSERT_TRUE(layouts.decode(test::datagram(test::constants(), document), sender(0)));
  for (std::uint32_t port = 1; port <= 10 * SenderLayouts::capacity; ++port) {
    EXPECT_FALSE(layouts.decode("rubbish", sender(port)));
  }
  EXPECT_EQ(generation_of(layouts, sender(0)), wire::Generation::document);
}

}  // namespace
}  // namespace trk_bridge::trk
