# Everything that is built from here on can be fuzzed: the sanitizers and the coverage of libFuzzer see libraries, targets
# and programs alike. Included before any target.
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "TRK_BRIDGE_FUZZ needs clang for libFuzzer; this compiler is ${CMAKE_CXX_COMPILER_ID}. "
    "Name it with CC=clang CXX=clang++, or leave TRK_BRIDGE_FUZZ off: the corpora are replayed all the same.")
endif()
# vptr and function compare types by their addresses, which differ where a library hides its own.
set(sanitizers -fsanitize=address,undefined -fno-sanitize=vptr,function -fno-sanitize-recover=undefined)
add_compile_options(${sanitizers} -fsanitize=fuzzer-no-link -fno-omit-frame-pointer)
add_link_options(${sanitizers})
# Those of the standard library.
add_compile_definitions(_GLIBCXX_ASSERTIONS)
