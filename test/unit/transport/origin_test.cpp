// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "trk_bridge/transport/sample.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace trk_bridge::transport::origin_test {

using wire::Abi;
using wire::ByteOrder;
using wire::Generation;

wire::WireForm binary(Generation generation, Abi abi, ByteOrder order) {
  return {wire::Encoding::binary, {generation, abi, order}};
}

TEST(Origin, IsAsLayoutsAreWrittenInUrls) {
  EXPECT_STREQ(origin_of({}), "ASCII");
  EXPECT_STREQ(origin_of({wire::Encoding::ascii, {Generation::document, Abi::i386, ByteOrder::big}}, true), "ASCII");
  EXPECT_STREQ(origin_of(binary(Generation::identified, Abi::lp64, ByteOrder::little)), "binary identified_lp64");
  EXPECT_STREQ(origin_of(binary(Generation::document, Abi::i386, ByteOrder::big)), "binary document_i386_be");
  EXPECT_STREQ(origin_of(binary(Generation::document, Abi::llp64, ByteOrder::little), true),
               "binary document_llp64, layout guessed");
}

TEST(Origin, EveryLayoutHasItsOwnStaticText) {
  std::set<std::string> texts;
  for (const auto generation : {Generation::document, Generation::identified}) {
    for (const auto abi : {Abi::lp64, Abi::llp64, Abi::i386}) {
      for (const auto order : {ByteOrder::little, ByteOrder::big}) {
        for (const bool guessed : {false, true}) {
          const auto form = binary(generation, abi, order);
          const char* const text = origin_of(form, guessed);
          EXPECT_TRUE(texts.insert(text).second) << text;
          EXPECT_EQ(origin_of(form, guessed), text) << "the same bytes each time";
          // The text can be used as an option: layout=document_i386_be.
          const std::string word = std::string(text).substr(7, std::string(text).find(',') - 7);
          const auto choice = wire::layout_choice_from_word(word);
          ASSERT_TRUE(choice) << word;
          EXPECT_EQ(wire::resolve(*choice, {}), form.layout) << word;
        }
      }
    }
  }
  EXPECT_EQ(texts.size(), 24u);
}

}  // namespace trk_bridge::transport::origin_test
