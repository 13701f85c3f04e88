// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "base/number_text.h"
#include "fields.h"
#include "file/part_file.h"
#include "file/take_writer.h"
#include "timing.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::bag {
namespace {

/// Writes fields one after another. The first one determines the beginning of the take.
class TakeOfFields {
 public:
  TakeOfFields(Reader& bag, const ChosenCamera& camera, const std::string& path, const BagToTakeOptions& options)
      : bag_(bag), camera_(camera), path_(path), options_(options) {}

  /// The error is the reason why the take cannot hold it. Throws BagError and TransportError.
  tl::expected<void, std::string> write(const Field& field) {
    if (!writer_.has_fields()) {
      wire::Buffer buffer;
      if (const auto text = wire::to_text(field.params, buffer); !text) {
        return tl::unexpected(wire::describe(text.error()));
      }
      begin(field);
    }
    const auto written = writer_.write(field.params);
    if (!written && written.error().reason == transport::SinkReason::not_encodable) {
      return tl::unexpected(describe(written.error().fault));
    }
    check_written(path_, written);
    series_->add(field.params.counter, field.stamp);
    return {};
  }

  void finish(std::ostream& err) {
    check_rate(rate_, options_.field_rate, series_->measured_rate(), err);
    series_->report_gaps(err);
    check_written(path_, writer_.close());
    err << "trk: " << path_ << ": " << series_->count() << " fields of " << topic()
        << (is_from_params() ? "" : " and tf") << ", from " << base::to_string(code_) << " at "
        << base::number_text(rate_) << " fields a second\n";
  }

  void discard() noexcept { writer_.discard(); }

 private:
  bool is_from_params() const { return camera_.input == Input::params; }
  std::string topic() const { return topic_of(camera_.name, is_from_params() ? "params" : "camera_info"); }

  void begin(const Field& first) {
    const auto timing = recorded_timing(bag_.connections(), topic());
    const auto recorded = recorded_time_code(bag_, topic_of(camera_.name, "time_code"), first.stamp);
    const auto counted = recorded && recorded->rate > 0 ? std::optional<double>(recorded->rate) : timing.field_rate;
    rate_ = options_.field_rate.value_or(counted.value_or(default_field_rate));
    const auto code = recorded ? tl::expected<base::TimeCode, std::string>(recorded->code)
                               : time_code_of(first.stamp, rate_, timing.time_code_zero);
    if (!code) throw BagError(code.error());
    code_ = *code;
    series_.emplace(is_from_params(), rate_);
    auto file = file::open_take(path_, options_.overwrite);
    if (!file) check_written(path_, tl::unexpected(file.error()));
    check_written(path_, writer_.open(*std::move(file)));
    writer_.set_time_code(code_);
    check_written(path_, writer_.write(first.constants));
  }

  Reader& bag_;
  const ChosenCamera camera_;
  const std::string path_;
  const BagToTakeOptions& options_;
  double rate_ = default_field_rate;
  base::TimeCode code_;
  std::optional<FieldSeries> series_;
  file::TakeWriter writer_;
};

}  // namespace

void take_of_bag(const std::string& bag_path, const std::string& take_path, const BagToTakeOptions& options,
                 cli::LongRun& run, std::ostream& err) {
  check_written(take_path, file::PartFile::check(take_path, {options.overwrite, file::Fifo::allowed}));
  try {
    Reader bag(bag_path, run);
    const auto camera = choose_camera(bag.connections(), options.camera, options.input);
    TakeOfFields take(bag, camera, take_path, options);
    try {
      const FieldVisitor visit = [&take](const Field& field) { return take.write(field); };
      const auto& read = camera.input == Input::params ? fields_from_params : fields_from_tf;
      read(bag, camera.name, options, run, visit, err);
      if (!bag.damage().empty()) err << "trk: " << bag_path << " is truncated: " << bag.damage() << '\n';
      take.finish(err);
    } catch (...) {
      take.discard();
      throw;
    }
  } catch (const BagError& error) {
    throw BagError(bag_path + ": " + error.what());
  }
}

}  // namespace trk_bridge::bag
