// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "segment.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <utility>

#include <climits>

#include <linux/futex.h>
#include <sys/shm.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "slot.h"

namespace trk_bridge::shm {
namespace {

void* const no_memory = reinterpret_cast<void*>(-1);

std::uint64_t magic_in(char* base, const SegmentLayout& layout) noexcept {
  if (layout.magic_size == 8) return __atomic_load_n(shared<std::uint64_t>(base, 0), __ATOMIC_ACQUIRE);
  return __atomic_load_n(shared<std::uint32_t>(base, 0), __ATOMIC_ACQUIRE);
}

template <typename Word>
void copy_out_by(char* from, std::size_t size, char* to) noexcept {
#pragma GCC unroll 8
  for (std::size_t i = 0; i < size; i += sizeof(Word)) {
    const Word word = __atomic_load_n(shared<Word>(from, i), __ATOMIC_RELAXED);
    std::memcpy(to + i, &word, sizeof word);
  }
}

template <typename Word>
void copy_in_by(const char* from, std::size_t size, char* to) noexcept {
#pragma GCC unroll 8
  for (std::size_t i = 0; i < size; i += sizeof(Word)) {
    Word word = 0;
    std::memcpy(&word, from + i, sizeof word);
    __atomic_store_n(shared<Word>(to, i), word, __ATOMIC_RELAXED);
  }
}

// The segment begins at a page boundary, and all sizes and offsets are multiples of 4 bytes.
bool is_of_long_words(const char* shared, std::size_t size) noexcept {
  return reinterpret_cast<std::uintptr_t>(shared) % sizeof(std::uint64_t) == 0 && size % sizeof(std::uint64_t) == 0;
}

void copy_words_out(char* from, std::size_t size, char* to) noexcept {
  if (is_of_long_words(from, size)) return copy_out_by<std::uint64_t>(from, size, to);
  copy_out_by<std::uint32_t>(from, size, to);
}

void copy_words_in(const char* from, std::size_t size, char* to) noexcept {
  if (is_of_long_words(to, size)) return copy_in_by<std::uint64_t>(from, size, to);
  copy_in_by<std::uint32_t>(from, size, to);
}

// Does not check `connected`: a creator may count itself before it writes the magic.
bool is_unwritten(char* base, const SegmentLayout& layout) noexcept {
  const std::size_t size = layout.size - layout.params_counter;
  std::array<char, 1024> bytes{};
  copy_words_out(base + layout.params_counter, size, bytes.data());
  return std::all_of(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size), [](char c) { return c == 0; });
}

bool may_remove(const shmid_ds& state) noexcept {
  const uid_t me = ::geteuid();
  return me == 0 || me == state.shm_perm.uid || me == state.shm_perm.cuid;
}

bool means(int slot, int id) noexcept {
  const auto found = find_segment(slot);
  return found && found->id == id;
}

bool has_no_attachments(int id) noexcept {
  shmid_ds state{};
  return ::shmctl(id, IPC_STAT, &state) == 0 && state.shm_nattch == 0 && may_remove(state);
}

// Moves the file first: programs that open the slot from then on create a new file with another key, and programs that
// attached to this segment before are seen by a second check. Only a program that attaches between this check and the
// removal is missed. A file that may not be moved is kept with its segment: existing programs cannot open a slot that
// has only a file.
void remove_if_last(int slot, int id) noexcept {
  if (!has_no_attachments(id)) return;
  const auto found = find_segment(slot);
  if (!found || found->id != id) {
    ::shmctl(id, IPC_RMID, nullptr);
    return;
  }
  const auto spare = SpareFile::make(slot);
  if (!spare) return;
  if (!spare->take_slot_file()) {
    if (errno == ENOENT && has_no_attachments(id)) ::shmctl(id, IPC_RMID, nullptr);
    return;
  }
  // Another process may have done the same, and a third one may have recreated the slot.
  const bool is_its_file = ::ftok(spare->c_str(), 0) == found->key;
  const bool removes = has_no_attachments(id);
  if (removes) ::shmctl(id, IPC_RMID, nullptr);
  if (!removes || !is_its_file) static_cast<void>(spare->become_slot_file());
}

struct Mapping {
  char* base = nullptr;
  bool writable = true;
};

tl::expected<Mapping, SlotFault> map(int slot, int id) noexcept {
  Mapping mapping;
  void* base = ::shmat(id, nullptr, 0);
  if (base == no_memory && errno == EACCES) {
    mapping.writable = false;
    base = ::shmat(id, nullptr, SHM_RDONLY);
  }
  if (base == no_memory) {
    const bool gone = errno == EINVAL || errno == EIDRM;
    return tl::unexpected(gone ? slot_fault(SlotProblem::no_segment, slot) : system_fault(slot));
  }
  mapping.base = static_cast<char*>(base);
  return mapping;
}

tl::expected<void, SlotFault> check_magic(int slot, char* base, const SegmentLayout& layout) noexcept {
  std::uint64_t magic = magic_in(base, layout);
  const bool unfinished = magic == 0 && is_unwritten(base, layout);
  // Its creator may have finished it meanwhile.
  if (magic == 0) magic = magic_in(base, layout);
  if (magic == segment_magic) return {};
  SlotFault fault = slot_fault(unfinished ? SlotProblem::unfinished : SlotProblem::foreign, slot);
  fault.size = layout.size;
  fault.magic = magic;
  return tl::unexpected(fault);
}

bool is_dead(pid_t process) noexcept { return process > 0 && ::kill(process, 0) != 0 && errno == ESRCH; }

}  // namespace

