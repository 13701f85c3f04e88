// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "decoder.h"

#include <utility>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::freed {

void Decoder::begin(std::string_view datagram, const transport::Sender&) noexcept {
  datagram_ = datagram;
  state_ = State::begun;
}

transport::Decoder::Next Decoder::next(transport::Sample& into, transport::Fault& fault) noexcept {
  switch (std::exchange(state_, State::done)) {
    case State::done:
      return Next::none;
    case State::constants_given:
      break;
    case State::begun: {
      const auto message = read(datagram_);
      if (!message || !(message->checksum_fits || options_.lenient)) {
        fault = message ? wrong_checksum() : message.error();
        return Next::fault;
      }
      read_ = *message;
      if (constants_are_due()) {
        state_ = State::constants_given;
        fill(into);
        auto constants = *options_.table->constants();
        constants.id = read_.message.camera;
        into.record = wire::Record(constants);
        return Next::sample;
      }
    }
  }
  fill(into);
  const Message& m = read_.message;
  wire::CameraParams params;
  params.id = m.camera;
  params.counter = messages_[m.camera]++;
  params.format = wire::euler;
  // Negated as integers, so that there is no -0.
  params.euler = {m.x / per_metre,     m.y / per_metre,     m.z / per_metre,
                  -m.pan / per_degree, m.tilt / per_degree, m.roll / per_degree};
  std::optional<camera::Lens> lens;
  into.encoders = encoders_of(m, options_.profile);
  if (options_.table) {
    lens =
        options_.table->lens_at({static_cast<double>(*into.encoders.zoom), static_cast<double>(*into.encoders.focus)});
    if (!lens && *into.doubt == '\0') into.doubt = "the lens encoders are beyond the lens table";
  }
  if (sends_lens(options_.profile)) {
    const auto sent = lens_of(m);
    if (lens && sent) {
      lens->aperture = sent->aperture;
      if (!options_.table->has_distances()) lens->focdist = sent->focdist;
    } else if (!options_.table) {
      lens = sent;
    }
  }
  into.has_lens = lens.has_value();
  if (lens) {
    params.fov = lens->image_distance;
    params.center_x = lens->center_shift.x();
    params.center_y = lens->center_shift.y();
    params.k1 = lens->k1;
    params.k2 = lens->k2;
    params.focdist = lens->focdist;
    params.aperture = lens->aperture;
  }
  into.record = wire::Record(params);
  return Next::sample;
}

bool Decoder::constants_are_due() const noexcept {
  return options_.table && options_.table->constants() && messages_[read_.message.camera] % constants_every == 0;
}

void Decoder::fill(transport::Sample& into) const noexcept {
  into.origin = "Free-D";
  into.has_counter = false;
  into.has_lens = true;
  into.encoders = {};
  into.doubt = read_.checksum_fits ? "" : "wrong checksum";
  into.sample_time.reset();
  into.time_code.reset();
}

}  // namespace trk_bridge::freed
