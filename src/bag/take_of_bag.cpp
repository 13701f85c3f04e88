#include <ostream>

#include "cli/number_text.h"
#include "fields.h"
#include "file/part_file.h"
#include "file/take_writer.h"
#include "timing.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::bag {
namespace {

void write(const Fields& fields, const base::TimeCode& code, const std::string& path, bool overwrite,
           cli::LongRun& run) {
  file::TakeWriter writer(path, code, overwrite);
  run.begin("writing " + path);
  try {
    check_written(path, writer.write(fields.constants));
    double done = 0;
    for (const auto& params : fields.params) {
      run.at(done++ / static_cast<double>(fields.params.size()));
      check_written(path, writer.write(params));
    }
  } catch (...) {
    writer.discard();
    throw;
  }
  check_written(path, writer.close());
  run.end();
}

}  // namespace

void take_of_bag(const std::string& bag_path, const std::string& take_path, const BagToTakeOptions& options,
                 cli::LongRun& run, std::ostream& err) {
  check_written(take_path, file::PartFile::check(take_path, {options.overwrite, file::Fifo::allowed}));
  try {
    Reader bag(bag_path, run);
    const auto camera = choose_camera(bag.connections(), options.camera, options.input);
    const bool from_params = camera.input == Input::params;
    const auto fields = from_params ? fields_from_params(bag, camera.name, options, run, err)
                                    : fields_from_tf(bag, camera.name, options, run, err);
    if (!bag.damage().empty()) err << "trk: " << bag_path << " is cut short: " << bag.damage() << '\n';

    const std::string topic = topic_of(camera.name, from_params ? "params" : "camera_info");
    const auto timing = recorded_timing(bag.connections(), topic);
    const auto recorded = recorded_time_code(bag, topic_of(camera.name, "time_code"), fields.stamps.front());
    const auto counted = recorded && recorded->rate > 0 ? std::optional<double>(recorded->rate) : timing.field_rate;
    const double rate = field_rate_of(options.field_rate, counted, measured_rate(fields), err);
    const auto code = recorded ? tl::expected<base::TimeCode, std::string>(recorded->code)
                               : time_code_of(fields.stamps.front(), rate, timing.time_code_zero);
    if (!code) throw BagError(code.error());
    report_gaps(fields, rate, err);
    write(fields, *code, take_path, options.overwrite, run);
    err << "trk: " << take_path << ": " << fields.params.size() << " fields of " << topic
        << (from_params ? "" : " and tf") << ", from " << base::to_string(*code) << " at " << cli::number_text(rate)
        << " fields a second\n";
  } catch (const BagError& error) {
    throw BagError(bag_path + ": " + error.what());
  }
}

}  // namespace trk_bridge::bag
