#include "scan.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include <ros/datatypes.h>
#include <rosbag/constants.h>

#include "chunk.h"

namespace trk_bridge::bag {
namespace {

constexpr std::string_view magic = "#ROSBAG V2.0\n";
// Fields of a record's header are numbers and names; more is no header.
constexpr std::uint32_t longest_header = 1 << 20;

/// Bytes that a bag's records are read from.
class Bytes {
 public:
  virtual ~Bytes() = default;
  virtual std::uint64_t size() const = 0;
  /// The range must lie within size().
  virtual void read(std::uint64_t from, std::uint64_t count, std::vector<std::uint8_t>& into) = 0;
};

class FileBytes final : public Bytes {
 public:
  explicit FileBytes(const std::string& path) : file_(path, std::ios::binary | std::ios::ate) {
    if (!file_) fail();
    const std::streamoff end = file_.tellg();
    if (end < 0) fail();
    size_ = static_cast<std::uint64_t>(end);
  }
  std::uint64_t size() const override { return size_; }
  void read(std::uint64_t from, std::uint64_t count, std::vector<std::uint8_t>& into) override {
    into.resize(count);
    file_.seekg(static_cast<std::streamoff>(from));
    if (!file_.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(count))) fail();
  }

 private:
  [[noreturn]] static void fail() {
    throw BagError("cannot be read: " + std::system_category().message(errno != 0 ? errno : EIO));
  }

  std::ifstream file_;
  std::uint64_t size_ = 0;
};

class MemoryBytes final : public Bytes {
 public:
  explicit MemoryBytes(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  void read(std::uint64_t from, std::uint64_t count, std::vector<std::uint8_t>& into) override {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(from);
    into.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  }

 private:
  const std::vector<std::uint8_t>& bytes_;
};

template <typename Number>
std::optional<Number> number_in(const ::ros::M_string& fields, const std::string& name) {
  const auto field = fields.find(name);
  Number number{};
  if (field == fields.end() || field->second.size() != sizeof number) return std::nullopt;
  std::memcpy(&number, field->second.data(), sizeof number);
  return number;
}

std::string text_in(const ::ros::M_string& fields, const std::string& name) {
  const auto field = fields.find(name);
  return field == fields.end() ? std::string() : field->second;
}

/// Every field is its size in four bytes, its name, an equals sign and its value. ros::Header reads the same, but
/// writes its errors to standard error.
std::optional<::ros::M_string> fields_of(const std::vector<std::uint8_t>& bytes) {
  ::ros::M_string fields;
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  while (!rest.empty()) {
    std::uint32_t size = 0;
    if (rest.size() < sizeof size) return std::nullopt;
    std::memcpy(&size, rest.data(), sizeof size);
    rest.remove_prefix(sizeof size);
    if (size > rest.size()) return std::nullopt;
    const std::string_view field = rest.substr(0, size);
    rest.remove_prefix(size);
    const std::size_t equals = field.find(static_cast<char>(rosbag::FIELD_DELIM));
    if (equals == std::string_view::npos || equals == 0) return std::nullopt;
    fields[std::string(field.substr(0, equals))] = field.substr(equals + 1);
  }
  return fields;
}

class Scan {
 public:
  Scan(const std::string& path, const std::function<void(const Connection&)>& on_connection,
       const std::function<void(const RawMessage&)>& on_message, cli::LongRun& run)
      : path_(path), on_connection_(on_connection), on_message_(on_message), run_(run) {}

  std::string run() {
    FileBytes file(path_);
    if (file.size() < magic.size()) throw BagError("not a bag: it is shorter than the first line of one");
    file.read(0, magic.size(), data_);
    if (!std::equal(magic.begin(), magic.end(), data_.begin())) {
      throw BagError("not a bag of format 2.0: it does not begin with " +
                     std::string(magic.substr(0, magic.size() - 1)));
    }
    const std::uint64_t end = records(file, magic.size(), /*is_file=*/true);
    std::string result = end == file.size()
                             ? "everything in it was read"
                             : "it is read up to byte " + std::to_string(end) + " of " + std::to_string(file.size());
    if (!chunk_fault_.empty()) result += "; " + chunk_fault_;
    if (unknown_messages_ != 0)
      result += "; " + std::to_string(unknown_messages_) + " messages of unknown topics were left out";
    return result;
  }

