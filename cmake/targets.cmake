# SPDX-License-Identifier: GPL-3.0-or-later
# The functions and interface targets that the folders' CMakeLists.txt are written in.

# clerestory::flags: what our own sources are compiled with.
add_library(clerestory_flags INTERFACE)
add_library(clerestory::flags ALIAS clerestory_flags)
target_compile_options(clerestory_flags INTERFACE
  -Wall
  -Wextra
  -Wpedantic
  -Wconversion
  -Wnon-virtual-dtor
  -Wold-style-cast
  -Woverloaded-virtual
  -Wshadow
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond>
  $<$<CXX_COMPILER_ID:GNU>:-Wlogical-op>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # g++ 12 sees overlaps in plain std::string sums (GCC bug 105651)
  $<$<BOOL:${CLERESTORY_WERROR}>:-Werror>)
if(CLERESTORY_SANITIZE)
  # What is found ends the program, so that a test cannot pass over it.
  target_compile_options(clerestory_flags INTERFACE
    -fsanitize=${CLERESTORY_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(clerestory_flags INTERFACE -fsanitize=${CLERESTORY_SANITIZE})
endif()

# clerestory::version: #include "clerestory_version.h" gives clerestory::kVersion.
configure_file(${CMAKE_CURRENT_LIST_DIR}/clerestory_version.h.in
  ${PROJECT_BINARY_DIR}/generated/clerestory_version.h @ONLY)
add_library(clerestory_version INTERFACE)
add_library(clerestory::version ALIAS clerestory_version)
target_include_directories(clerestory_version INTERFACE ${PROJECT_BINARY_DIR}/generated)

# clerestory_library(NAME [OBJECT] SOURCES file... [PUBLIC library...] [PRIVATE library...])
#
# A library of one folder. Includes are written from the project root: #include "mesh/geometry.h".
function(clerestory_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg OBJECT "" "SOURCES;PUBLIC;PRIVATE")
  set(kind STATIC)
  if(arg_OBJECT)
    set(kind OBJECT)
  endif()
  add_library(${name} ${kind} ${arg_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE clerestory::flags ${arg_PRIVATE})
endfunction()

# clerestory_carry_objects(LIBRARY OBJECTS library...)
#
# LIBRARY takes in the object files of OBJECTS and what they must be linked with, but none of the
# compile flags of those libraries.
function(clerestory_carry_objects library objects)
  set_target_properties(${objects} PROPERTIES JOB_POOL_COMPILE heavy)
  target_sources(${library} PRIVATE $<TARGET_OBJECTS:${objects}>)
  foreach(needed IN LISTS ARGN)
    target_link_libraries(${library} PRIVATE $<LINK_ONLY:${needed}>)
  endforeach()
endfunction()
