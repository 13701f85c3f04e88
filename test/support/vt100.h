// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The part of a vt100 terminal that programs with a screen use: what its screen shows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trk_bridge::test {

class Vt100 {
 public:
  Vt100(std::size_t width, std::size_t height) { resize(width, height); }

  void resize(std::size_t width, std::size_t height) {
    cells_.resize(height);
    for (auto& line : cells_) line.resize(width, ' ');
    row_ = std::min(row_, height - 1);
    column_ = std::min(column_, width - 1);
    top_ = 0;
    bottom_ = height - 1;
  }

  /// Any part of the output of the program: sequences may be split anywhere.
  void write(std::string_view bytes) {
    for (const char c : bytes) put(c);
  }

  /// Lines without the spaces at their ends.
  std::string text() const {
    std::string all;
    for (const auto& line : cells_) all += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    return all;
  }

 private:
  enum class State { text, escape, charset, control };

  void put(char c) {
    switch (state_) {
      case State::text:
        return put_text(c);
      case State::escape:
        parameters_.clear();
        if (c == 'M') back();
        state_ = c == '[' ? State::control : c == '(' || c == ')' ? State::charset : State::text;
        return;
      case State::charset:
        state_ = State::text;
        return;
      case State::control:
        if (c < '@') {
          parameters_ += c;
        } else {
          state_ = State::text;
          control(c);
        }
    }
  }

  void put_text(char c) {
    switch (c) {
      case '\x1B':
        state_ = State::escape;
        return;
      case '\r':
        column_ = 0;
        return;
      case '\n':
        if (row_ == bottom_) {
          scroll(top_, bottom_);
        } else {
          move(static_cast<long>(row_) + 1, static_cast<long>(column_));
        }
        return;
      case '\b':
        move(static_cast<long>(row_), static_cast<long>(column_) - 1);
        return;
      case '\t':
        move(static_cast<long>(row_), static_cast<long>(column_ / 8 + 1) * 8);
        return;
      default:
        if (c < ' ') return;
        cells_[row_][column_] = c;
        move(static_cast<long>(row_), static_cast<long>(column_) + 1);
    }
  }

  void control(char what) {
    const long n = std::max(1L, parameter(0, 1));
    const auto row = static_cast<long>(row_), column = static_cast<long>(column_);
    if (what == 'H' || what == 'f') move(parameter(0, 1) - 1, parameter(1, 1) - 1);
    if (what == 'A') move(row - n, column);
    if (what == 'B') move(row + n, column);
    if (what == 'C') move(row, column + n);
    if (what == 'D') move(row, column - n);
    if (what == 'K') erase(row_, parameter(0, 0));
    if (what == 'J') erase_screen(parameter(0, 0));
    if (what == 'r') set_margins();
  }

  void set_margins() {
    const auto height = static_cast<long>(cells_.size());
    top_ = static_cast<std::size_t>(std::clamp(parameter(0, 1), 1L, height) - 1);
    bottom_ = static_cast<std::size_t>(std::clamp(parameter(1, height), 1L, height) - 1);
    move(0, 0);
  }

  /// One line up, or all lines between the margins down.
  void back() {
    if (row_ != top_) return move(static_cast<long>(row_) - 1, static_cast<long>(column_));
    const auto line = cells_.begin();
    std::rotate(line + static_cast<std::ptrdiff_t>(top_), line + static_cast<std::ptrdiff_t>(bottom_),
                line + static_cast<std::ptrdiff_t>(bottom_ + 1));
    erase(top_, 2);
  }
  /// All lines but the first one move up.
  void scroll(std::size_t first, std::size_t last) {
    const auto line = cells_.begin();
    std::rotate(line + static_cast<std::ptrdiff_t>(first), line + static_cast<std::ptrdiff_t>(first + 1),
                line + static_cast<std::ptrdiff_t>(last + 1));
    erase(last, 2);
  }

  long parameter(int index, long fallback) const {
    std::size_t begin = 0;
    for (; index > 0; --index) {
      begin = parameters_.find(';', begin);
      if (begin == std::string::npos) return fallback;
      ++begin;
    }
    const std::string digits = parameters_.substr(begin, parameters_.find(';', begin) - begin);
    return digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos ? fallback : std::stol(digits);
  }

  void move(long row, long column) {
    row_ = static_cast<std::size_t>(std::clamp(row, 0L, static_cast<long>(cells_.size()) - 1));
    column_ = static_cast<std::size_t>(std::clamp(column, 0L, static_cast<long>(cells_[row_].size()) - 1));
  }

  /// 0: from the cursor on; 1: up to it; 2: all.
  void erase(std::size_t row, long which) {
    auto& line = cells_[row];
    const std::size_t begin = which == 0 ? column_ : 0, end = which == 1 ? column_ + 1 : line.size();
    std::fill(line.begin() + static_cast<std::ptrdiff_t>(begin), line.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  }

  void erase_screen(long which) {
    erase(row_, which);
    for (std::size_t row = 0; row < cells_.size(); ++row) {
      if ((row > row_ && which != 1) || (row < row_ && which != 0)) erase(row, 2);
    }
  }

  std::vector<std::string> cells_;
  std::size_t row_ = 0, column_ = 0;
  std::size_t top_ = 0, bottom_ = 0;  // lines that scroll
  State state_ = State::text;
  std::string parameters_;
};

}  // namespace trk_bridge::test
