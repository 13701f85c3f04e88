// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "records.h"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <rosbag/constants.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/system_text.h"
#include "reader.h"

namespace trk_bridge::bag {
namespace {

// A record header contains only numbers and names; a longer one is malformed.
constexpr std::uint32_t longest_header = 1 << 20;
constexpr std::uint64_t block_size = 1 << 18;
constexpr std::uint64_t size_size = sizeof(std::uint32_t);

[[noreturn]] void fail(int error) { throw BagError("cannot be read: " + base::system_text(error)); }

std::uint32_t size_in(std::string_view bytes) {
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  return size;
}

/// Removes one field from `rest`: its size in four bytes, its name, an equals sign and its value. False if there is
/// none.
bool take_field(std::string_view& rest, std::string_view& name, std::string_view& value) {
  if (rest.size() < size_size) return false;
  const std::uint32_t size = size_in(rest);
  rest.remove_prefix(size_size);
  if (size > rest.size()) return false;
  const std::string_view field = rest.substr(0, size);
  rest.remove_prefix(size);
  const std::size_t equals = field.find(static_cast<char>(rosbag::FIELD_DELIM));
  if (equals == std::string_view::npos || equals == 0) return false;
  name = field.substr(0, equals);
  value = field.substr(equals + 1);
  return true;
}

}  // namespace

FileBytes::FileBytes(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat state {};
  if (!file_.is_open() || ::fstat(file_.get(), &state) != 0) fail(errno);
  if (S_ISDIR(state.st_mode)) fail(EISDIR);
  size_ = static_cast<std::uint64_t>(state.st_size);
}

std::string_view FileBytes::at(std::uint64_t from, std::uint64_t count) {
  if (from < block_at_ || from + count > block_at_ + block_size_) {
    block_at_ = from;
    block_size_ = 0;
    const std::uint64_t wanted = std::min(std::max(count, block_size), size_ - from);
    if (block_.size() < wanted) block_.resize(wanted);
    while (block_size_ < count) {
      const ssize_t got = ::pread(file_.get(), block_.data() + block_size_, wanted - block_size_,
                                  static_cast<off_t>(from + block_size_));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) fail(got < 0 ? errno : EIO);
      block_size_ += static_cast<std::uint64_t>(got);
    }
  }
  return {block_.data() + (from - block_at_), count};
}

std::optional<HeaderFields> HeaderFields::parse(std::string_view bytes) {
  std::string_view name, value;
  for (std::string_view rest = bytes; !rest.empty();) {
    if (!take_field(rest, name, value)) return std::nullopt;
  }
  return HeaderFields(bytes);
}

std::string_view HeaderFields::text(std::string_view wanted) const {
  std::string_view name, value;
  for (std::string_view rest = bytes_; take_field(rest, name, value);) {
    if (name == wanted) return value;
  }
  return {};
}

std::map<std::string, std::string> HeaderFields::all() const {
  std::map<std::string, std::string> fields;
  std::string_view name, value;
  for (std::string_view rest = bytes_; take_field(rest, name, value);) fields[std::string(name)] = value;
  return fields;
}

std::optional<Record> record_at(Bytes& from, std::uint64_t at) {
  if (at > from.size() || from.size() - at < size_size) return std::nullopt;
  const std::uint32_t header_size = size_in(from.at(at, size_size));
  if (header_size == 0 || header_size > longest_header) return std::nullopt;
  if (from.size() - at < 2 * size_size + header_size) return std::nullopt;
  // Header and data size in one call, so that both stay valid.
  const std::string_view bytes = from.at(at + size_size, header_size + size_size);
  const auto header = HeaderFields::parse(bytes.substr(0, header_size));
  if (!header) return std::nullopt;
  const auto op = header->number<unsigned char>(rosbag::OP_FIELD_NAME);
  if (!op) return std::nullopt;
  return Record{*header, *op, at + 2 * size_size + header_size, size_in(bytes.substr(header_size))};
}

bool is_whole(const Bytes& from, const Record& record) { return record.size <= from.size() - record.data; }

}  // namespace trk_bridge::bag
