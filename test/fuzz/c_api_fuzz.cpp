// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any calls of the C interface in any order, with valid and invalid arguments: what they return is what the headers
// say, and the handles that are open stay usable.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "c_records.h"
#include "c_texts.h"
#include "free_slot.h"
#include "fuzz.h"
#include "reserved_port.h"
#include "temporary_directory.h"
#include "trk_file.h"
#include "trk_mem.h"
#include "trk_net.h"

namespace {

using namespace trk_bridge;
using test::claim;
using test::Input;
using test::is_finite;
using test::or_null;
using test::text_of;

enum class Kind : std::uint8_t { net_reader, net_writer, memory, playback, recording };

struct Handle {
  Kind kind;
  trkHandle handle;
  bool is_open = true;
};

bool is_writable(const trkCameraConstants& c) { return is_finite(c); }
bool is_writable(const trkCameraParams& p) {
  return is_finite(p) && (p.format & ~0x3ffU) == 0 && (p.format & (trkVertical | trkDiagonal)) != 0x060;
}

/// What a datagram or a take has of a record in ASCII: of a matrix, not the last row.
trkCameraConstants as_text(const trkCameraConstants& c) { return c; }
trkCameraParams as_text(trkCameraParams p) {
  if ((p.format & trkEuler) != 0) return p;
  for (auto& column : p.t.m) column[3] = 0;
  return p;
}

class Program {
 public:
  explicit Program(Input& input) : input_(input) {}

  void run() {
    // Of each function once, so that none is missing.
    trkMemConfigure(trkMemDefault);
    for (int calls = 0; !input_.is_empty() && calls < 200; ++calls) call();
    finish();
  }

 private:
  void call() {
    switch (input_.below(10)) {
      case 0:
        open_net();
        break;
      case 1:
        open_memory();
        break;
      case 2:
        open_file();
        break;
      case 3:
        close();
        break;
      case 4:
      case 5:
        write_params();
        break;
      case 6:
        write_constants();
        break;
      case 7:
      case 8:
        read();
        break;
      case 9:
        test::use_texts(input_);
        break;
    }
  }

  void opened(Kind kind, trkError got, bool may_succeed, trkHandle handle) {
    claim(got == trkOK || got == trkFailed || got == trkInvalidVersion, "an open that gives " + std::to_string(got));
    claim(got != trkOK || may_succeed, "opened with invalid arguments");
    if (got != trkOK) {
      claim(handle == nullptr, "a handle of an open that failed");
      return;
    }
    claim(handle != nullptr && find(handle) == nullptr, "a handle that was used before");
    handles_.push_back({kind, handle});
  }

  void open_net() {
    const int ports[] = {port_.number(), port_.number(), port_.number(), 0, -1, 65536, 1 << 20};
    const int port = ports[input_.below(std::size(ports))];
    const bool is_port = port == port_.number();
    trkHandle handle = nullptr;
    trkHandle* const into = or_null(input_, handle);
    if (input_.flag()) {
#ifdef TRK_IDENTIFIED
      const trkError got = trkNetOpenRead(port, into, static_cast<int>(input_.below(2)));
#else
      const trkError got = trkNetOpenRead(port, into);
#endif
      opened(Kind::net_reader, got, is_port && into != nullptr, handle);
      return;
    }
    const char* const hosts[] = {"127.0.0.1", "127.0.0.1", "127.0.0.2", "", nullptr};
    const std::size_t host = input_.below(std::size(hosts));
    const trkError got = trkNetOpenWrite(hosts[host], port, static_cast<int>(input_.below(3)), into);
    opened(Kind::net_writer, got, host < 3 && is_port && into != nullptr, handle);
  }

  void open_memory() {
    if (input_.below(4) == 0) trkMemConfigure(input_.number<std::uint8_t>());
    const int slots[] = {slot_.number(), slot_.number(), slot_.number(), -1, 62, 1 << 20};
    const int slot = slots[input_.below(std::size(slots))];
    trkHandle handle = nullptr;
    trkHandle* const into = or_null(input_, handle);
    const trkError got = trkMemOpen(slot, into);
    const bool is_valid = slot == slot_.number() && into != nullptr;
    opened(Kind::memory, got, is_valid, handle);
    claim(got == trkOK || !is_valid, "a slot that cannot be opened");
  }

