// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The worked cases under test/data, read with RapidJSON at full precision.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#define RAPIDJSON_HAS_STDSTRING 1
#include <rapidjson/document.h>

#include "trk_bridge/wire/record.h"

namespace trk_bridge::test {

inline std::string data_path(const std::string& relative) { return std::string(TRK_BRIDGE_TEST_DATA) + "/" + relative; }

/// One JSON document a line.
inline std::vector<rapidjson::Document> read_jsonl(const std::string& relative) {
  std::ifstream in(data_path(relative));
  if (!in) throw std::runtime_error("cannot read " + data_path(relative));
  std::vector<rapidjson::Document> lines;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    auto& document = lines.emplace_back();
    document.Parse<rapidjson::kParseFullPrecisionFlag>(line);
    if (document.HasParseError()) {
      throw std::runtime_error(relative + ": line " + std::to_string(lines.size()) + " is not JSON");
    }
  }
  if (lines.empty()) throw std::runtime_error(relative + " is empty");
  return lines;
}

/// Bytes of a hexadecimal string.
inline std::string from_hex(const std::string& hex) {
  std::string bytes;
  bytes.reserve(hex.size() / 2);
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

/// A record from the `fields` of the vectors: `m` as [j][i] or `x y z pan tilt roll`.
inline wire::CameraParams params_of(const rapidjson::Value& v) {
  wire::CameraParams p;
  if (v.HasMember("id")) p.id = v["id"].GetUint();
  p.format = v["format"].GetUint();
  if (v.HasMember("m")) {
    for (rapidjson::SizeType j = 0; j < 4; ++j) {
      for (rapidjson::SizeType i = 0; i < 4; ++i) p.matrix[4 * j + i] = v["m"][j][i].GetDouble();
    }
  } else {
    p.euler = {v["x"].GetDouble(),   v["y"].GetDouble(),    v["z"].GetDouble(),
               v["pan"].GetDouble(), v["tilt"].GetDouble(), v["roll"].GetDouble()};
  }
  p.fov = v["fov"].GetDouble();
  p.center_x = v["centerX"].GetDouble();
  p.center_y = v["centerY"].GetDouble();
  p.k1 = v["k1"].GetDouble();
  p.k2 = v["k2"].GetDouble();
  p.focdist = v["focdist"].GetDouble();
  p.aperture = v["aperture"].GetDouble();
  p.counter = v["counter"].GetUint64();
  return p;
}

inline wire::CameraConstants constants_of(const rapidjson::Value& v) {
  wire::CameraConstants c;
  if (v.HasMember("id")) c.id = v["id"].GetUint();
  c.image_width = v["imageWidth"].GetInt();
  c.image_height = v["imageHeight"].GetInt();
  c.blank_left = v["blankLeft"].GetInt();
  c.blank_right = v["blankRight"].GetInt();
  c.blank_top = v["blankTop"].GetInt();
  c.blank_bottom = v["blankBottom"].GetInt();
  c.chip_width = v["chipWidth"].GetDouble();
  c.chip_height = v["chipHeight"].GetDouble();
  c.fake_chip_width = v["fakeChipWidth"].GetDouble();
  c.fake_chip_height = v["fakeChipHeight"].GetDouble();
  return c;
}

/// Parameters of a line of camera_cases.jsonl: `euler` (6) or `matrix_columns` (16).
inline wire::CameraParams case_params_of(const rapidjson::Value& v) {
  wire::CameraParams p;
  p.format = v["format"].GetUint();
  if (v.HasMember("euler")) {
    const auto& e = v["euler"];
    p.euler = {e[0].GetDouble(), e[1].GetDouble(), e[2].GetDouble(),
               e[3].GetDouble(), e[4].GetDouble(), e[5].GetDouble()};
  } else {
    for (rapidjson::SizeType i = 0; i < 16; ++i) p.matrix[i] = v["matrix_columns"][i].GetDouble();
  }
  p.fov = v["fov"].GetDouble();
  p.center_x = v["centerX"].GetDouble();
  p.center_y = v["centerY"].GetDouble();
  p.k1 = v["k1"].GetDouble();
  p.k2 = v["k2"].GetDouble();
  p.focdist = v["focdist"].GetDouble();
  p.aperture = v["aperture"].GetDouble();
  p.counter = v["counter"].GetUint64();
  return p;
}

}  // namespace trk_bridge::test
