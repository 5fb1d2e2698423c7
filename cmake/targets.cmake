# What every target of the house has in common.

add_library(portrait_options INTERFACE)
target_include_directories(portrait_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
target_compile_features(portrait_options INTERFACE cxx_std_20)
# No contraction: a*b+c is rounded the same way on every machine, so portraits have the same bits everywhere.
set(options -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
if(PORTRAIT_WERROR)
  list(APPEND options -Werror)
endif()
target_compile_options(portrait_options INTERFACE "$<BUILD_INTERFACE:${options}>")
if(PORTRAIT_SANITIZE)
  target_compile_options(portrait_options INTERFACE -fsanitize=${PORTRAIT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(portrait_options INTERFACE -fsanitize=${PORTRAIT_SANITIZE})
endif()

# portrait_library(NAME SOURCES a.cpp ... USES lib ...): one library a folder
function(portrait_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC portrait_options ${ARG_USES})
endfunction()

# portrait_test(NAME LABEL fast|slow SOURCES a_test.cpp ... USES lib ...): one binary a folder, each test its own
function(portrait_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_USES} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE PORTRAIT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(PORTRAIT_SANITIZE)
    target_compile_definitions(${name} PRIVATE PORTRAIT_SANITIZED)  # many times slower: fewer random cases will do
  endif()
  gtest_discover_tests(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT 600 DISCOVERY_TIMEOUT 60)
endfunction()