  std::string any_path() {
    const std::string paths[] = {files_ / "a.trk", files_ / "b.trk", files_ / "none" + "/a.trk", files_.path(), ""};
    return paths[input_.below(std::size(paths))];
  }

  void open_file() {
    trkHandle handle = nullptr;
    trkHandle* const into = or_null(input_, handle);
    const std::string path = any_path();
    const char* const name = input_.below(16) == 0 ? nullptr : path.c_str();
    switch (input_.below(3)) {
      case 0: {
        if (path == files_.path() || path.empty()) break;
        const std::string_view contents = input_.bytes(input_.number<std::uint16_t>() % 1000);
        std::ofstream(path, std::ios::binary) << "DMC01\n10:00:00:00:1\n720 576 0 0 0 0 8 6 8 6\n" << contents;
        break;
      }
      case 1: {
        std::vector<char> code(trkTimeCodeSize, '?');
        trkCameraConstants constants{};
        const trkError got = trkFileOpenRead(name, or_null(input_, code[0]), or_null(input_, constants), into);
        opened(Kind::playback, got, name != nullptr && into != nullptr, handle);
        if (got == trkOK) claim(std::strlen(code.data()) < trkTimeCodeSize && is_finite(constants), "an invalid head");
        break;
      }
      case 2: {
        const char* const codes[] = {"10:20:30:12:1", "10:20:30;12:1", "25:00:00:00:1", "", nullptr};
        trkCameraConstants constants = any_constants();
        const std::size_t code = input_.below(std::size(codes));
        const trkError got = trkFileOpenWrite(name, codes[code], or_null(input_, constants), into);
        opened(Kind::recording, got, name != nullptr && code < 2 && is_writable(constants) && into != nullptr, handle);
        break;
      }
    }
  }

  Handle* find(trkHandle handle) {
    const auto found =
        std::find_if(handles_.begin(), handles_.end(), [&](const Handle& one) { return one.handle == handle; });
    return found == handles_.end() ? nullptr : &*found;
  }
  bool is_open(trkHandle handle, Kind kind) {
    const Handle* const found = find(handle);
    return found != nullptr && found->is_open && found->kind == kind;
  }

  trkHandle any_handle() {
    const std::size_t which = input_.number<std::uint8_t>();
    if (which < 8) return nullptr;
    if (which < 16) return reinterpret_cast<trkHandle>(input_.number<std::uintptr_t>());
    if (handles_.empty()) return nullptr;
    return handles_[which % handles_.size()].handle;
  }

  void close() {
    const trkHandle handle = any_handle();
    switch (input_.below(8)) {
      case 0:
        trkMemCloseAll();
        for (Handle& one : handles_) one.is_open = one.is_open && one.kind != Kind::memory;
        break;
      case 1:
      case 2:
        closed(trkMemClose(handle), handle, Kind::memory, Kind::memory);
        break;
      case 3:
      case 4:
        closed(trkFileClose(handle), handle, Kind::playback, Kind::recording);
        break;
      default:
        closed(trkNetClose(handle), handle, Kind::net_reader, Kind::net_writer);
        break;
    }
  }
  void closed(trkError got, trkHandle handle, Kind one, Kind other) {
    if (!is_open(handle, one) && !is_open(handle, other)) {
      claim(got == trkInvalidHandle, "closed without being open");
      return;
    }
    claim(got == trkOK || (got == trkFailed && is_open(handle, Kind::recording)), "a close that fails");
    find(handle)->is_open = false;
  }

