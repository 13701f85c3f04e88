// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "screen.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <curses.h>
#include <termios.h>
#include <unistd.h>

namespace trk_bridge::monitor {
namespace {

extern "C" void trk_bridge_end_in_order(int) { ::raise(SIGTERM); }

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

enum Pair : short { warning_pair = 1, error_pair = 2 };

bool begin_colours() {
  if (!variable("NO_COLOR").empty() || !::has_colors()) return false;
  if (::start_color() == ERR || ::use_default_colors() == ERR) return false;
  // With their own background colour they are readable on any terminal.
  ::init_pair(warning_pair, COLOR_BLACK, COLOR_YELLOW);
  ::init_pair(error_pair, COLOR_WHITE, COLOR_RED);
  return true;
}

/// The quit key would end the program without cleaning up.
void switch_quit_key_off() {
  termios mode{};
  if (::tcgetattr(STDOUT_FILENO, &mode) != 0) return;
  mode.c_cc[VQUIT] = _POSIX_VDISABLE;
  ::tcsetattr(STDOUT_FILENO, TCSADRAIN, &mode);
}

attr_t attributes(Style style, bool has_colour) {
  switch (style) {
    case Style::plain:
      return A_NORMAL;
    case Style::heading:
      return A_BOLD;
    case Style::warning:
      return has_colour ? static_cast<attr_t>(COLOR_PAIR(warning_pair)) : A_BOLD;
    case Style::error:
      return has_colour ? A_BOLD | static_cast<attr_t>(COLOR_PAIR(error_pair)) : A_REVERSE;
  }
  return A_NORMAL;
}

}  // namespace

struct Screen::Terminal {
  /// Converts one signal to SIGTERM, unless it is ignored.
  class PassedOn {
   public:
    explicit PassedOn(int number) : number_(number) {
      ::sigaction(number_, nullptr, &before_);
      if (before_.sa_handler == SIG_IGN) return;
      struct sigaction pass_on {};
      pass_on.sa_handler = trk_bridge_end_in_order;
      pass_on.sa_flags = SA_RESTART;
      ::sigaction(number_, &pass_on, nullptr);
    }
    ~PassedOn() { ::sigaction(number_, &before_, nullptr); }
    PassedOn(const PassedOn&) = delete;
    PassedOn& operator=(const PassedOn&) = delete;

   private:
    int number_;
    struct sigaction before_ {};
  };

  Terminal() : screen(::newterm(nullptr, stdout, stdin)) {
    if (screen == nullptr) {
      throw std::runtime_error("TERM='" + variable("TERM") +
                               "': unknown type of terminal; pipe the output to get plain lines");
    }
    ::cbreak();
    ::noecho();
    ::nonl();
    ::keypad(stdscr, TRUE);
    ::curs_set(0);
    switch_quit_key_off();
    ::def_prog_mode();
    has_colour = begin_colours();
  }
  ~Terminal() {
    ::endwin();
    ::delscreen(screen);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  SCREEN* screen;
  bool has_colour = false;
  PassedOn hang_up{SIGHUP};
  PassedOn quit{SIGQUIT};
};

Screen::Screen() : terminal_(std::make_unique<Terminal>()) {}
Screen::~Screen() = default;

Size Screen::size() const {
  return {static_cast<std::size_t>(std::max(0, getmaxx(stdscr))),
          static_cast<std::size_t>(std::max(0, getmaxy(stdscr)))};
}

void Screen::show(const std::vector<Line>& lines) {
  ::werase(stdscr);
  int row = 0;
  for (const auto& line : lines) {
    ::wmove(stdscr, row++, 0);
    for (const auto& span : line) {
      ::wattrset(stdscr, static_cast<int>(attributes(span.style, terminal_->has_colour)));
      ::waddnstr(stdscr, span.text.c_str(), static_cast<int>(span.text.size()));
    }
  }
  ::wattrset(stdscr, A_NORMAL);
  ::wrefresh(stdscr);
}

std::optional<char> Screen::key(std::chrono::milliseconds wait) {
  ::wtimeout(stdscr, static_cast<int>(wait.count()));
  const int key = ::wgetch(stdscr);
  if (key == ERR) return std::nullopt;
  return key > 0 && key < KEY_MIN ? static_cast<char>(key) : '\0';
}

void Screen::ring() { ::beep(); }

}  // namespace trk_bridge::monitor
