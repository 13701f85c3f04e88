// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a take: read strictly, leniently, and played with the times of its fields.
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "codec_claims.h"
#include "file/scheme.h"
#include "file/take.h"
#include "fuzz.h"
#include "memory_file.h"

namespace {

using namespace trk_bridge;
using file::TakeReader;
using test::claim;

/// A field, or a line that is skipped.
using Line = std::variant<wire::CameraParams, transport::Fault>;

struct Contents {
  bool has_head = false;
  base::TimeCode time_code;
  wire::CameraConstants constants;
  std::vector<Line> lines;
  std::string error;  ///< empty: read to its end
};

Contents read(const std::string& path, file::MalformedLines malformed) {
  Contents contents;
  TakeReader reader(path, malformed, file::Waiting::never);
  for (;;) {
    switch (reader.next()) {
      case TakeReader::Got::head:
        claim(!contents.has_head, "two heads");
        contents.has_head = true;
        contents.time_code = reader.time_code();
        contents.constants = reader.constants();
        break;
      case TakeReader::Got::params:
        contents.lines.emplace_back(reader.params());
        break;
      case TakeReader::Got::skipped:
        claim(malformed == file::MalformedLines::are_skipped, "a skipped line must be an error");
        contents.lines.emplace_back(reader.fault());
        break;
      case TakeReader::Got::truncated:
        contents.lines.emplace_back(reader.fault());
        claim(reader.next() == TakeReader::Got::end, "something after a truncated line");
        return contents;
      case TakeReader::Got::end:
        return contents;
      case TakeReader::Got::failed:
        contents.error = reader.error();
        return contents;
      case TakeReader::Got::nothing_yet:
        claim("waits for a writer of a regular file");
    }
  }
}

void claim_valid(const Contents& contents, const std::string& path, std::size_t lines) {
  claim(contents.lines.size() <= lines, "more fields than lines");
  if (!contents.error.empty()) {
    const std::string begin = path + ":";
    claim(contents.error.compare(0, begin.size(), begin) == 0, "an error without the path");
    const auto line = std::strtoul(contents.error.c_str() + begin.size(), nullptr, 10);
    claim(line >= 1 && line <= lines + 1, "an error in a line that is not there: " + contents.error);
  }
  if (!contents.has_head) return;
  const auto code = base::parse_time_code(to_string(contents.time_code));
  claim(code && *code == contents.time_code, "a time code that does not read back");
  claim(test::broken_claim_of(contents.constants, {wire::Encoding::ascii, {}}));
  for (const Line& line : contents.lines) {
    if (const auto* params = std::get_if<wire::CameraParams>(&line)) {
      claim(test::broken_claim_of(*params, {wire::Encoding::ascii, {}}));
    } else {
      const auto& fault = std::get<transport::Fault>(line);
      claim(fault.line() >= 1 && fault.line() <= lines && !describe(fault).empty(), "a fault without its line");
    }
  }
}

/// What strict reading gives, lenient reading gives as well; it only goes on where the other one ends.
void claim_agreement(const Contents& strict, const Contents& lenient) {
  claim(strict.has_head == lenient.has_head && strict.time_code == lenient.time_code &&
            strict.constants == lenient.constants,
        "two heads of the same take");
  claim(strict.lines.size() <= lenient.lines.size() &&
            std::equal(strict.lines.begin(), strict.lines.end(), lenient.lines.begin()),
        "other fields when read leniently");
  if (strict.error.empty() || !strict.has_head) {
    claim(strict.error == lenient.error && strict.lines.size() == lenient.lines.size(), "two ends of the same take");
  } else {
    claim(lenient.lines.size() > strict.lines.size(), "an error, and no line was skipped");
  }
}

/// The source gives what the reader read, and the times of the time code.
void claim_played(const Contents& contents, const std::string& path, double rate, bool lenient) {
  const auto codes = base::TimeCodeSeries::from(contents.time_code, rate);
  file::SourceSettings settings;
  settings.path = path;
  settings.rate = rate;
  settings.speed = 0;
  settings.date = 0;
  settings.lenient = lenient;
  std::unique_ptr<transport::Source> source;
  try {
    source = file::open_source(settings, 50);
  } catch (const transport::TransportError& error) {
    claim(!contents.has_head || !codes, "a take that cannot be played: " + std::string(error.what()));
    claim(contents.has_head || error.what() == contents.error, "another error when it is played");
    return;
  }
  claim(contents.has_head && codes.has_value(), "a take that is played without its head");
  transport::Reception got;
  const auto next = [&] { return source->receive(got, std::chrono::nanoseconds(0)); };
  claim(next() == transport::Event::sample && got.sample.record == wire::Record(contents.constants), "no constants");
  std::uint64_t field = 0;
  for (const Line& line : contents.lines) {
    const auto event = next();
    if (const auto* fault = std::get_if<transport::Fault>(&line)) {
      claim(event == transport::Event::malformed && got.fault == *fault, "a fault that is not reported");
    } else {
      claim(event == transport::Event::sample && got.sample.record == wire::Record(std::get<wire::CameraParams>(line)),
            "another field than that of the take");
      claim(got.sample.arrival == codes->nanoseconds(field), "another time than that of the time code");
      claim(got.sample.time_code && got.sample.time_code->code == codes->code(field), "another time code");
      claim(field == 0 || codes->nanoseconds(field) > codes->nanoseconds(field - 1), "time that does not go on");
    }
    ++field;
  }
  const auto end = next();
  claim(end == (contents.error.empty() ? transport::Event::ended : transport::Event::failed), "another end");
  if (end == transport::Event::failed) claim(source->statistics().error == contents.error, "another error at the end");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::MemoryFile take;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  take.write(bytes);
  const std::string path = take.path();
  const auto lines = static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\n')) + 1;
  const Contents strict = read(path, file::MalformedLines::are_errors),
                 lenient = read(path, file::MalformedLines::are_skipped);
  claim_valid(strict, path, lines);
  claim_valid(lenient, path, lines);
  claim_agreement(strict, lenient);
  for (const double rate : {50.0, 59.94, 25.0}) {
    claim_played(strict, path, rate, false);
    claim_played(lenient, path, rate, true);
  }
  return 0;
}
