# Warnings and sanitizers for our own targets, and the functions that keep the house in order:
#   lagen_room(NAME DEPENDS rooms... LIBRARIES libs...)   one static library a folder of generator/
#   lagen_test_room(NAME LIBRARIES libs...                one test executable a folder of tests/
#     [SEPARATE]         its files are never united
#     [TEMPLATES]        its files instantiate the runtime, which is compiled with some optimisation
#     [UNSANITIZED]      left out of builds with sanitizers: its tests compile programs of their own, or look at digits
#     [PARSES]           in every build with sanitizers: its tests read what a user wrote, or decide; the others are there
#                        for scripts/test --all
#     [APART tags]       its tests of each tag are a test by themselves, NAME_tag; those of the tag `all` are for
#                        scripts/test --all only (LAGEN_ALL_TESTS)
#     [LATER files..]    these of its files are compiled for scripts/test --all only
#     [SECONDS n..]      processor seconds that NAME and its tests apart are expected to take, in this order (5 each)
#     [SANITIZED n..])   the same with sanitizers
#   lagen_fuzz_target(NAME LIBRARIES libs... SOURCES files... CORPUS places... LONGEST bytes RUNS n ALL n
#     SECONDS n n)       one of tests/fuzz: with sanitizers, of RUNS inputs and for scripts/test --all of ALL
#   lagen_timed_test(NAME SECONDS command...)             a test that fails where it takes five times as long
#   lagen_starts(TEST PROGRAM)                            PROGRAM is built before TEST

add_library(lagen_settings INTERFACE)
target_compile_options(lagen_settings INTERFACE -Wall -Wextra -Wpedantic -Wconversion
                       $<$<NOT:$<BOOL:${LAGEN_UNITY}>>:-Wshadow>
                       $<$<BOOL:${LAGEN_WERROR}>:-Werror>)
