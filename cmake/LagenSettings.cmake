# Warnings and sanitizers for our own targets, and the two functions that keep the house in order:
#   lagen_room(NAME DEPENDS rooms... LIBRARIES libs...)   one static library a folder of generator/
#   lagen_test_room(NAME LIBRARIES libs...)               one test executable a folder of tests/

add_library(lagen_settings INTERFACE)
target_compile_options(lagen_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       $<$<BOOL:${LAGEN_WERROR}>:-Werror>)
# Two middle-end warnings of GCC 12 are wrong on "literal" + std::string (GCC bug 105651) and on small vectors.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  target_compile_options(lagen_settings INTERFACE -Wno-restrict -Wno-stringop-overread)
endif()
if(LAGEN_SANITIZE)
  target_compile_options(lagen_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lagen_settings INTERFACE -fsanitize=address,undefined)
endif()

function(lagen_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "" "" "DEPENDS;LIBRARIES")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(TRANSFORM ROOM_DEPENDS PREPEND lagen_)
  if(sources)
    add_library(lagen_${name} STATIC ${sources})
    target_include_directories(lagen_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(lagen_${name} PUBLIC ${ROOM_DEPENDS} ${ROOM_LIBRARIES} PRIVATE lagen_settings)
  else()
    add_library(lagen_${name} INTERFACE)
    target_include_directories(lagen_${name} INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(lagen_${name} INTERFACE ${ROOM_DEPENDS} ${ROOM_LIBRARIES})
  endif()
endfunction()

function(lagen_test_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "" "" "LIBRARIES")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources} $<TARGET_OBJECTS:catch_main>)
  target_include_directories(test_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(test_${name} PRIVATE LAGEN_SOURCE_DIR="${PROJECT_SOURCE_DIR}" LAGEN_BINARY_DIR="${PROJECT_BINARY_DIR}")
  target_link_libraries(test_${name} PRIVATE ${ROOM_LIBRARIES} lagen_settings)
  add_test(NAME ${name} COMMAND test_${name})
  if(LAGEN_SANITIZE)
    set_tests_properties(${name} PROPERTIES ENVIRONMENT
      "LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/leaks.supp:print_suppressions=0")
  endif()
endfunction()
