// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a bag: its records one after another, and what its index says.
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "bag/reader.h"
#include "bag/scan.h"
#include "fuzz.h"
#include "memory_file.h"

namespace {

using namespace trk_bridge;
using bag::BagError;
using bag::Connection;
using bag::RawMessage;
using test::claim;

/// A message and where it came.
using Message = std::pair<std::uint32_t, std::string>;

/// Whether its bytes are one, or refused as none.
template <typename Type>
void claim_message(const RawMessage& message) {
  try {
    const auto read = bag::message_of<Type>(message);
    claim(::ros::serialization::serializationLength(read) == message.bytes.size(), "a message of another size");
  } catch (const BagError& error) {
    claim(std::string_view(error.what()).size() > 0, "refused without a reason");
  }
}

std::vector<Message> scanned(const std::string& path, std::size_t most, std::string& end) {
  std::ostringstream progress;
  cli::LongRun run(progress, false);
  std::vector<std::uint32_t> connections;
  std::vector<Message> messages;
  end = bag::scan_bag(
      path,
      [&](const Connection& connection) {
        claim(std::find(connections.begin(), connections.end(), connection.id) == connections.end(),
              "a connection twice");
        connections.push_back(connection.id);
      },
      [&](const RawMessage& message) {
        claim(std::find(connections.begin(), connections.end(), message.connection.id) != connections.end(),
              "a message before its connection");
        claim_message<CameraParams>(message);
        claim_message<CameraConstants>(message);
        messages.emplace_back(message.connection.id, message.bytes);
        return messages.size() < most;
      },
      run);
  return messages;
}

void claim_scan(const std::string& path) {
  std::string end, other_end;
  const auto all = scanned(path, std::string::npos, end);
  claim(!end.empty(), "an end without a word");
  const std::size_t half = all.size() / 2 + 1;
  const auto first = scanned(path, half, other_end);
  claim(first.size() == std::min(half, all.size()) && std::equal(first.begin(), first.end(), all.begin()),
        "other messages when it is read to a half");
}

void claim_reader(const std::string& path) {
  std::ostringstream progress;
  cli::LongRun run(progress, false);
  bag::Reader reader(path, run);
  std::size_t messages = 0, again = 0;
  reader.read([](const Connection&) { return true; },
              [&](const RawMessage& message) {
                claim_message<CameraParams>(message);
                ++messages;
              });
  reader.read_while([](const Connection&) { return true; }, [&](const RawMessage&) { return ++again < messages; });
  claim(again == messages, "other messages when it is read again");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::MemoryFile file;
  file.write({reinterpret_cast<const char*>(data), size});
  for (const auto work : {claim_scan, claim_reader}) {
    try {
      work(file.path());
    } catch (const BagError& error) {
      claim(std::string_view(error.what()).size() > 0, "refused without a reason");
    }
  }
  return 0;
}
