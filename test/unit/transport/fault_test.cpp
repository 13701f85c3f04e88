// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/transport/sample.h"

#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace trk_bridge::transport::fault_test {

static_assert(std::is_trivially_copyable_v<Fault>, "faults are handed over by value and counted in snapshots");

constexpr auto last_reason = wire::Reason::no_valid_layout;

std::vector<wire::Fault> every_fault_of_trk() {
  std::vector<wire::Fault> faults;
  for (int code = 0; code <= static_cast<int>(last_reason); ++code) {
    const auto reason = static_cast<wire::Reason>(code);
    faults.push_back({reason});
    for (const int field : {0, 1, 9, 255}) faults.push_back({reason, static_cast<std::uint8_t>(field), true});
  }
  return faults;
}

TEST(Fault, OfTrkKeepsItsNameFieldAndText) {
  for (const wire::Fault& of_trk : every_fault_of_trk()) {
    const Fault fault = of_trk;
    EXPECT_STREQ(fault.name(), wire::name(of_trk.reason));
    EXPECT_EQ(fault.field(), of_trk.about_field ? of_trk.field : -1) << fault.name();
    EXPECT_EQ(describe(fault), wire::describe(of_trk));
  }
  EXPECT_EQ(describe(Fault(wire::Fault{wire::Reason::not_a_number, 9, true})), "field 9 is not a number");
}

TEST(Fault, AreOrderedByReasonAndField) {
  const auto of_trk = every_fault_of_trk();
  const std::set<Fault> ordered(of_trk.begin(), of_trk.end());
  EXPECT_EQ(ordered.size(), of_trk.size()) << "no two of them are equal";
  const Fault early = wire::Fault{wire::Reason::truncated}, late = wire::Fault{wire::Reason::not_finite};
  const Fault third = wire::Fault{wire::Reason::not_finite, 3, true},
              ninth = wire::Fault{wire::Reason::not_finite, 9, true};
  EXPECT_TRUE(early < late && late < third && third < ninth);
  EXPECT_FALSE(late < early || third < late || ninth < third || ninth < ninth);
}

TEST(Fault, EqualFaultsAreEqualWhereverTheyComeFrom) {
  const Fault one = wire::Fault{wire::Reason::bad_magic};
  Fault other;
  EXPECT_NE(one, other);
  other = wire::Fault{wire::Reason::bad_magic};
  EXPECT_EQ(one, other);
  EXPECT_NE(one, Fault(wire::Fault{wire::Reason::bad_magic, 0, true})) << "one of them is about the id";
}

TEST(Fault, AProtocolHasItsOwnFaults) {
  const auto describe_own = [](const Fault& fault) {
    return "checksum of field " + std::to_string(fault.field()) + " is wrong, code " + std::to_string(fault.code());
  };
  const Fault own("bad checksum", describe_own, 0, 28);
  EXPECT_STREQ(own.name(), "bad checksum");
  EXPECT_EQ(own.code(), 0);
  EXPECT_EQ(describe(own), "checksum of field 28 is wrong, code 0");
  const Fault of_trk = wire::Fault{static_cast<wire::Reason>(0), 28, true};
  EXPECT_NE(own, of_trk) << "code and field are equal, the protocols are not";
  EXPECT_TRUE((own < of_trk) != (of_trk < own));
}

TEST(Fault, NoFaultIsDescribedAsNone) {
  const Fault none;
  EXPECT_STREQ(none.name(), "none");
  EXPECT_EQ(describe(none), "none");
  EXPECT_LT(none.field(), 0);
  EXPECT_EQ(none, Fault());
}

}  // namespace trk_bridge::transport::fault_test