# Two middle-end warnings of GCC 12 are wrong on "literal" + std::string (GCC bug 105651) and on small vectors.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  target_compile_options(lagen_settings INTERFACE -Wno-restrict -Wno-stringop-overread)
endif()
# What g++ says of a class with a member from an anonymous namespace is meant for headers. Its collector is left out up to a
# gigabyte, which the largest units reach: a tenth of the time for a quarter more memory.
if(LAGEN_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(lagen_settings INTERFACE -Wno-subobject-linkage --param=ggc-min-heapsize=1048576)
endif()
if(LAGEN_SANITIZE)
  target_compile_options(lagen_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lagen_settings INTERFACE -fsanitize=address,undefined)
endif()
if(LAGEN_FUZZ)
  # Comparisons are not traced: the dictionary and the mutators know the words, and tracing them halves the speed.
  target_compile_options(lagen_settings INTERFACE -fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp)
  target_link_options(lagen_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()

# With LAGEN_UNITY the files of a room are compiled a few at a time, so that headers are read and templates instantiated
# once for all of them. Names in the anonymous namespaces of a room must therefore differ. A parameter may have the name
# of another file's constant, so that -Wshadow is left to the builds that are not united and to scripts/tidy. In rooms two
# dozen files take three quarters of the time that they take in two units; tests, most of which change alone, stay smaller.
function(lagen_unite target files)
  if(LAGEN_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files})
  endif()
endfunction()

# With sanitizers optimising a room doubles the time of the compiler. It pays where the tests spend theirs.
set(lagen_busy_rooms expression graph proof)

function(lagen_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "" "" "DEPENDS;LIBRARIES")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(TRANSFORM ROOM_DEPENDS PREPEND lagen_)
  if(sources)
    add_library(lagen_${name} STATIC ${sources})
    lagen_unite(lagen_${name} 24)
    target_include_directories(lagen_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(lagen_${name} PUBLIC ${ROOM_DEPENDS} ${ROOM_LIBRARIES} PRIVATE lagen_settings)
    if(LAGEN_SANITIZE AND NOT name IN_LIST lagen_busy_rooms)
      target_compile_options(lagen_${name} PRIVATE -O0)
    endif()
    if(ROOM_DEPENDS) # fmt comes with them
      lagen_share_headers(lagen_${name} rooms)
    endif()
  else()
    add_library(lagen_${name} INTERFACE)
    target_include_directories(lagen_${name} INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(lagen_${name} INTERFACE ${ROOM_DEPENDS} ${ROOM_LIBRARIES})
  endif()
endfunction()

# What nearly every file reads is read once for all that is compiled alike: by the rooms the standard library and fmt, by the
# tests Catch2, and by those that instantiate the runtime the runtime. Only united builds do so; the others show which file
# forgets to include something. KIND names the headers and the optimisation: rooms, tests, templates.
set(lagen_headers_rooms <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <numeric> <optional> <set> <span> <sstream>
                        <string> <unordered_map> <variant> <vector> <fmt/format.h> <gmpxx.h>)
set(lagen_headers_tests <catch2/catch.hpp> <filesystem> <functional> <map> <set>)
set(lagen_headers_templates <catch2/catch.hpp> <lagen/lagen.hpp>)
set(lagen_libraries_rooms fmt::fmt)
set(lagen_libraries_tests Catch2::Catch2)
set(lagen_libraries_templates Catch2::Catch2 lagen_runtime)

function(lagen_share_headers target kind)
  if(NOT LAGEN_UNITY)
    return()
  endif()
  get_target_property(options ${target} COMPILE_OPTIONS)
  if(NOT options)
    set(options "")
  endif()
  string(MAKE_C_IDENTIFIER "shared_headers_${kind}${options}" shared)
  if(NOT TARGET ${shared})
    file(CONFIGURE OUTPUT ${shared}.cpp CONTENT "")
    add_library(${shared} OBJECT EXCLUDE_FROM_ALL ${CMAKE_CURRENT_BINARY_DIR}/${shared}.cpp)
    target_compile_options(${shared} PRIVATE ${options})
    target_link_libraries(${shared} PRIVATE ${lagen_libraries_${kind}} lagen_settings)
    target_precompile_headers(${shared} PRIVATE ${lagen_headers_${kind}})
    lagen_cache_shared_headers(${shared})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${shared})
  lagen_cache_shared_headers(${target})
endfunction()

# ccache keeps what was compiled with shared headers where it may take their contents for their names and times.
function(lagen_cache_shared_headers target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  endif()
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache$")
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
endfunction()

# Of every allocation the sanitizer keeps two callers: whole stacks would take up to two thirds of the time of deep expressions.
function(lagen_timed_test name seconds)
  add_test(NAME ${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/support/timed ${name} ${seconds} ${PROJECT_BINARY_DIR}/test-times ${ARGN})
  set_tests_properties(${name} PROPERTIES COST ${seconds}) # the long ones start first
  if(LAGEN_SANITIZE)
    set_tests_properties(${name} PROPERTIES ENVIRONMENT
      "ASAN_OPTIONS=malloc_context_size=2;LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks.supp:print_suppressions=0")
  endif()
endfunction()

function(lagen_test_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "SEPARATE;TEMPLATES;UNSANITIZED;PARSES" "" "LIBRARIES;APART;LATER;SECONDS;SANITIZED")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/readme_1\\.cpp$") # a program that a test compiles
  # Unoptimised templates take an hour for these with sanitizers.
  if(ROOM_LATER AND (NOT LAGEN_ALL_TESTS OR (ROOM_TEMPLATES AND LAGEN_SANITIZE)))
    list(TRANSFORM ROOM_LATER REPLACE "(.+)" "${CMAKE_CURRENT_SOURCE_DIR}/${name}/\\1.cpp")
    list(REMOVE_ITEM sources ${ROOM_LATER})
  endif()
  if(NOT sources OR (LAGEN_SANITIZE AND (ROOM_UNSANITIZED OR NOT (ROOM_PARSES OR LAGEN_ALL_TESTS))))
    return()
  endif()
  add_executable(test_${name} ${sources})
  if(NOT ROOM_SEPARATE)
    lagen_unite(test_${name} 12)
  endif()
  # Tests are compiled for longer than they run; what computes for long is what they test. Only the templates of Eigen
  # and of the runtime are compiled with them, whose loops are too slow without any optimisation.
  if(ROOM_TEMPLATES AND NOT LAGEN_SANITIZE)
    target_compile_options(test_${name} PRIVATE -Og)
  else()
    target_compile_options(test_${name} PRIVATE -O0)
  endif()
  if(ROOM_TEMPLATES)
    lagen_share_headers(test_${name} templates)
  else()
    lagen_share_headers(test_${name} tests)
  endif()
  target_include_directories(test_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(test_${name} PRIVATE LAGEN_SOURCE_DIR="${PROJECT_SOURCE_DIR}" LAGEN_BINARY_DIR="${PROJECT_BINARY_DIR}")
  if(LAGEN_ALL_TESTS)
    target_compile_definitions(test_${name} PRIVATE LAGEN_ALL_TESTS)
  endif()
  target_link_libraries(test_${name} PRIVATE ${ROOM_LIBRARIES} lagen_settings)
  if(LAGEN_SANITIZE)
    set(ROOM_SECONDS ${ROOM_SANITIZED})
  endif()
  list(APPEND ROOM_SECONDS 5 5 5 5)
  list(POP_FRONT ROOM_SECONDS seconds)
  list(TRANSFORM ROOM_APART REPLACE "(.+)" "~[\\1]" OUTPUT_VARIABLE rest)
  list(JOIN rest "" rest)
  lagen_timed_test(${name} ${seconds} $<TARGET_FILE:test_${name}> ${rest})
  foreach(tag IN LISTS ROOM_APART)
    list(POP_FRONT ROOM_SECONDS seconds)
    if(LAGEN_ALL_TESTS OR NOT tag STREQUAL "all")
      string(REPLACE "[all]~[all]" "[all]" filter "[${tag}]~[all]")
      lagen_timed_test(${name}_${tag} ${seconds} $<TARGET_FILE:test_${name}> ${filter})
    endif()
  endforeach()
endfunction()

# A test starts a program, which must be there where anything is linked.
function(lagen_starts test program)
  if(NOT LAGEN_READS)
    add_dependencies(${test} ${program})
  endif()
endfunction()

# A part of lagen_fuzz_target. What is new is written to the first folder named, which must not be the corpus. Weights by
# entropy would take half of the time of short runs.
macro(lagen_fuzz_test test runs)
  list(POP_FRONT FUZZ_SECONDS seconds)
  lagen_timed_test(${test} ${seconds} sh -c "rm -rf $1 && mkdir -p $1 && shift && exec \"$@\"" --
    ${PROJECT_BINARY_DIR}/fuzz/${test} $<TARGET_FILE:fuzz_${name}> -runs=${FUZZ_${runs}} -seed=1 -timeout=20 -rss_limit_mb=2048
    -entropic=0 -detect_leaks=0 -max_len=${FUZZ_LONGEST} -dict=${CMAKE_CURRENT_SOURCE_DIR}/fuzz/tokens.dict -verbosity=0
    ${PROJECT_BINARY_DIR}/fuzz/${test} ${FUZZ_CORPUS})
  set_tests_properties(${test} PROPERTIES WORKING_DIRECTORY ${PROJECT_BINARY_DIR} LABELS fuzz)
endmacro()

# libFuzzer drives the target where the compiler is clang and the sanitizers are on: its test replays the corpus and goes on
# to RUNS inputs in all, NAME_all to ALL, the same ones every time. Elsewhere the test replays the corpus.
function(lagen_fuzz_target name)
  cmake_parse_arguments(PARSE_ARGV 1 FUZZ "" "LONGEST;RUNS;ALL" "LIBRARIES;SOURCES;CORPUS;SECONDS")
  list(TRANSFORM FUZZ_SOURCES PREPEND fuzz/)
  list(TRANSFORM FUZZ_CORPUS PREPEND ${PROJECT_SOURCE_DIR}/)
  add_executable(fuzz_${name} fuzz/fuzz_${name}.cpp fuzz/require.cpp)
  lagen_unite(fuzz_${name} 12)
  target_include_directories(fuzz_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(fuzz_${name} PRIVATE ${FUZZ_LIBRARIES} lagen_settings)
  if(NOT (LAGEN_SANITIZE AND CMAKE_CXX_COMPILER_ID MATCHES "Clang"))
    target_sources(fuzz_${name} PRIVATE fuzz/replay.cpp)
    lagen_timed_test(fuzz_${name} 5 $<TARGET_FILE:fuzz_${name}> ${FUZZ_CORPUS})
    set_tests_properties(fuzz_${name} PROPERTIES LABELS fuzz)
    return()
  endif()
  target_sources(fuzz_${name} PRIVATE ${FUZZ_SOURCES})
  target_compile_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  lagen_fuzz_test(fuzz_${name} RUNS)
  if(LAGEN_ALL_TESTS)
    lagen_fuzz_test(fuzz_${name}_all ALL)
  endif()
endfunction()
