// Numbers as diagnostics show them.
#pragma once

#include <cstdint>
#include <string>

namespace trk_bridge::bridge {

/// "3.2 s"
std::string seconds_text(double seconds);
/// Two digits behind the point.
std::string rate_text(double rate);
/// Three digits behind the point.
std::string pixels_text(double pixels);
/// An error of a lens that is smaller than this (px) nobody sees.
inline constexpr double visible_pixels = 0.01;
/// `from` and `to` in ns.
double seconds_between(std::int64_t from, std::int64_t to);
/// Events a second between two looks, `from` and `to` in ns; 0 when no time has passed.
double rate_between(std::uint64_t events_before, std::uint64_t events_now, std::int64_t from, std::int64_t to);

}  // namespace trk_bridge::bridge
