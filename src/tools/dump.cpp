// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "dump.h"

#include <ostream>

#include "cli/checked_output.h"
#include "cli/listen.h"
#include "cli/tally.h"
#include "record_text.h"

namespace trk_bridge::tools {
namespace {

class Dump final : public cli::Listener {
 public:
  Dump(const DumpOptions& options, std::ostream& out, std::ostream& err) : options_(options), out_(out), err_(err) {}

  bool on_sample(const transport::Sample& sample) override {
    tally_.add(sample);
    const bool is_written = options_.json ? out_.line(json_.of(sample), options_.flush_each)
                                          : out_.line(plain_line(sample), options_.flush_each);
    return is_written && ++printed_ != options_.count;
  }

  void on_malformed(const transport::Reception& reception) override {
    err_ << "trk: malformed record from " << transport::to_string(reception.sample.sender) << ": "
         << describe(reception.fault) << '\n';
  }

  cli::ExitCode finish(const transport::SourceStatistics& source, cli::Ending ending) {
    const cli::ExitCode written = out_.finish(err_);
    const cli::ExitCode ended = cli::report_end(tally_, source, ending, options_.count || options_.seconds, err_);
    return written != cli::exit_good ? written : ended;
  }

 private:
  const DumpOptions options_;
  cli::CheckedOutput out_;
  std::ostream& err_;
  JsonLine json_;
  cli::Tally tally_;
  std::uint64_t printed_ = 0;
};

}  // namespace

cli::ExitCode dump(transport::Source& source, const DumpOptions& options, std::ostream& out, std::ostream& err) {
  Dump dump(options, out, err);
  const cli::Ending ending = cli::listen(source, dump, options.seconds);
  return dump.finish(source.statistics(), ending);
}

}  // namespace trk_bridge::tools
