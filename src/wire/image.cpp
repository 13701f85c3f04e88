#include <cmath>
#include <cstring>
#include <limits>

#include "places.h"
#include "shape.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/fields.h"

namespace trk_bridge::wire {

namespace {

/// Reads numbers one behind another from an image whose size was checked.
class Loader {
 public:
  Loader(std::string_view image, ByteOrder order) noexcept : image_(image), order_(order) {}

  std::uint32_t word(std::size_t offset) const noexcept { return load<std::uint32_t>(image_.data() + offset, order_); }
  std::uint64_t wide_word(std::size_t offset) const noexcept {
    return load<std::uint64_t>(image_.data() + offset, order_);
  }
  double number(std::size_t offset) const noexcept { return load_double(image_.data() + offset, order_); }
  /// A visitor of consecutive fields; offset and place are those of the first.
  auto numbers_from(std::size_t offset, std::size_t place) noexcept {
    return [this, offset, place](const Field&, double& value) mutable {
      value = number(offset);
      check(value, place++);
      offset += sizeof(double);
    };
  }
  auto words_from(std::size_t offset) const noexcept {
    return [this, offset](const Field&, std::int32_t& value) mutable {
      const std::uint32_t bits = word(offset);
      std::memcpy(&value, &bits, sizeof bits);
      offset += sizeof bits;
    };
  }
  void check(double value, std::size_t place) noexcept {
    if (!std::isfinite(value)) fault_.note(about_field(Reason::not_finite, place));
  }
  const FirstFault& fault() const noexcept { return fault_; }

 private:
  std::string_view image_;
  ByteOrder order_;
  FirstFault fault_;
};

/// Writes numbers one behind another into a zeroed image.
class Storer {
 public:
  Storer(Buffer& buffer, std::size_t size, ByteOrder order) noexcept : buffer_(buffer), size_(size), order_(order) {
    std::memset(buffer.data(), 0, size);
  }

  void word(std::size_t offset, std::uint32_t value) noexcept { store(value, buffer_.data() + offset, order_); }
  void wide_word(std::size_t offset, std::uint64_t value) noexcept { store(value, buffer_.data() + offset, order_); }
  void number(std::size_t offset, std::size_t place, double value) noexcept {
    if (!std::isfinite(value)) refuse(Reason::not_finite, place);
    store_double(value, buffer_.data() + offset, order_);
  }
  /// A visitor of consecutive fields; offset and place are those of the first.
  auto numbers_from(std::size_t offset, std::size_t place) noexcept {
    return [this, offset, place](const Field&, double value) mutable {
      number(offset, place++, value);
      offset += sizeof(double);
    };
  }
  auto words_from(std::size_t offset) noexcept {
    return [this, offset](const Field&, std::int32_t value) mutable {
      word(offset, static_cast<std::uint32_t>(value));
      offset += sizeof value;
    };
  }
  void refuse(Reason reason, std::size_t place) noexcept { fault_.note(about_field(reason, place)); }
  tl::expected<std::string_view, Fault> finish() const noexcept {
    if (fault_) return tl::unexpected(*fault_);
    return std::string_view(buffer_.data(), size_);
  }

 private:
  Buffer& buffer_;
  std::size_t size_;
  ByteOrder order_;
  FirstFault fault_;
};

}  // namespace

tl::expected<CameraParams, Fault> params_from_image(std::string_view image, Layout layout) noexcept {
  const ParamsShape shape = params_shape(layout.generation, layout.abi);
  if (image.size() != shape.size) return tl::unexpected(Fault{Reason::wrong_size});
  Loader loader(image, layout.byte_order);
  CameraParams p;
  if (layout.generation == Generation::identified) p.id = loader.word(id_offset);
  p.format = loader.word(shape.format);
  if (has(p.format, euler)) {
    for_each_euler_field(loader.numbers_from(shape.transform, transform_place), p.euler);
  } else {
    for (std::size_t i = 0; i < p.matrix.size(); ++i) {
      p.matrix[i] = loader.number(shape.transform + i * sizeof(double));
      loader.check(p.matrix[i], matrix_place(i));
    }
  }
  for_each_lens_field(loader.numbers_from(shape.lens, lens_place(p.format)), p);
  p.counter = shape.counter_width == 8 ? loader.wide_word(shape.counter) : loader.word(shape.counter);
  if (loader.fault()) return tl::unexpected(*loader.fault());
  return p;
}

tl::expected<CameraConstants, Fault> constants_from_image(std::string_view image, Layout layout) noexcept {
  const ConstantsShape shape = constants_shape(layout.generation, layout.abi);
  if (image.size() != shape.size) return tl::unexpected(Fault{Reason::wrong_size});
  Loader loader(image, layout.byte_order);
  CameraConstants c;
  if (layout.generation == Generation::identified) c.id = loader.word(id_offset);
  for_each_image_field(loader.words_from(shape.image), c);
  for_each_chip_field(loader.numbers_from(shape.chip, chip_place), c);
  if (loader.fault()) return tl::unexpected(*loader.fault());
  return c;
}

tl::expected<std::string_view, Fault> to_image(const CameraParams& p, Layout layout, Buffer& buffer) noexcept {
  const ParamsShape shape = params_shape(layout.generation, layout.abi);
  Storer storer(buffer, shape.size, layout.byte_order);
  if (layout.generation == Generation::identified) storer.word(id_offset, p.id);
  storer.word(shape.format, p.format);
  if (has(p.format, euler)) {
    for_each_euler_field(storer.numbers_from(shape.transform, transform_place), p.euler);
  } else {
    for (std::size_t i = 0; i < p.matrix.size(); ++i) {
      storer.number(shape.transform + i * sizeof(double), matrix_place(i), p.matrix[i]);
    }
  }
  for_each_lens_field(storer.numbers_from(shape.lens, lens_place(p.format)), p);
  if (shape.counter_width == 8) {
    storer.wide_word(shape.counter, p.counter);
  } else {
    if (p.counter > std::numeric_limits<std::uint32_t>::max()) {
      storer.refuse(Reason::out_of_range, counter_place(p.format));
    }
    storer.word(shape.counter, static_cast<std::uint32_t>(p.counter));
  }
  return storer.finish();
}

tl::expected<std::string_view, Fault> to_image(const CameraConstants& c, Layout layout, Buffer& buffer) noexcept {
  const ConstantsShape shape = constants_shape(layout.generation, layout.abi);
  Storer storer(buffer, shape.size, layout.byte_order);
  if (layout.generation == Generation::identified) storer.word(id_offset, c.id);
  for_each_image_field(storer.words_from(shape.image), c);
  for_each_chip_field(storer.numbers_from(shape.chip, chip_place), c);
  return storer.finish();
}

}  // namespace trk_bridge::wire
