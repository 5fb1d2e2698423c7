# The oldest compilers that everything is built and tested with. Older ones would end in pages of messages about a header.
foreach(known "GNU;g++;12" "Clang;clang++;14")
  list(GET known 0 id)
  list(GET known 1 name)
  list(GET known 2 oldest)
  if(CMAKE_CXX_COMPILER_ID STREQUAL id AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS oldest)
    message(FATAL_ERROR "Portrait needs ${name} ${oldest} or newer, as Debian 12 has it; ${CMAKE_CXX_COMPILER} is version "
      "${CMAKE_CXX_COMPILER_VERSION}. Name a newer one: cmake --preset dev -DCMAKE_CXX_COMPILER=${name}-${oldest}")
  endif()
endforeach()