Segment::Segment(int slot, int id, char* base, const SegmentLayout& layout, bool writable) noexcept
    : slot_(slot), id_(id), base_(base), layout_(&layout), writable_(writable), owner_(::getpid()) {}

Segment::Segment(Segment&& other) noexcept
    : slot_(other.slot_),
      id_(other.id_),
      base_(std::exchange(other.base_, nullptr)),
      layout_(other.layout_),
      writable_(other.writable_),
      counted_(std::exchange(other.counted_, false)),
      owner_(other.owner_) {}

Segment& Segment::operator=(Segment&& other) noexcept {
  if (this == &other) return *this;
  close();
  slot_ = other.slot_;
  id_ = other.id_;
  base_ = std::exchange(other.base_, nullptr);
  layout_ = other.layout_;
  writable_ = other.writable_;
  counted_ = std::exchange(other.counted_, false);
  owner_ = other.owner_;
  return *this;
}

tl::expected<Segment, SlotFault> Segment::attach(int slot) noexcept {
  const auto found = find_segment(slot);
  if (!found) return tl::unexpected(found.error());
  const SegmentLayout* layout = layout_of_size(found->state.shm_segsz);
  if (layout == nullptr) {
    SlotFault fault = slot_fault(SlotProblem::foreign, slot);
    fault.size = found->state.shm_segsz;
    return tl::unexpected(fault);
  }
  if (const auto unshared = check_unshared(slot, found->key); !unshared) return tl::unexpected(unshared.error());
  const auto mapping = map(slot, found->id);
  if (!mapping) return tl::unexpected(mapping.error());
  if (const auto checked = check_magic(slot, mapping->base, *layout); !checked) {
    ::shmdt(mapping->base);
    return tl::unexpected(checked.error());
  }
  Segment segment(slot, found->id, mapping->base, *layout, mapping->writable);
  segment.count_in();
  segment.correct_count();
  // The last user may have removed it between the look-up and the attachment.
  if (segment.status(true) != SegmentStatus::current) return tl::unexpected(slot_fault(SlotProblem::no_segment, slot));
  return segment;
}

tl::expected<Segment, SlotFault> Segment::create(int slot, const SegmentLayout& layout, int mode) noexcept {
  const auto key = slot_key(slot);
  if (!key) return tl::unexpected(key.error());
  if (const auto unshared = check_unshared(slot, *key); !unshared) return tl::unexpected(unshared.error());
  const int id = ::shmget(*key, layout.size, IPC_CREAT | IPC_EXCL | mode);
  if (id < 0) return tl::unexpected(errno == EEXIST ? slot_fault(SlotProblem::exists, slot) : system_fault(slot));
  const auto mapping = map(slot, id);
  if (!mapping || !mapping->writable) {
    if (mapping) ::shmdt(mapping->base);
    ::shmctl(id, IPC_RMID, nullptr);
    return tl::unexpected(mapping ? SlotFault{SlotProblem::system, slot, 0, 0, 0, EACCES} : mapping.error());
  }
  Segment segment(slot, id, mapping->base, layout, true);
  segment.finish();
  // If somebody removed the file during the creation, no program can find the segment.
  if (!means(slot, id)) {
    ::shmctl(id, IPC_RMID, nullptr);
    return tl::unexpected(slot_fault(SlotProblem::exists, slot));
  }
  return segment;
}