  trkCameraParams any_params() {
    trkCameraParams params = test::params_in_c(input_.number<std::uint8_t>());
    switch (input_.below(4)) {
      case 0:
        params.format = input_.number<std::uint32_t>();
        break;
      case 1: {
        const std::string_view bytes = input_.bytes(sizeof params);
        std::memcpy(&params, bytes.data(), bytes.size());
        break;
      }
      case 2:
        params.format = static_cast<unsigned>(input_.number<std::uint16_t>()) & 0x3ffU;
        params.k2 = input_.number<double>();
        break;
      default:
        break;
    }
    return params;
  }
  trkCameraConstants any_constants() {
    trkCameraConstants constants = test::constants_in_c;
    if (input_.flag()) return constants;
    const std::string_view bytes = input_.bytes(sizeof constants);
    std::memcpy(&constants, bytes.data(), bytes.size());
    return constants;
  }

  /// What a function of a handle gives: 0 to 4, trkInvalidHandle for those that are none and for those alone, trkFailed
  /// for null pointers.
  void claim_result(trkError got, trkHandle handle, Kind kind, bool has_null) {
    claim(got >= trkOK && got <= trkUnavailable, "no result of the interface: " + std::to_string(got));
    claim(std::strlen(trkErrorMessage(got)) > 0, "a result without a text");
    if (!is_open(handle, kind)) {
      claim(got == trkInvalidHandle || (has_null && got == trkFailed), "a handle that is not open, and used");
    } else {
      claim(got != trkInvalidHandle, "a handle that is open, and refused");
      if (has_null) claim(got == trkFailed, "a null pointer that is accepted");
    }
  }

  /// Of a write: refused if the record is invalid; if it is valid, only by the system and by files.
  template <typename Record>
  void claim_write(trkError got, trkHandle handle, Kind kind, const Record* record) {
    claim_result(got, handle, kind, record == nullptr);
    if (record == nullptr || !is_open(handle, kind)) return;
    claim(got == trkOK || got == trkFailed, "a write that gives " + std::to_string(got));
    if (!is_writable(kind == Kind::memory ? *record : as_text(*record))) {
      claim(got == trkFailed, "an invalid record was written");
    } else if (kind == Kind::memory) {
      claim(got == trkOK, "a valid record that is not written");
    }
  }

  void write_params() {
    const trkHandle handle = any_handle();
    trkCameraParams params = any_params();
    const trkCameraParams* const given = or_null(input_, params);
    trkError got = trkOK;
    switch (input_.below(3)) {
      case 0:
        got = trkNetWriteParams(handle, given);
        if (got == trkOK) sent_params_.insert(text_of(params));
        return claim_write(got, handle, Kind::net_writer, given);
      case 1:
        got = trkMemWriteParams(handle, given);
        if (got == trkOK) kept_params_.insert(text_of(params));
        return claim_write(got, handle, Kind::memory, given);
      case 2:
        got = trkFileWriteParams(handle, given);
        return claim_write(got, handle, Kind::recording, given);
    }
  }
  void write_constants() {
    const trkHandle handle = any_handle();
    trkCameraConstants constants = any_constants();
    const trkCameraConstants* const given = or_null(input_, constants);
    if (input_.flag()) {
      const trkError got = trkNetWriteConstants(handle, given);
      if (got == trkOK) sent_constants_.insert(text_of(constants));
      return claim_write(got, handle, Kind::net_writer, given);
    }
    const trkError got = trkMemWriteConstants(handle, given);
    if (got == trkOK) kept_constants_.insert(text_of(constants));
    claim_write(got, handle, Kind::memory, given);
  }

  template <typename Record>
  void claim_read(trkError got, trkHandle handle, Kind kind, const Record* record,
                  const std::set<std::string>* written) {
    claim_result(got, handle, kind, record == nullptr);
    if (got != trkOK) return;
    claim(is_finite(*record), "a number is not finite");
    if (written != nullptr) claim(written->count(text_of(*record)) != 0, "a record that nobody wrote");
  }

