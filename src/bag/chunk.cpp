// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "chunk.h"

#include <algorithm>
#include <new>
#include <utility>

#include <bzlib.h>
#include <rosbag/constants.h>
#include <roslz4/lz4s.h>

namespace trk_bridge::bag {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;
// An lz4 block is at most 4 MiB and is unpacked in one piece.
constexpr std::size_t room = std::size_t{4} << 20;
// Both libraries use int for sizes.
constexpr std::size_t portion = std::size_t{1} << 30;

enum class Step { more, end, fault };

/// Feeds a decompressor until it ends, fails or has consumed everything. `Stream::step` consumes and produces as much
/// as it can.
template <typename Stream>
Unpacked unpack(std::vector<std::uint8_t>& packed) {
  Stream stream;
  Unpacked unpacked;
  std::size_t consumed = 0;
  std::size_t produced = 0;
  const auto finish = [&](const char* fault) {
    unpacked.bytes.resize(produced);
    unpacked.fault = fault;
    return std::move(unpacked);
  };
  for (;;) {
    if (produced > most_bytes) return finish("unpacks to more than 1 GiB");
    unpacked.bytes.resize(produced + room);
    std::size_t in = std::min(packed.size() - consumed, portion);
    std::size_t out = room;
    const Step step = stream.step(reinterpret_cast<char*>(packed.data()) + consumed, in,
                                  reinterpret_cast<char*>(unpacked.bytes.data()) + produced, out);
    consumed += in;
    produced += out;
    if (step == Step::end) return finish("");
    if (step == Step::fault) return finish("is damaged");
    if (in == 0 && out == 0) return finish("is truncated");
  }
}

class Bzip2 {
 public:
  Bzip2() { good_ = BZ2_bzDecompressInit(&stream_, /*verbosity=*/0, /*small=*/0) == BZ_OK; }
  ~Bzip2() {
    if (good_) BZ2_bzDecompressEnd(&stream_);
  }
  Bzip2(const Bzip2&) = delete;
  Bzip2& operator=(const Bzip2&) = delete;

  Step step(char* from, std::size_t& in, char* to, std::size_t& out) {
    if (!good_) return Step::fault;
    stream_.next_in = from;
    stream_.avail_in = static_cast<unsigned>(in);
    stream_.next_out = to;
    stream_.avail_out = static_cast<unsigned>(out);
    const int result = BZ2_bzDecompress(&stream_);
    in -= stream_.avail_in;
    out -= stream_.avail_out;
    if (result == BZ_STREAM_END) return Step::end;
    return result == BZ_OK ? Step::more : Step::fault;
  }

 private:
  bz_stream stream_{};
  bool good_ = false;
};

class Lz4 {
 public:
  Lz4() { good_ = roslz4_decompressStart(&stream_) == ROSLZ4_OK; }
  ~Lz4() {
    if (good_) roslz4_decompressEnd(&stream_);
  }
  Lz4(const Lz4&) = delete;
  Lz4& operator=(const Lz4&) = delete;

  Step step(char* from, std::size_t& in, char* to, std::size_t& out) {
    if (!good_) return Step::fault;
    stream_.input_next = from;
    stream_.input_left = static_cast<int>(in);
    stream_.output_next = to;
    stream_.output_left = static_cast<int>(out);
    const int result = roslz4_decompress(&stream_);
    in -= static_cast<std::size_t>(stream_.input_left);
    out -= static_cast<std::size_t>(stream_.output_left);
    if (result == ROSLZ4_STREAM_END) return Step::end;
    const bool wants_room = result == ROSLZ4_OUTPUT_SMALL && out > 0;
    return result == ROSLZ4_OK || wants_room ? Step::more : Step::fault;
  }

 private:
  roslz4_stream stream_{};
  bool good_ = false;
};

}  // namespace

Unpacked unpack_chunk(const std::string& compression, std::vector<std::uint8_t>& packed) {
  if (compression == rosbag::COMPRESSION_BZ2) return unpack<Bzip2>(packed);
  if (compression == rosbag::COMPRESSION_LZ4) return unpack<Lz4>(packed);
  return {{}, "has an unknown compression (" + compression + ")"};
}

std::vector<std::uint8_t> pack_chunk(const std::string& compression, std::vector<std::uint8_t>& bytes) {
  // Incompressible data grow by at most 1 % and 600 bytes with bzip2, by less with lz4.
  std::vector<std::uint8_t> packed(bytes.size() + bytes.size() / 100 + 600);
  auto size = static_cast<unsigned>(packed.size());
  auto* const from = reinterpret_cast<char*>(bytes.data());
  auto* const to = reinterpret_cast<char*>(packed.data());
  // The block sizes of rosbag: 900 kB and 1 MiB.
  const bool good =
      compression == rosbag::COMPRESSION_BZ2
          ? BZ2_bzBuffToBuffCompress(to, &size, from, static_cast<unsigned>(bytes.size()), /*blockSize100k=*/9,
                                     /*verbosity=*/0, /*workFactor=*/30) == BZ_OK
          : roslz4_buffToBuffCompress(from, static_cast<unsigned>(bytes.size()), to, &size, /*block_size_id=*/6) ==
                ROSLZ4_OK;
  if (!good) throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

}  // namespace trk_bridge::bag
