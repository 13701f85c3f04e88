// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A segment that changes under its reader: by a writer of the field, word by word between any two instructions of a
// read, and by bytes of any kind at any place.
#include <csignal>
#include <cstring>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <sys/shm.h>
#include <ucontext.h>

#include "camera_records.h"
#include "codec_claims.h"
#include "free_slot.h"
#include "fuzz.h"
#include "shm/link.h"

namespace {

using namespace trk_bridge;
using shm::Link;
using shm::ReadResult;
using shm::SegmentLayout;
using test::claim;
using test::Input;

constexpr std::size_t page_size = 4096;

/// Lets steps happen between the instructions of a call: each so many instructions after the one before. Elsewhere than
/// on x86-64 they all happen before it.
class BetweenInstructions {
 public:
  /// The number of instructions to the next step; none: there are no more.
  using Step = std::function<std::optional<unsigned>()>;

  template <typename Call>
  static void run(const Step& step, const Call& call) {
    std::optional<unsigned> gap = step();
#if defined(__x86_64__)
    static const bool installed = install();
    claim(installed, "no handler for single steps");
    next_step = &step;
    left = gap.value_or(0);
    if (gap) __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() | trap_flag);
    call();
    __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() & ~trap_flag);
    next_step = nullptr;
#else
    while (gap) gap = step();
    call();
#endif
  }

#if defined(__x86_64__)
 private:
  static constexpr unsigned long long trap_flag = 0x100;
  inline static const Step* next_step = nullptr;
  inline static unsigned left = 0;

  static bool install() {
    struct sigaction action {};
    action.sa_sigaction = after_instruction;
    action.sa_flags = SA_SIGINFO;
    return ::sigaction(SIGTRAP, &action, nullptr) == 0;
  }
  static void after_instruction(int, siginfo_t*, void* context) {
    if (next_step == nullptr || left-- > 0) return;
    const auto gap = (*next_step)();
    left = gap.value_or(0);
    if (!gap) static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL] &= ~static_cast<greg_t>(trap_flag);
  }
#endif
};

/// The program that made the segment. The memory of a slot, attached to as a program of the field does.
class Memory {
 public:
  explicit Memory(const SegmentLayout& layout) : layout_(layout) {
    base_ = static_cast<char*>(::shmat(slot_.make_segment(layout.size), nullptr, 0));
    if (base_ == reinterpret_cast<char*>(-1)) throw std::runtime_error("cannot attach to the segment");
    make_header();
  }
  ~Memory() { ::shmdt(base_); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  int slot() const { return slot_.number(); }
  char* at(std::size_t offset) const { return base_ + offset; }
  const SegmentLayout& layout() const { return layout_; }
  void make_header() const {
    const std::uint64_t magic = shm::segment_magic;
    std::memcpy(base_, &magic, layout_.magic_size);
    const std::int32_t connected = 1;
    std::memcpy(base_ + layout_.connected, &connected, sizeof connected);
  }

 private:
  const SegmentLayout& layout_;
  test::FreeSlot slot_;
  char* base_ = nullptr;
};

wire::CameraParams numbered(std::uint64_t n, const wire::CameraParams&) {
  wire::CameraParams p = test::params(n);
  const auto x = static_cast<double>(n);
  p.euler = {x, -x, x / 2, 1 / (x + 1), 3 * x, -x / 4};
  p.fov = 10 + x;
  p.center_x = x / 8;
  p.k2 = -x / 16;
  p.focdist = p.aperture = x;
  return p;
}
wire::CameraConstants numbered(std::uint64_t n, const wire::CameraConstants&) {
  wire::CameraConstants c = test::constants(720 + static_cast<int>(n));
  c.blank_left = c.blank_bottom = static_cast<int>(n);
  c.chip_height = c.fake_chip_width = 4 + static_cast<double>(n) / 64;
  return c;
}
std::uint64_t number_of(const wire::CameraParams& p) { return p.counter; }
std::uint64_t number_of(const wire::CameraConstants& c) { return static_cast<std::uint64_t>(c.image_width) - 720; }

/// Writes records with the numbers 1, 2, 3, … as a program of the field does, eight bytes a step.
template <typename Record>
class Writer {
 public:
  Writer(Memory& memory, std::size_t counter_at, const std::array<std::size_t, 2>& elements)
      : memory_(memory), counter_at_(counter_at), elements_(elements) {}

  /// The number of the last record that is there as a whole.
  std::uint64_t written() const { return written_; }
  void step() {
    auto* const counter = reinterpret_cast<std::uint16_t*>(memory_.at(counter_at_));
    const auto next = static_cast<std::uint16_t>(__atomic_load_n(counter, __ATOMIC_RELAXED) + 1U);
    if (copied_ == image_.size()) {
      if (!image_.empty()) {
        __atomic_store_n(counter, next, __ATOMIC_RELEASE);
        ++written_;
      }
      image_ = wire::to_image(numbered(written_ + 1, Record{}), memory_.layout().record, buffer_).value();
      copied_ = 0;
      return;
    }
    const std::size_t size = std::min<std::size_t>(8, image_.size() - copied_);
    std::memcpy(memory_.at(elements_[next & 1U]) + copied_, image_.data() + copied_, size);
    copied_ += size;
  }
  void finish() {
    const std::uint64_t before = written_;
    while (written_ == before) step();
  }

 private:
  Memory& memory_;
  std::size_t counter_at_;
  std::array<std::size_t, 2> elements_;
  wire::Buffer buffer_{};
  std::string_view image_;
  std::size_t copied_ = 0;
  std::uint64_t written_ = 0;
};

/// What is read is one of those records, none before it again, and as new as the last one before the read began.
template <typename Record>
class Reader {
 public:
  explicit Reader(const Writer<Record>& writer) : writer_(writer) {}

