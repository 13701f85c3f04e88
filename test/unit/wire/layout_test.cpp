// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/wire/layout.h"

#include <gmock/gmock.h>

namespace trk_bridge::wire::layout_test {

TEST(Layout, SizesAreThoseOfTheWireFormat) {
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    for (const Abi abi : {Abi::lp64, Abi::llp64}) {
      EXPECT_EQ(params_size({Generation::document, abi, order}), 200U);
      EXPECT_EQ(params_size({Generation::identified, abi, order}), 200U);
      EXPECT_EQ(constants_size({Generation::document, abi, order}), 56U);
      EXPECT_EQ(constants_size({Generation::identified, abi, order}), 64U);
    }
    EXPECT_EQ(params_size({Generation::document, Abi::i386, order}), 192U);
    EXPECT_EQ(params_size({Generation::identified, Abi::i386, order}), 196U);
    EXPECT_EQ(constants_size({Generation::document, Abi::i386, order}), 56U);
    EXPECT_EQ(constants_size({Generation::identified, Abi::i386, order}), 60U);
  }
}

TEST(Layout, IsDescribed) {
  EXPECT_EQ(describe(Layout{Generation::identified, Abi::lp64, ByteOrder::little}), "identified lp64 little-endian");
  EXPECT_EQ(describe(Layout{Generation::document, Abi::i386, ByteOrder::big}), "document i386 big-endian");
}

TEST(LayoutChoice, Words) {
  const auto automatic = layout_choice_from_word("auto");
  ASSERT_TRUE(automatic);
  EXPECT_FALSE(automatic->generation || automatic->abi || automatic->byte_order);

  const auto document = layout_choice_from_word("document");
  ASSERT_TRUE(document);
  EXPECT_EQ(document->generation, Generation::document);
  EXPECT_FALSE(document->abi || document->byte_order);

  const auto windows = layout_choice_from_word("identified_llp64");
  ASSERT_TRUE(windows);
  EXPECT_EQ(windows->generation, Generation::identified);
  EXPECT_EQ(windows->abi, Abi::llp64);
  EXPECT_FALSE(windows->byte_order);

  const auto whole = layout_choice_from_word("document_i386_be");
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->generation, Generation::document);
  EXPECT_EQ(whole->abi, Abi::i386);
  EXPECT_EQ(whole->byte_order, ByteOrder::big);
  EXPECT_EQ(layout_choice_from_word("identified_lp64_le")->byte_order, ByteOrder::little);
}

TEST(LayoutChoice, OtherWordsAreRefused) {
  for (const char* const word :
       {"", "_", "lp64", "auto_lp64", "Document", "document_", "document_lp", "document_le", "document_lp64_",
        "document_lp64_xe", "document_lp64_le_", "identified_lp64_le_be", " document", "identified lp64"}) {
    EXPECT_FALSE(layout_choice_from_word(word)) << word;
  }
}

TEST(LayoutChoice, FallsBackForMissingParts) {
  const Layout fallback{Generation::document, Abi::i386, ByteOrder::big};
  EXPECT_EQ(resolve({}, fallback), fallback);
  EXPECT_EQ(resolve({Generation::identified, {}, {}}, fallback),
            (Layout{Generation::identified, Abi::i386, ByteOrder::big}));
  EXPECT_EQ(resolve({Generation::identified, Abi::llp64, ByteOrder::little}, fallback),
            (Layout{Generation::identified, Abi::llp64, ByteOrder::little}));
}

}  // namespace trk_bridge::wire::layout_test
