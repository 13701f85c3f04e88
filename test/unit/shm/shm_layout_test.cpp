// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Segments byte for byte: contents of existing programs are read, and the same bytes are written.
#include <cstring>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "free_slot.h"
#include "shm/segment.h"
#include "vectors.h"

namespace trk_bridge::shm::shm_layout_test {

struct FieldSegment {
  std::string directory;
  std::size_t size;
};

std::ostream& operator<<(std::ostream& out, const FieldSegment& s) { return out << s.directory; }

class FieldLayout : public ::testing::TestWithParam<FieldSegment> {
 protected:
  std::string bytes() const {
    std::ifstream in(test::data_path("field/" + GetParam().directory + "/shm_slot7.hex"));
    std::string hex, line;
    while (in >> line) hex += line;
    return test::from_hex(hex);
  }

  std::vector<rapidjson::Document> writes() const {
    return test::read_jsonl("field/" + GetParam().directory + "/shm_slot7.jsonl");
  }

  test::FreeSlot slot;
};

/// The same record, but without the id if the layout has none.
template <typename Record>
Record as_stored(Record record, const SegmentLayout& layout) {
  if (layout.record.generation == wire::Generation::document) record.id = 0;
  return record;
}

TEST_P(FieldLayout, sizes_are_those_of_the_records) {
  const SegmentLayout* layout = layout_of_size(GetParam().size);
  ASSERT_NE(layout, nullptr);
  EXPECT_EQ(layout, layout_of(layout->record));
  EXPECT_EQ(layout->params_size, wire::params_size(layout->record));
  EXPECT_EQ(layout->constants_size, wire::constants_size(layout->record));
  EXPECT_EQ(bytes().size(), GetParam().size);
}

TEST_P(FieldLayout, last_writes_are_read) {
  const std::string stored = bytes();
  const int id = slot.make_segment(stored.size());
  void* memory = ::shmat(id, nullptr, 0);
  ASSERT_NE(memory, reinterpret_cast<void*>(-1));
  std::memcpy(memory, stored.data(), stored.size());
  auto segment = Segment::attach(slot.number());
  ASSERT_TRUE(segment) << describe(segment.error());
  EXPECT_EQ(segment->connected(), 2);
  EXPECT_EQ(segment->params_counter(), 3);
  EXPECT_EQ(segment->constants_counter(), 1);

  const auto written = writes();
  RecordImage image;
  ASSERT_TRUE(segment->copy_params(image));
  const auto params = wire::params_from_image(image.view(), segment->layout().record);
  ASSERT_TRUE(params) << wire::describe(params.error());
  EXPECT_EQ(*params, as_stored(test::params_of(written.back()["fields"]), segment->layout()));
  ASSERT_TRUE(segment->copy_constants(image));
  const auto constants = wire::constants_from_image(image.view(), segment->layout().record);
  ASSERT_TRUE(constants) << wire::describe(constants.error());
  EXPECT_EQ(*constants, as_stored(test::constants_of(written.front()["fields"]), segment->layout()));

  segment->close();
  EXPECT_EQ(std::memcmp(memory, stored.data(), stored.size()), 0) << "reading changes no byte";
  ::shmdt(memory);
}

/// Which bytes of a record carry data: those that change when the record's fields do. Found by writing two records that
/// differ in every bit of every field.
std::string data_mask(const SegmentLayout& layout, std::uint32_t format) {
  const auto all = [](double value) {
    wire::CameraParams p;
    p.matrix.fill(value);
    p.euler = {value, value, value, value, value, value};
    p.fov = p.center_x = p.center_y = p.k1 = p.k2 = p.focdist = p.aperture = value;
    return p;
  };
  const auto image = [&](const wire::CameraParams& p) {
    wire::Buffer buffer;
    return std::string(*wire::to_image(p, layout.record, buffer));
  };
  // 0x5555555555555555 and 0xAAAAAAAAAAAAAAAA are both finite and share no bit.
  double a = 0, b = 0;
  const std::uint64_t a_bits = 0x5555555555555555, b_bits = 0xAAAAAAAAAAAAAAAA;
  std::memcpy(&a, &a_bits, sizeof a);
  std::memcpy(&b, &b_bits, sizeof b);
  wire::CameraParams first = all(a), second = all(b);
  first.format = second.format = format;
  first.id = 0;
  first.counter = 0;
  second.id = 0xFFFFFFFF;
  second.counter = layout.record.abi == wire::Abi::lp64 ? ~std::uint64_t{0} : 0xFFFFFFFF;
  std::string mask = image(first);
  const std::string other = image(second);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = mask[i] == other[i] ? 0 : 1;
  const std::size_t format_at = layout.record.generation == wire::Generation::identified ? 4 : 0;
  std::fill_n(mask.begin() + static_cast<std::ptrdiff_t>(format_at), 4, 1);
  return mask;
}

TEST_P(FieldLayout, the_same_writes_give_the_same_bytes) {
  const SegmentLayout& layout = *layout_of_size(GetParam().size);
  auto segment = Segment::attach_or_create(slot.number(), layout, 0666);
  ASSERT_TRUE(segment) << describe(segment.error());
  std::array<std::uint32_t, 2> formats{};
  std::size_t element = 0;
  for (const auto& line : writes()) {
    if (line["op"] == "writeConstants") {
      ASSERT_TRUE(segment->write(test::constants_of(line["fields"])));
    } else {
      const auto params = test::params_of(line["fields"]);
      ASSERT_TRUE(segment->write(params));
      formats[element = 1 - element] = params.format;
    }
  }

  void* memory = ::shmat(segment->id(), nullptr, SHM_RDONLY);
  ASSERT_NE(memory, reinterpret_cast<void*>(-1));
  const std::string got(static_cast<const char*>(memory), layout.size);
  ::shmdt(memory);
  const std::string expected = bytes();
  std::string carries(layout.size, 1);
  for (std::size_t e = 0; e < 2; ++e)
    carries.replace(layout.params[e], layout.params_size, data_mask(layout, formats[e]));
  if (layout.constants_size == 64) {
    for (const std::size_t at : layout.constants) carries.replace(at + 28, 4, 4, 0);
  }
  std::size_t compared = 0;
  for (std::size_t i = 0; i < layout.size; ++i) {
    if (carries[i] == 0) continue;
    ++compared;
    EXPECT_EQ(static_cast<unsigned char>(got[i]), static_cast<unsigned char>(expected[i])) << "byte " << i;
  }
  EXPECT_GT(compared, layout.size / 2);
}

INSTANTIATE_TEST_SUITE_P(Field, FieldLayout,
                         ::testing::Values(FieldSegment{"identified_lp64", 544}, FieldSegment{"document_lp64", 528},
                                           FieldSegment{"identified_i386", 524}, FieldSegment{"document_i386", 508}),
                         [](const auto& instance) { return instance.param.directory; });

TEST(SegmentLayout, other_sizes_and_other_machines_have_none) {
  for (const std::size_t size : {0U, 1U, 300U, 507U, 509U, 526U, 545U, 4096U}) EXPECT_EQ(layout_of_size(size), nullptr);
  EXPECT_EQ(layout_of({wire::Generation::document, wire::Abi::llp64, wire::ByteOrder::little}), nullptr);
}

TEST(ShmSlotPath, one_character_a_slot) {
  EXPECT_EQ(slot_path(0), "/tmp/dmc_tracking_buffer.0");
  EXPECT_EQ(slot_path(9), "/tmp/dmc_tracking_buffer.9");
  EXPECT_EQ(slot_path(10), "/tmp/dmc_tracking_buffer.A");
  EXPECT_EQ(slot_path(35), "/tmp/dmc_tracking_buffer.Z");
  EXPECT_EQ(slot_path(36), "/tmp/dmc_tracking_buffer.a");
  EXPECT_EQ(slot_path(61), "/tmp/dmc_tracking_buffer.z");
}

}  // namespace trk_bridge::shm::shm_layout_test
