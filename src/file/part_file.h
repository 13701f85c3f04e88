// A file that has its final name only when it is whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "transport/socket.h"
#include "trk_bridge/transport/sink.h"

namespace trk_bridge::file {

/// Whether a file may be a FIFO.
enum class Fifo : std::uint8_t { refused, allowed };
/// Whether a `.part` may be there before.
enum class Part : std::uint8_t { taken_over, refused };

/// Written as `PATH.part`. A writer that dies leaves nothing under the final name, and what it wrote in `PATH.part`. A
/// FIFO has no part: it is written as it is. One thread at a time; nothing but open() allocates.
class PartFile {
 public:
  struct Options {
    bool overwrite = false;  ///< what has the final name, or is left in a `.part`, may be replaced
    Fifo fifo = Fifo::refused;
    Part part = Part::taken_over;  ///< refused: one that exists makes the name in_use, even when it is empty
  };

  /// Creates an empty `path`.part, locked against other writers for as long as it is open; the kernel unlocks it when a
  /// writer dies. Faults: exists, left_over, in_use, not_a_file, no_reader, or the system's. Of a FIFO it does not wait
  /// for a reader.
  static tl::expected<PartFile, transport::SinkFault> open(const std::string& path, const Options&);
  /// What open() would say because of the final name, so that it is known before long work.
  static tl::expected<void, transport::SinkFault> check(const std::string& path, const Options&);

  /// None.
  PartFile() = default;
  /// Closes it; what was not published stays as the `.part`.
  ~PartFile() = default;
  PartFile(PartFile&&) = default;
  PartFile& operator=(PartFile&&) = default;

  bool is_open() const noexcept { return descriptor_.is_open(); }
  bool is_fifo() const noexcept { return is_fifo_; }
  int fd() const noexcept { return descriptor_.get(); }
  const std::string& path() const noexcept { return path_; }
  /// Where it is written before it is whole.
  const std::string& part() const noexcept { return part_; }

  /// All of `bytes` at this place of the file (of a FIFO, behind what was written before). The error is an errno.
  [[nodiscard]] tl::expected<void, int> write(std::string_view bytes, std::int64_t at) noexcept;

  /// Cuts it to `size` bytes where that is given, brings everything to the disk, gives the file its final name and
  /// closes it. The error is an errno; the `.part` then stays.
  [[nodiscard]] tl::expected<void, int> publish(std::optional<std::int64_t> size = std::nullopt) noexcept;
  /// Closes it, and nothing stays.
  void discard() noexcept;

 private:
  PartFile(const std::string& path, bool overwrite, transport::Descriptor, bool is_fifo);

  std::string path_;
  std::string part_;
  std::string directory_;
  bool overwrite_ = false;
  bool is_fifo_ = false;
  transport::Descriptor descriptor_;
};

/// `path` is of a `.part`. Where a dead writer left it, it is published up to its last whole line as
/// `NAME.recovered.trk` (`NAME.recovered-2.trk` where that exists, …); the new name. One without any field is removed.
/// None where nothing was published.
std::optional<std::string> recover_part(const std::string& path);

/// The directory that a path names a file in, with its slash; "./" where it names none.
std::string directory_of(const std::string& path);
/// Where the ending of the file's name begins: at its last dot, or at the end where it has none.
std::size_t ending_of(const std::string& path);

}  // namespace trk_bridge::file
