// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A locale with decimal commas. The tests create it, so it need not be installed.
#pragma once

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <stdexcept>
#include <string>
#include <vector>

#include "temporary_directory.h"

namespace trk_bridge::test {

/// German numbers ("1.234,5"), compiled by localedef into a temporary folder.
class CommaLocale {
 public:
  /// Throws std::runtime_error with the reason, for GTEST_SKIP. localedef and its sources are in Debian's package
  /// locales.
  CommaLocale() {
    const std::string compiled = folder_ / name;
    // localedef returns 1 for warnings, here about names that the character set does not have.
    if (std::system(("localedef -i de_DE -f ISO-8859-1 " + compiled + " >/dev/null 2>&1").c_str()) != 0 &&
        !std::filesystem::exists(compiled + "/LC_NUMERIC")) {
      throw std::runtime_error("localedef cannot compile a locale with commas: install the package locales");
    }
  }

  /// To be put before a command, so that it runs in this locale.
  std::vector<std::string> prefix() const {
    return {"/usr/bin/env", "LOCPATH=" + folder_.path(), std::string("LC_ALL=") + name};
  }

  /// While it exists, this process uses the locale, as after setlocale(LC_ALL, "") and std::locale::global().
  class Stay {
   public:
    explicit Stay(const CommaLocale& in) {
      ::setenv("LOCPATH", in.folder_.path().c_str(), 1);
      before_ = std::locale::global(std::locale(name));
      if (std::setlocale(LC_ALL, name) == nullptr) throw std::runtime_error("setlocale refuses the locale");
    }
    ~Stay() {
      std::locale::global(before_);
      std::setlocale(LC_ALL, "C");
      ::unsetenv("LOCPATH");
    }
    Stay(const Stay&) = delete;
    Stay& operator=(const Stay&) = delete;

   private:
    std::locale before_;
  };

 private:
  static constexpr const char* name = "comma";
  TemporaryDirectory folder_;
};

}  // namespace trk_bridge::test
