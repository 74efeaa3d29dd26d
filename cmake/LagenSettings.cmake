# Warnings and sanitizers for our own targets, and the functions that keep the house in order:
#   lagen_room(NAME DEPENDS rooms... LIBRARIES libs...)   one static library a folder of generator/
#   lagen_test_room(NAME LIBRARIES libs...                one test executable a folder of tests/
#     [SEPARATE]         its files are never united
#     [TEMPLATES]        its files instantiate the runtime, which is compiled with some optimisation
#     [UNSANITIZED]      left out of builds with sanitizers: its tests compile programs of their own, or look at digits
#     [APART tag])       its tests of that tag are a test by themselves, NAME_tag
#   lagen_fuzz_target(NAME LIBRARIES libs... SOURCES files... CORPUS places... LONGEST bytes RUNS n)  one of tests/fuzz

add_library(lagen_settings INTERFACE)
target_compile_options(lagen_settings INTERFACE -Wall -Wextra -Wpedantic -Wconversion
                       $<$<NOT:$<BOOL:${LAGEN_UNITY}>>:-Wshadow>
                       $<$<BOOL:${LAGEN_WERROR}>:-Werror>)
# Two middle-end warnings of GCC 12 are wrong on "literal" + std::string (GCC bug 105651) and on small vectors.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  target_compile_options(lagen_settings INTERFACE -Wno-restrict -Wno-stringop-overread)
endif()
# What g++ says of a class with a member from an anonymous namespace is meant for headers.
if(LAGEN_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(lagen_settings INTERFACE -Wno-subobject-linkage)
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
# of another file's constant, so that -Wshadow is left to the builds that are not united and to scripts/tidy.
function(lagen_unite target)
  if(LAGEN_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  endif()
endfunction()

function(lagen_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "" "" "DEPENDS;LIBRARIES")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(TRANSFORM ROOM_DEPENDS PREPEND lagen_)
  if(sources)
    add_library(lagen_${name} STATIC ${sources})
    lagen_unite(lagen_${name})
    target_include_directories(lagen_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(lagen_${name} PUBLIC ${ROOM_DEPENDS} ${ROOM_LIBRARIES} PRIVATE lagen_settings)
  else()
    add_library(lagen_${name} INTERFACE)
    target_include_directories(lagen_${name} INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(lagen_${name} INTERFACE ${ROOM_DEPENDS} ${ROOM_LIBRARIES})
  endif()
endfunction()

function(lagen_test_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "SEPARATE;TEMPLATES;UNSANITIZED" "APART" "LIBRARIES")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  if(NOT sources OR (ROOM_UNSANITIZED AND LAGEN_SANITIZE))
    return()
  endif()
  add_executable(test_${name} ${sources} $<TARGET_OBJECTS:catch_main>)
  if(NOT ROOM_SEPARATE)
    lagen_unite(test_${name})
  endif()
  # Tests are compiled for longer than they run; what computes for long is what they test. Only the templates of Eigen
  # and of the runtime are compiled with them, whose loops are too slow without any optimisation.
  if(ROOM_TEMPLATES AND NOT LAGEN_SANITIZE)
    target_compile_options(test_${name} PRIVATE -O1)
  else()
    target_compile_options(test_${name} PRIVATE -O0)
  endif()
  target_include_directories(test_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(test_${name} PRIVATE LAGEN_SOURCE_DIR="${PROJECT_SOURCE_DIR}" LAGEN_BINARY_DIR="${PROJECT_BINARY_DIR}")
  target_link_libraries(test_${name} PRIVATE ${ROOM_LIBRARIES} lagen_settings)
  set(tests ${name})
  if(ROOM_APART)
    list(APPEND tests ${name}_${ROOM_APART})
    add_test(NAME ${name} COMMAND test_${name} ~[${ROOM_APART}])
    add_test(NAME ${name}_${ROOM_APART} COMMAND test_${name} [${ROOM_APART}])
    set_tests_properties(${tests} PROPERTIES COST 100) # the long ones start first
  else()
    add_test(NAME ${name} COMMAND test_${name})
  endif()
  if(LAGEN_SANITIZE)
    set_tests_properties(${tests} PROPERTIES ENVIRONMENT
      "LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/leaks.supp:print_suppressions=0")
  endif()
endfunction()

# libFuzzer drives the target where the compiler is clang and the sanitizers are on: its test replays the corpus and goes on
# to RUNS inputs in all, the same ones every time. Elsewhere the test replays the corpus.
function(lagen_fuzz_target name)
  cmake_parse_arguments(PARSE_ARGV 1 FUZZ "" "LONGEST;RUNS" "LIBRARIES;SOURCES;CORPUS")
  list(TRANSFORM FUZZ_SOURCES PREPEND fuzz/)
  list(TRANSFORM FUZZ_CORPUS PREPEND ${PROJECT_SOURCE_DIR}/)
  add_executable(fuzz_${name} fuzz/fuzz_${name}.cpp fuzz/require.cpp)
  target_include_directories(fuzz_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(fuzz_${name} PRIVATE ${FUZZ_LIBRARIES} lagen_settings)
  if(LAGEN_SANITIZE AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_sources(fuzz_${name} PRIVATE ${FUZZ_SOURCES})
    target_compile_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    # What is new is written to the first folder named, which must not be the corpus. Whole stacks of allocations would
    # take up to two thirds of the time of deep expressions, weights by entropy half of that of short runs.
    add_test(NAME fuzz_${name} COMMAND sh -c "rm -rf $1 && mkdir -p $1 && shift && exec \"$@\"" --
      ${PROJECT_BINARY_DIR}/fuzz/${name} $<TARGET_FILE:fuzz_${name}> -runs=${FUZZ_RUNS} -seed=1 -timeout=20 -rss_limit_mb=2048
      -entropic=0 -detect_leaks=0 -max_len=${FUZZ_LONGEST} -dict=${CMAKE_CURRENT_SOURCE_DIR}/fuzz/tokens.dict -verbosity=0
      ${PROJECT_BINARY_DIR}/fuzz/${name} ${FUZZ_CORPUS})
    set_tests_properties(fuzz_${name} PROPERTIES WORKING_DIRECTORY ${PROJECT_BINARY_DIR} ENVIRONMENT
      "ASAN_OPTIONS=malloc_context_size=2;LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/leaks.supp:print_suppressions=0")
  else()
    target_sources(fuzz_${name} PRIVATE fuzz/replay.cpp)
    add_test(NAME fuzz_${name} COMMAND fuzz_${name} ${FUZZ_CORPUS})
  endif()
  set_tests_properties(fuzz_${name} PROPERTIES LABELS fuzz)
endfunction()