  void read() {
    const trkHandle handle = any_handle();
    trkCameraParams params{};
    trkCameraConstants constants{};
    trkCameraParams* const into = or_null(input_, params);
    trkCameraConstants* const into_constants = or_null(input_, constants);
    switch (input_.below(7)) {
      case 0:
        return claim_read(trkNetReadParams(handle, into), handle, Kind::net_reader, into, &sent_params_);
      case 1: {
        const int passed = input_.number<std::int8_t>(), tolerated = input_.number<std::int8_t>();
        const trkError got = trkNetBufReadParams(handle, into, passed, tolerated);
        if (is_open(handle, Kind::net_reader) && (passed < 0 || tolerated < 0)) {
          return claim(got == trkFailed, "a negative number that is accepted");
        }
        return claim_read(got, handle, Kind::net_reader, into, &sent_params_);
      }
      case 2:
        return claim_read(trkNetReadConstants(handle, into_constants), handle, Kind::net_reader, into_constants,
                          &sent_constants_);
      case 3:
        return claim_read(trkMemReadParams(handle, into), handle, Kind::memory, into, &kept_params_);
      case 4:
        return claim_read(trkMemReadConstants(handle, into_constants), handle, Kind::memory, into_constants,
                          &kept_constants_);
      case 5:
        return claim_read(trkFileReadParams(handle, into), handle, Kind::playback, into, nullptr);
      case 6:
#ifdef TRK_IDENTIFIED
        trkNetSkipOld(static_cast<int>(input_.below(2)), handle);
        const int queued = trkNetParamsAvailable(handle);
        claim(queued >= 0 && queued <= 16 && (queued == 0 || is_open(handle, Kind::net_reader)),
              "a wrong number queued");
        claim_read(trkNetReadConstants2(handle, into_constants), handle, Kind::net_reader, into_constants,
                   &sent_constants_);
        if (queued > 0) claim(trkNetReadParams(handle, &params) == trkOK, "what is queued is not there");
#endif
        break;
    }
  }

  /// Every handle that is open takes one more record, ends, and is none from then on.
  void finish() {
    for (Handle& one : handles_) {
      if (!one.is_open) continue;
      const trkCameraParams params = test::params_in_c(1);
      const trkCameraConstants constants = test::constants_in_c;
      trkCameraParams read{};
      switch (one.kind) {
        case Kind::net_reader:
          claim(trkNetReadParams(one.handle, &read) != trkInvalidHandle, "a reader that is lost");
          closed(trkNetClose(one.handle), one.handle, one.kind, one.kind);
          claim(trkNetReadParams(one.handle, &read) == trkInvalidHandle, "a closed reader");
          break;
        case Kind::net_writer:
          claim_write(trkNetWriteConstants(one.handle, &constants), one.handle, one.kind, &constants);
          closed(trkNetClose(one.handle), one.handle, one.kind, one.kind);
          claim(trkNetWriteParams(one.handle, &params) == trkInvalidHandle, "a closed writer");
          break;
        case Kind::memory:
          claim(trkMemWriteConstants(one.handle, &constants) == trkOK, "memory that cannot be written any more");
          claim(trkMemWriteParams(one.handle, &params) == trkOK, "memory that cannot be written any more");
          claim(trkMemReadParams(one.handle, &read) == trkOK && text_of(read) == text_of(params),
                "memory that cannot be read any more");
          closed(trkMemClose(one.handle), one.handle, one.kind, one.kind);
          claim(trkMemReadParams(one.handle, &read) == trkInvalidHandle, "closed memory");
          break;
        case Kind::playback:
          claim(trkFileReadParams(one.handle, &read) != trkInvalidHandle, "a file that is lost");
          closed(trkFileClose(one.handle), one.handle, one.kind, one.kind);
          break;
        case Kind::recording:
          claim_write(trkFileWriteParams(one.handle, &params), one.handle, one.kind, &params);
          closed(trkFileClose(one.handle), one.handle, one.kind, one.kind);
          break;
      }
      claim(trkNetClose(one.handle) == trkInvalidHandle && trkMemClose(one.handle) == trkInvalidHandle &&
                trkFileClose(one.handle) == trkInvalidHandle,
            "closed twice");
    }
    claim(!slot_.has_file(), "memory that nobody has open is left behind");
  }

  Input& input_;
  const test::TemporaryDirectory files_;
  test::FreeSlot slot_;
  inline static const test::ReservedPort port_;
  std::vector<Handle> handles_;
  std::set<std::string> sent_params_, sent_constants_, kept_params_, kept_constants_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  Program(input).run();
  return 0;
}
