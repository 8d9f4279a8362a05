# One CMake target a folder. choreo_library(NAME SOURCES ... LINK ...) makes the library `choreo_NAME`, with warnings as errors and
# includes from the root of the repository ("model/motion/skeleton.h").

add_library(choreo_options INTERFACE)
# GCC 12 wrongly reports overlaps in std::string's operator+ (bug 105651) and uninitialised values in CLI11's pairs.
target_compile_options(choreo_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-maybe-uninitialized>)
target_include_directories(choreo_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)

# Sources of a target are compiled together in unity builds, so many at a time: headers cost more than what is in most of them. So names
# that a source has for itself differ within a library, and each file of tests is a namespace of its own.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 20)

function(choreo_library name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES;LINK;PRIVATE_LINK")
  add_library(choreo_${name} STATIC ${ARG_SOURCES})
  add_library(choreo::${name} ALIAS choreo_${name})
  set_target_properties(choreo_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name})
  target_link_libraries(choreo_${name} PRIVATE $<BUILD_INTERFACE:choreo_options> ${ARG_PRIVATE_LINK} PUBLIC ${ARG_LINK})
  target_include_directories(choreo_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
endfunction()

# For code that waits for people, files or LibTorch: compiling takes a quarter less time.
function(choreo_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# For programs that only tests run: gold, a part of Debian's binutils, links them in a quarter of ld's time.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold CHOREO_HAS_GOLD)
function(choreo_link_quickly target)
  if(CHOREO_HAS_GOLD AND NOT CHOREO_SANITIZED)
    target_link_options(${target} PRIVATE -fuse-ld=gold)
  endif()
endfunction()

function(choreo_executable name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES;LINK")
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE choreo_options ${ARG_LINK})
endfunction()

# LibTorch is not built for sanitizers and raises false alarms: tests that run it are skipped under them.
set(CHOREO_SANITIZED OFF)
if(CMAKE_CXX_FLAGS MATCHES "fsanitize")
  set(CHOREO_SANITIZED ON)
endif()

# choreo_test(NAME SOURCES ... LINK ... [WAITS]): a GoogleTest program, with each case registered in ctest. `choreo_tests` builds all.
# In ctest's configuration `together` two processes share its cases: to start takes 0.02 CPU seconds, 0.08 with gRPC, 1 with LibTorch.
# WAITS: it mostly waits, for music in real time or for servers. Its cases have a process each, and two of them run in place of one of
# others (scripts/run_tests.sh).
add_custom_target(choreo_tests)
function(choreo_test name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "WAITS" "" "SOURCES;LINK")
  choreo_executable(${name} SOURCES ${ARG_SOURCES} LINK ${ARG_LINK} GTest::gmock GTest::gtest_main)
  choreo_compile_quickly(${name})
  choreo_link_quickly(${name})
  add_dependencies(choreo_tests ${name})
  if(ARG_WAITS)
    set(processors 1)
    if(CHOREO_SANITIZED)
      set(processors 2)
    endif()
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 PROCESSORS ${processors})
    return()
  endif()
  foreach(share RANGE 1)
    set(test ${name}_${share})
    add_test(NAME ${test} CONFIGURATIONS together COMMAND ${name} --gtest_output=xml:${CMAKE_BINARY_DIR}/Testing/together/${test}.xml)
    set_tests_properties(${test} PROPERTIES TIMEOUT 900 PROCESSORS 2 COST 30
      ENVIRONMENT "GTEST_TOTAL_SHARDS=2;GTEST_SHARD_INDEX=${share}")
  endforeach()
  gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 PROCESSORS 2 LABELS alone)
endfunction()
