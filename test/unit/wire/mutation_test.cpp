// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Damaged datagrams of existing programs never become a wrong record.
#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "codec_claims.h"
#include "exact_copy.h"
#include "records.h"
#include "trk_bridge/wire/codec.h"
#include "vectors.h"

namespace trk_bridge::wire::mutation_test {

using test::bits_of;
using test::ExactCopy;
using testing::AnyOf;

const char* const folders[] = {"document_lp64", "identified_lp64", "document_i386", "identified_i386"};

std::vector<std::string> datagrams(const char* key) {
  std::vector<std::string> all;
  for (const std::string folder : folders) {
    for (const char* const what : {"params", "constants"}) {
      for (const auto& line : test::read_jsonl("field/" + folder + "/" + what + ".jsonl")) {
        all.push_back(test::from_hex(line[key].GetString()));
      }
    }
  }
  return all;
}

std::vector<std::string> all_datagrams() {
  auto all = datagrams("ascii_hex");
  const auto binary = datagrams("binary_hex");
  all.insert(all.end(), binary.begin(), binary.end());
  return all;
}

class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  std::string flip(std::string bytes) {
    for (std::size_t n = 1 + below(4); n > 0; --n) {
      char& byte = bytes[below(bytes.size())];
      byte = static_cast<char>(byte ^ static_cast<char>(1 << below(8)));
    }
    return bytes;
  }
  std::string cut(const std::string& bytes) { return bytes.substr(0, below(bytes.size())); }
  std::string splice(const std::string& head, const std::string& tail) {
    return head.substr(0, below(head.size())) + tail.substr(below(tail.size()));
  }

 private:
  std::mt19937 random_;
};

TEST(Mutation, TenThousandDamagedDatagrams) {
  const auto all = all_datagrams();
  Damage damage(20251122);
  LayoutDetector kept;
  for (int i = 0; i < 10000; ++i) {
    const std::string& one = all[damage.below(all.size())];
    const std::string& other = all[damage.below(all.size())];
    const std::string bad = i % 3 == 0 ? damage.flip(one) : i % 3 == 1 ? damage.cut(one) : damage.splice(one, other);
    const ExactCopy copy(bad);
    LayoutDetector fresh;
    ASSERT_EQ(test::broken_claim(copy.view(), fresh), "") << "datagram " << i;
    ASSERT_EQ(test::broken_claim(copy.view(), kept), "") << "datagram " << i;
  }
}

/// A truncated text is a fault, unless only the NUL or a part of the last number, the counter, is missing.
TEST(Mutation, ATruncatedTextIsAFaultUpToItsLastNumber) {
  for (const std::string& whole : datagrams("ascii_hex")) {
    const std::size_t last_number = whole.rfind(' ') + 1;
    for (std::size_t size = 0; size <= last_number; ++size) {
      const ExactCopy copy(whole.substr(0, size));
      LayoutDetector detector;
      const auto read = decode(copy.view(), detector);
      ASSERT_FALSE(read) << size << " bytes of " << whole;
      EXPECT_THAT(read.error().reason, AnyOf(Reason::truncated, Reason::not_a_number)) << size << " bytes of " << whole;
    }
  }
}

/// A truncated binary record is a fault. Only 196 of 200 bytes can be a valid record, that of an i386 sender: an
/// identified little-endian one then has the same meaning, and a matrix of the document's generation is read as one
/// with an id.
TEST(Mutation, ATruncatedBinaryRecordIsAFault) {
  for (const std::string& whole : datagrams("binary_hex")) {
    LayoutDetector reference_detector;
    const auto reference = decode(whole, reference_detector);
    ASSERT_TRUE(reference);
    const bool document = reference->form.layout.generation == Generation::document;
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const ExactCopy copy(whole.substr(0, size));
      LayoutDetector detector;
      const auto read = decode(copy.view(), detector);
      if (!read) continue;
      ASSERT_EQ(size, header_size + 196);
      if (!document) {
        ASSERT_EQ(bits_of(read->record), bits_of(reference->record));
      } else {
        ASSERT_EQ(std::get<CameraParams>(read->record).format, 0U);
      }
      LayoutDetector given({{}, Abi::lp64, {}});
      EXPECT_FALSE(decode(copy.view(), given));
    }
  }
}

/// A bad datagram affects only itself; no data of it gets into the next one.
TEST(Mutation, ABadDatagramLeavesNothingBehind) {
  Damage damage(7);
  for (const char* const key : {"ascii_hex", "binary_hex"}) {
    LayoutDetector detector;
    const auto all = datagrams(key);
    Buffer buffer;
    for (std::size_t i = 0; i + 1 < 256; ++i) {
      LayoutDetector reference_detector;
      const auto reference = decode(all[i], reference_detector);
      ASSERT_TRUE(reference);
      std::copy(all[i + 1].begin(), all[i + 1].end(), buffer.begin());
      const std::size_t cut = damage.below(all[i + 1].size() - 40);
      EXPECT_FALSE(decode(std::string_view(buffer.data(), cut), detector));
      std::copy(all[i].begin(), all[i].end(), buffer.begin());
      const auto read = decode(std::string_view(buffer.data(), all[i].size()), detector);
      ASSERT_TRUE(read);
      EXPECT_EQ(bits_of(read->record), bits_of(reference->record));
    }
  }
}

}  // namespace trk_bridge::wire::mutation_test