tl::expected<Segment, SlotFault> Segment::adopt(int slot) noexcept {
  const auto found = find_segment(slot);
  if (!found) return tl::unexpected(found.error());
  const SegmentLayout* layout = layout_of_size(found->state.shm_segsz);
  SlotFault unfinished = slot_fault(SlotProblem::unfinished, slot);
  unfinished.size = found->state.shm_segsz;
  if (layout == nullptr || found->state.shm_nattch != 0 || !is_dead(found->state.shm_cpid)) {
    return tl::unexpected(unfinished);
  }
  const auto mapping = map(slot, found->id);
  if (!mapping) return tl::unexpected(mapping.error());
  Segment segment(slot, found->id, mapping->base, *layout, mapping->writable);
  const bool is_unfinished = magic_in(segment.base_, *layout) == 0 && is_unwritten(segment.base_, *layout);
  if (!mapping->writable || !is_unfinished || segment.attachments() != 1) {
    ::shmdt(segment.release());
    return tl::unexpected(unfinished);
  }
  segment.finish();
  return segment;
}

tl::expected<Segment, SlotFault> Segment::attach_or_create(int slot, const SegmentLayout& layout, int mode) noexcept {
  auto segment = attach(slot);
  if (segment) return segment;
  const SlotProblem problem = segment.error().problem;
  if (problem == SlotProblem::unfinished) return adopt(slot);
  if (problem == SlotProblem::no_file || problem == SlotProblem::key_zero) {
    const bool replace = problem == SlotProblem::key_zero;
    if (const auto made = make_slot_file(slot, replace); !made) return tl::unexpected(made.error());
  } else if (problem != SlotProblem::no_segment) {
    return segment;
  }
  segment = create(slot, layout, mode);
  const bool others_did = !segment && segment.error().problem == SlotProblem::exists;
  return others_did ? attach(slot) : std::move(segment);
}

void Segment::count_in() noexcept {
  if (!writable_) return;
  __atomic_add_fetch(shared<std::int32_t>(base_, layout_->connected), 1, __ATOMIC_ACQ_REL);
  counted_ = true;
}

// Only if it has not changed since it was read: a process that attaches or detaches at this moment continues from the
// right number.
void Segment::correct_count() noexcept {
  if (!writable_) return;
  auto* const connected = shared<std::int32_t>(base_, layout_->connected);
  std::int32_t seen = __atomic_load_n(connected, __ATOMIC_ACQUIRE);
  const auto truth = static_cast<std::int32_t>(attachments());
  if (truth > 0 && seen != truth) {
    __atomic_compare_exchange_n(connected, &seen, truth, false, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED);
  }
}

// After the magic is written, others can attach and detach at once; `connected` must not be 0 then.
void Segment::finish() noexcept {
  count_in();
  if (layout_->magic_size == 8) {
    __atomic_store_n(shared<std::uint64_t>(base_, 0), std::uint64_t{segment_magic}, __ATOMIC_RELEASE);
  } else {
    __atomic_store_n(shared<std::uint32_t>(base_, 0), segment_magic, __ATOMIC_RELEASE);
  }
  correct_count();
}

char* Segment::release() noexcept {
  counted_ = false;
  return std::exchange(base_, nullptr);
}

void Segment::close() noexcept {
  if (base_ == nullptr) return;
  if (counted_ && owner_ == ::getpid()) {
    __atomic_sub_fetch(shared<std::int32_t>(base_, layout_->connected), 1, __ATOMIC_ACQ_REL);
  }
  // Detaches before it checks the count: if two processes detach at the same time, one of them sees that it is the
  // last.
  ::shmdt(release());
  remove_if_last(slot_, id_);
}

std::int32_t Segment::connected() const noexcept {
  return __atomic_load_n(shared<std::int32_t>(base_, layout_->connected), __ATOMIC_ACQUIRE);
}

AttachInfo Segment::attach_info() const noexcept {
  shmid_ds state{};
  return ::shmctl(id_, IPC_STAT, &state) == 0 ? attach_info_of(state) : AttachInfo{};
}

bool Segment::has_32_bit_program() const noexcept { return magic_in(base_, *layout_) != segment_magic; }

SegmentStatus Segment::status(bool look_up) const noexcept {
  shmid_ds state{};
  if (::shmctl(id_, IPC_STAT, &state) != 0) {
    if (errno == EINVAL || errno == EIDRM) return SegmentStatus::removed;
  } else if ((state.shm_perm.mode & SHM_DEST) != 0) {
    return SegmentStatus::removed;
  }
  if (!look_up) return SegmentStatus::current;
  const auto found = find_segment(slot_);
  return found && found->id != id_ ? SegmentStatus::replaced : SegmentStatus::current;
}

