# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# Sanitizers for everything that is built from here on: libraries, tests and programs. Included before any target.
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "TRK_BRIDGE_SANITIZE and TRK_BRIDGE_FUZZ need clang; this compiler is ${CMAKE_CXX_COMPILER_ID}. "
    "Select it with CC=clang CXX=clang++. The tests replay the corpora also without TRK_BRIDGE_FUZZ.")
endif()

if(TRK_BRIDGE_SANITIZE STREQUAL address)
  # The checks vptr and function compare types by address; the addresses differ if a library hides its types.
  set(sanitizers -fsanitize=address,undefined -fno-sanitize=vptr,function -fno-sanitize-recover=undefined)
  add_compile_options(-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/test/sanitizer_ignores.txt)
elseif(TRK_BRIDGE_SANITIZE STREQUAL thread)
  set(sanitizers -fsanitize=thread)
else()
  message(FATAL_ERROR "TRK_BRIDGE_SANITIZE = ${TRK_BRIDGE_SANITIZE}: must be address or thread")
endif()
add_compile_options(${sanitizers} -fno-omit-frame-pointer)
add_link_options(${sanitizers})
# The assertions of the standard library.
add_compile_definitions(_GLIBCXX_ASSERTIONS)
if(TRK_BRIDGE_FUZZ)
  # libFuzzer sees which code an input reaches.
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