 private:
  /// Reads records for as long as they are whole. Returns where it stopped.
  std::uint64_t records(Bytes& from, std::uint64_t at, bool is_file) {
    for (;;) {
      if (is_file) run_.at(static_cast<double>(at) / static_cast<double>(from.size()));
      const auto header_size = size_at(from, at);
      if (!header_size || *header_size == 0 || *header_size > longest_header) return at;
      if (*header_size > from.size() - at - sizeof(std::uint32_t)) return at;
      from.read(at + sizeof(std::uint32_t), *header_size, header_);
      const std::uint64_t size_place = at + sizeof(std::uint32_t) + *header_size;
      const auto data_size = size_at(from, size_place);
      if (!data_size) return at;
      const auto fields = fields_of(header_);
      if (!fields) return at;
      const std::uint64_t data = size_place + sizeof(std::uint32_t);
      const auto next = record(from, *fields, data, *data_size, is_file);
      if (!next) return at;
      at = *next;
    }
  }

  /// Where the next record begins; none when this one is not whole.
  std::optional<std::uint64_t> record(Bytes& from, const ::ros::M_string& fields, std::uint64_t data,
                                      std::uint32_t size, bool is_file) {
    const auto op = number_in<unsigned char>(fields, rosbag::OP_FIELD_NAME);
    if (!op) return std::nullopt;
    if (is_file && *op == rosbag::OP_CHUNK) return chunk(from, fields, data, size);
    if (size > from.size() - data) return std::nullopt;
    if (*op == rosbag::OP_FILE_HEADER && !text_in(fields, rosbag::ENCRYPTOR_FIELD_NAME).empty()) {
      throw BagError("it is encrypted and has no index: it cannot be read");
    }
    if (*op == rosbag::OP_CONNECTION) {
      from.read(data, size, data_);
      connection(fields);
    }
    if (*op == rosbag::OP_MSG_DATA) {
      const auto id = number_in<std::uint32_t>(fields, rosbag::CONNECTION_FIELD_NAME);
      const auto known = id ? connections_.find(*id) : connections_.end();
      if (known == connections_.end()) {
        ++unknown_messages_;
      } else if (on_message_) {
        from.read(data, size, data_);
        on_message_({known->second, data_});
      }
    }
    return data + size;
  }

  std::optional<std::uint64_t> chunk(Bytes& from, const ::ros::M_string& fields, std::uint64_t data,
                                     std::uint32_t size) {
    const std::string compression = text_in(fields, rosbag::COMPRESSION_FIELD_NAME);
    // The records of a plain chunk are as good as the file's own; so the unfinished one, whose size was never
    // written, needs no special care.
    if (compression == rosbag::COMPRESSION_NONE) return data;
    const std::uint64_t there = from.size() - data;
    const std::uint64_t packed = size == 0 ? there : std::min<std::uint64_t>(size, there);
    from.read(data, packed, packed_);
    const auto unpacked = unpack_chunk(compression, packed_);
    if (!unpacked.fault.empty()) {
      chunk_fault_ = "the chunk at byte " + std::to_string(data) + " " + unpacked.fault;
    }
    MemoryBytes records_of_chunk(unpacked.bytes);
    records(records_of_chunk, 0, /*is_file=*/false);
    return data + packed;
  }

  void connection(const ::ros::M_string& fields) {
    const auto id = number_in<std::uint32_t>(fields, rosbag::CONNECTION_FIELD_NAME);
    const auto header = fields_of(data_);
    if (!id || !header || connections_.count(*id) != 0) return;
    Connection& found = connections_[*id];
    found.id = *id;
    found.topic = text_in(fields, rosbag::TOPIC_FIELD_NAME);
    found.type = text_in(*header, "type");
    found.md5sum = text_in(*header, "md5sum");
    found.header.insert(header->begin(), header->end());
    on_connection_(found);
  }

  static std::optional<std::uint32_t> size_at(Bytes& from, std::uint64_t at) {
    std::uint32_t size = 0;
    if (at > from.size() || from.size() - at < sizeof size) return std::nullopt;
    std::vector<std::uint8_t> bytes;
    from.read(at, sizeof size, bytes);
    std::memcpy(&size, bytes.data(), sizeof size);
    return size;
  }

  const std::string& path_;
  const std::function<void(const Connection&)>& on_connection_;
  const std::function<void(const RawMessage&)>& on_message_;
  cli::LongRun& run_;
  std::map<std::uint32_t, Connection> connections_;
  std::vector<std::uint8_t> header_, data_, packed_;
  std::string chunk_fault_;
  std::uint64_t unknown_messages_ = 0;
};

}  // namespace

std::string scan_bag(const std::string& path, const std::function<void(const Connection&)>& on_connection,
                     const std::function<void(const RawMessage&)>& on_message, cli::LongRun& run) {
  return Scan(path, on_connection, on_message, run).run();
}

}  // namespace trk_bridge::bag