  void read(Link& link, const BetweenInstructions::Step& step) {
    const std::uint64_t before = writer_.written();
    Record record;
    transport::Fault fault;
    ReadResult result{};
    BetweenInstructions::run(step, [&] { result = link.read(record, fault); });
    const std::uint64_t after = writer_.written();
    if (result == ReadResult::nothing) {
      claim(before == last_, "a record that is not read");
    } else if (result == ReadResult::malformed) {
      claim(std::string_view(fault.name()) == "unsteady segment", "refused: " + describe(fault));
      claim(after - before >= 64, "gave up early");
    } else {
      const std::uint64_t number = number_of(record);
      claim(number > last_ && number >= before && number <= after, "a record of another time");
      claim(record == numbered(number, record), "a record that nobody wrote");
      last_ = number;
    }
  }

 private:
  const Writer<Record>& writer_;
  std::uint64_t last_ = 0;
};

/// Steps that the input says.
class Steps {
 public:
  Steps(Input& input, std::size_t most) : input_(input), left_(input.below(most)) {}
  /// After it, the instructions to the next one, which there may be.
  template <typename Do>
  std::optional<unsigned> next(const Do& act) {
    if (std::exchange(has_begun_, true)) act();
    if (left_ == 0) return std::nullopt;
    --left_;
    return static_cast<unsigned>(input_.below(32));
  }

 private:
  Input& input_;
  std::size_t left_;
  bool has_begun_ = false;
};

Link attached(const Memory& memory, Link::Clock::time_point now) {
  Link link(Link::Options{memory.slot(), nullptr, 0666, false});
  claim(link.keep(now).has_value(), "cannot attach");
  return link;
}

void run_with_writer_of_the_field(Input& input, Memory& memory) {
  const SegmentLayout& layout = memory.layout();
  Writer<wire::CameraParams> params(memory, layout.params_counter, layout.params);
  Writer<wire::CameraConstants> constants(memory, layout.constants_counter, layout.constants);
  const std::uint16_t begin = input.number<std::uint16_t>();
  std::memcpy(memory.at(layout.params_counter), &begin, sizeof begin);
  Link link = attached(memory, {});
  // They say which generation writes.
  constants.finish();
  Reader<wire::CameraParams> params_reader(params);
  Reader<wire::CameraConstants> constants_reader(constants);
  constants_reader.read(link, [] { return std::nullopt; });
  while (!input.is_empty()) {
    Steps steps(input, 256);
    const std::size_t kind = input.below(6);
    const auto step = [&] { return steps.next([&] { (kind % 2 == 0) ? params.step() : constants.step(); }); };
    if (kind < 2) {
      for (bool more = step().has_value(); more;) more = step().has_value();
    } else if (kind < 4) {
      params_reader.read(link, step);
    } else {
      constants_reader.read(link, step);
    }
  }
  params.finish();
  params_reader.read(link, [] { return std::nullopt; });
}

/// Random bytes are refused, or read as numbers that are finite. Records of a valid writer are read after its first
/// write.
void run_with_random_bytes(Input& input, Memory& memory) {
  Link::Clock::time_point now{};
  Link link = attached(memory, now);
  wire::CameraParams params;
  wire::CameraConstants constants;
  transport::Fault fault;
  const auto poke = [&] {
    const std::size_t offset = input.number<std::uint16_t>() % page_size;
    const std::string_view bytes = input.bytes(1 + input.below(16));
    std::memcpy(memory.at(offset), bytes.data(), std::min(bytes.size(), page_size - offset));
  };
  const auto claim_read = [&](ReadResult result, const auto& record) {
    if (result == ReadResult::malformed) claim(!describe(fault).empty(), "a fault without a description");
    if (result == ReadResult::fresh) claim(test::all_finite(record), "a number is not finite");
  };
  while (!input.is_empty()) {
    Steps steps(input, 16);
    const auto step = [&] { return steps.next(poke); };
    ReadResult result{};
    switch (input.below(5)) {
      case 0:
        poke();
        break;
      case 1:
        BetweenInstructions::run(step, [&] { result = link.read(params, fault); });
        claim_read(result, params);
        break;
      case 2:
        BetweenInstructions::run(step, [&] { result = link.read(constants, fault); });
        claim_read(result, constants);
        break;
      case 3:
        now += std::chrono::milliseconds(input.number<std::uint8_t>());
        if (const auto kept = link.keep(now); !kept) claim(!describe(kept.error()).empty(), "a fault without a word");
        break;
      case 4:
        if (link.segment() == nullptr) break;
        static_cast<void>(link.segment()->wait_for_write());
        static_cast<void>(link.segment()->is_announced());
        static_cast<void>(link.segment()->has_32_bit_program());
        break;
    }
  }
  memory.make_header();
  if (!link.keep(now + Link::check_period)) return;
  auto segment = shm::Segment::attach(memory.slot());
  claim(segment.has_value(), "cannot attach to a segment that is sound again");
  static_cast<void>(link.read(constants, fault));
  const wire::CameraConstants good = test::constants();
  claim(segment->write(good) && link.read(constants, fault) == ReadResult::fresh && constants == good,
        "sound constants that are not read");
  static_cast<void>(link.read(params, fault));
  const wire::CameraParams set = test::params(7);
  claim(segment->write(set) && link.read(params, fault) == ReadResult::fresh && params == set,
        "sound parameters that are not read");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<std::size_t, 4> sizes{544, 528, 524, 508};
  Input input(data, size);
  const std::size_t kind = input.below(8);
  Memory memory(*shm::layout_of_size(sizes[kind % 4]));
  kind < 4 ? run_with_writer_of_the_field(input, memory) : run_with_random_bytes(input, memory);
  return 0;
}
