#include "dump.h"

#include <cerrno>
#include <ostream>
#include <system_error>

#include "listen.h"
#include "record_text.h"
#include "tally.h"

namespace trk_bridge::tools {
namespace {

class Dump final : public Listener {
 public:
  Dump(const DumpOptions& options, std::ostream& out, std::ostream& err) : options_(options), out_(out), err_(err) {}

  bool on_sample(const transport::Sample& sample) override {
    tally_.add(sample);
    errno = 0;
    if (options_.json) {
      out_ << json_.of(sample) << '\n';
    } else {
      out_ << plain_line(sample) << '\n';
    }
    if (options_.flush_each) out_.flush();
    return note_output_error() && ++printed_ != options_.count;
  }

  void on_malformed(const transport::Reception& reception) override {
    err_ << "trk: malformed record from " << transport::to_string(reception.sample.sender) << ": "
         << wire::describe(reception.fault) << '\n';
  }

  ExitCode finish(const transport::SourceStatistics& source, Ending ending) {
    if (output_error_ == 0) {
      errno = 0;
      out_.flush();
      note_output_error();
    }
    tally_.summarise(source, err_);
    if (output_error_ != 0 && output_error_ != EPIPE) {
      err_ << "trk: error: standard output: " << std::generic_category().message(output_error_) << '\n';
      return exit_failed;
    }
    if (ending == Ending::failed) {
      err_ << "trk: error: " << source.error << '\n';
      return exit_failed;
    }
    return exit_good;
  }

 private:
  bool note_output_error() {
    if (out_) return true;
    output_error_ = errno != 0 ? errno : EIO;
    return false;
  }

  const DumpOptions options_;
  std::ostream& out_;
  std::ostream& err_;
  JsonLine json_;
  Tally tally_;
  std::uint64_t printed_ = 0;
  int output_error_ = 0;
};

}  // namespace

ExitCode dump(transport::Source& source, const DumpOptions& options, std::ostream& out, std::ostream& err) {
  Dump dump(options, out, err);
  const Ending ending = listen(source, dump, options.seconds);
  return dump.finish(source.statistics(), ending);
}

}  // namespace trk_bridge::tools
