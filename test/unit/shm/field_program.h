// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// An existing program at a slot: it opens, writes and closes like the protocol's original sources, in its layout,
// independent of the size of an existing segment.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include <sys/shm.h>

#include "free_slot.h"
#include "shm/segment.h"

namespace trk_bridge::test {

class FieldProgram {
 public:
  FieldProgram(FreeSlot& slot, const shm::SegmentLayout& layout) : slot_(slot), layout_(layout) {}
  ~FieldProgram() { close(); }
  FieldProgram(const FieldProgram&) = delete;
  FieldProgram& operator=(const FieldProgram&) = delete;

  /// Attaches, or creates file and segment. False: the existing segment is too small, or does not look like trk.
  bool open() {
    slot_.make_file();
    const key_t key = ::ftok(slot_.path().c_str(), 0);
    id_ = ::shmget(key, layout_.size, IPC_CREAT | 0666);
    if (id_ < 0) return false;
    base_ = static_cast<char*>(::shmat(id_, nullptr, 0));
    if (base_ == reinterpret_cast<char*>(-1)) return std::exchange(base_, nullptr) != nullptr;
    std::uint64_t magic = 0;
    std::memcpy(&magic, base_, layout_.magic_size);
    if (magic == 0) {
      magic = shm::segment_magic;
      std::memcpy(base_, &magic, layout_.magic_size);
    } else if (magic != shm::segment_magic) {
      ::shmdt(std::exchange(base_, nullptr));
      return false;
    }
    connected() += 1;
    return true;
  }

  /// The last program, according to `connected`, removes segment and file.
  void close() {
    if (base_ == nullptr) return;
    const bool is_last = --connected() == 0;
    ::shmdt(std::exchange(base_, nullptr));
    if (!is_last) return;
    ::shmctl(id_, IPC_RMID, nullptr);
    ::unlink(slot_.path().c_str());
  }

  void write(const wire::CameraParams& params) {
    wire::Buffer buffer;
    put(layout_.params_counter, layout_.params, wire::to_image(params, layout_.record, buffer).value());
  }
  void write(const wire::CameraConstants& constants) {
    wire::Buffer buffer;
    put(layout_.constants_counter, layout_.constants, wire::to_image(constants, layout_.record, buffer).value());
  }

  int id() const { return id_; }
  bool is_attached_to_a_removed_one() const {
    shmid_ds state{};
    return ::shmctl(id_, IPC_STAT, &state) != 0 || (state.shm_perm.mode & SHM_DEST) != 0;
  }
  std::int32_t& connected() { return *reinterpret_cast<std::int32_t*>(base_ + layout_.connected); }

 private:
  void put(std::size_t counter_at, const std::array<std::size_t, 2>& elements, std::string_view image) {
    auto* const counter = reinterpret_cast<std::uint16_t*>(base_ + counter_at);
    const auto next = static_cast<std::uint16_t>(__atomic_load_n(counter, __ATOMIC_RELAXED) + 1U);
    std::memcpy(base_ + elements[next & 1U], image.data(), image.size());
    __atomic_store_n(counter, next, __ATOMIC_RELEASE);
  }

  FreeSlot& slot_;
  const shm::SegmentLayout& layout_;
  int id_ = -1;
  char* base_ = nullptr;
};

}  // namespace trk_bridge::test