bool Segment::copy(std::size_t counter_at, std::array<std::size_t, 2> SegmentLayout::*elements,
                   std::size_t SegmentLayout::*size, RecordImage& into) const noexcept {
  const SegmentLayout* const smaller = smaller_generation(*layout_);
  const SegmentLayout& other = smaller != nullptr ? *smaller : *layout_;
  into.size = layout_->*size;
  return copy_unchanged(counter_at, into.counter, [&](std::size_t element) {
    const Range range = range_of(layout_->*elements, layout_->*size, other.*elements, other.*size, element);
    into.begin = range.begin;
    into.at = (layout_->*elements)[element];
    copy_words_out(base_ + range.begin, range.end - range.begin, into.bytes.data());
  });
}

bool Segment::copy_params(RecordImage& into) const noexcept {
  return copy(layout_->params_counter, &SegmentLayout::params, &SegmentLayout::params_size, into);
}

bool Segment::copy_constants(RecordImage& into) const noexcept {
  return copy(layout_->constants_counter, &SegmentLayout::constants, &SegmentLayout::constants_size, into);
}

bool Segment::is_announced() const noexcept {
  // In this order, because a writer stores the announcement first.
  const std::uint16_t counter = params_counter();
  const std::uint32_t announced =
      __atomic_load_n(shared<std::uint32_t>(base_, page_rest::announcement), __ATOMIC_ACQUIRE);
  const auto ahead = static_cast<std::uint16_t>(announced - counter);
  constexpr std::uint16_t most_between_two_loads = 16;
  return (announced & 0xFFFF0000U) == announcement_mark && ahead < most_between_two_loads;
}

Segment::Waiter Segment::wait_for_write() const noexcept {
  auto* const word = shared<std::uint32_t>(base_, page_rest::wake_word);
  return {word, __atomic_fetch_or(word, 1U, __ATOMIC_SEQ_CST) | 1U};
}

void Segment::wake(std::uint32_t value) noexcept {
  auto* const word = shared<std::uint32_t>(base_, page_rest::wake_word);
  // If it fails, another writer has done the same.
  if (!__atomic_compare_exchange_n(word, &value, value + 1, false, __ATOMIC_SEQ_CST, __ATOMIC_RELAXED)) return;
  ::syscall(SYS_futex, word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

void Segment::put(std::size_t counter_at, const std::array<std::size_t, 2>& elements, std::string_view image) noexcept {
  put(counter_at, [&](std::size_t element) { copy_words_in(image.data(), image.size(), base_ + elements[element]); });
}

tl::expected<void, wire::Fault> Segment::write(const wire::CameraParams& params) noexcept {
  wire::Buffer buffer;
  const auto image = wire::to_image(params, layout_->record, buffer);
  if (!image) return tl::unexpected(image.error());
  announce();
  put(layout_->params_counter, layout_->params, *image);
  return {};
}

tl::expected<void, wire::Fault> Segment::write(const wire::CameraConstants& constants) noexcept {
  wire::Buffer buffer;
  const auto image = wire::to_image(constants, layout_->record, buffer);
  if (!image) return tl::unexpected(image.error());
  put(layout_->constants_counter, layout_->constants, *image);
  return {};
}

tl::expected<void, SlotFault> Segment::recreate(int mode) noexcept {
  const std::size_t body = layout_->params_counter;
  std::array<char, 1024> contents{};
  copy_words_out(base_ + body, layout_->size - body, contents.data());
  if (::shmctl(id_, IPC_RMID, nullptr) != 0) {
    const SlotFault fault = system_fault(slot_);
    close();
    return tl::unexpected(fault);
  }
  const SegmentLayout& layout = *layout_;
  const int slot = slot_;
  close();
  auto fresh = attach_or_create(slot, layout, mode);
  if (!fresh) return tl::unexpected(fresh.error());
  const bool untouched = fresh->params_counter() == 0 && fresh->constants_counter() == 0;
  if (untouched && fresh->layout_ == &layout) {
    // Counters last: a reader that attaches meanwhile finds either nothing or everything.
    constexpr std::size_t counters = 4;
    copy_words_in(contents.data() + counters, layout.size - body - counters, fresh->base_ + body + counters);
    std::atomic_thread_fence(std::memory_order_release);
    copy_words_in(contents.data(), counters, fresh->base_ + body);
  }
  *this = std::move(*fresh);
  return {};
}

}  // namespace trk_bridge::shm
