// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The records that a bag of format 2.0 consists of.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transport/socket.h"

namespace trk_bridge::bag {

/// The first line.
inline constexpr std::string_view magic = "#ROSBAG V2.0\n";

/// The bytes of a bag or of a chunk.
class Bytes {
 public:
  virtual ~Bytes() = default;
  virtual std::uint64_t size() const = 0;
  /// Valid until the next call. The range must lie within size(). Throws BagError.
  virtual std::string_view at(std::uint64_t from, std::uint64_t count) = 0;
};

/// Reads blocks.
class FileBytes final : public Bytes {
 public:
  /// Throws BagError.
  explicit FileBytes(const std::string& path);
  std::uint64_t size() const override { return size_; }
  std::string_view at(std::uint64_t from, std::uint64_t count) override;

 private:
  transport::Descriptor file_;
  std::uint64_t size_ = 0;
  std::vector<char> block_;
  std::uint64_t block_at_ = 0, block_size_ = 0;
};

class MemoryBytes final : public Bytes {
 public:
  /// `bytes` must live longer.
  explicit MemoryBytes(const std::vector<std::uint8_t>& bytes)
      : bytes_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {}
  std::uint64_t size() const override { return bytes_.size(); }
  std::string_view at(std::uint64_t from, std::uint64_t count) override { return bytes_.substr(from, count); }

 private:
  std::string_view bytes_;
};

/// Names and values in the headers of records and connections; a view. ros::Header reads the same format, but copies it
/// and prints its errors to standard error.
class HeaderFields {
 public:
  /// None unless all bytes are a valid header.
  static std::optional<HeaderFields> parse(std::string_view bytes);

  /// Empty if there is no field with this name.
  std::string_view text(std::string_view name) const;
  /// None if there is no field with this name and size.
  template <typename Number>
  std::optional<Number> number(std::string_view name) const {
    const std::string_view value = text(name);
    Number number{};
    if (value.size() != sizeof number) return std::nullopt;
    std::memcpy(&number, value.data(), sizeof number);
    return number;
  }
  std::map<std::string, std::string> all() const;

 private:
  explicit HeaderFields(std::string_view bytes) : bytes_(bytes) {}

  std::string_view bytes_;
};

struct Record {
  HeaderFields header;  ///< valid until the next Bytes::at()
  unsigned char op;     ///< type of the record
  std::uint64_t data;   ///< position of its data
  std::uint32_t size;   ///< of its data, which may be truncated
};
/// None if there is no complete header.
std::optional<Record> record_at(Bytes&, std::uint64_t at);
/// Whether the data are complete.
bool is_whole(const Bytes&, const Record&);

}  // namespace trk_bridge::bag
