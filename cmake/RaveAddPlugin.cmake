# SPDX-License-Identifier: Apache-2.0
# For projects that use an installed RAVE; found with find_package(rave).

# rave_add_plugin(NAME [VIRTUAL] SOURCES ... [DEPS ...])
# The plug-in NAME.so with a program or drivers inside, linked with rave::robot and, if VIRTUAL,
# rave::sim. Flags that keep the bits of a run equal come with rave::robot. It is installed nowhere:
# `rave run --plugins FOLDER` and a scenario find it where it is built.
function(rave_add_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "VIRTUAL" "" "SOURCES;DEPS")
  if(NOT ARG_SOURCES)
    message(FATAL_ERROR "rave_add_plugin(${name}): SOURCES are missing")
  endif()
  if(ARG_VIRTUAL AND NOT TARGET rave::sim)
    message(FATAL_ERROR "rave_add_plugin(${name} VIRTUAL) needs find_package(rave COMPONENTS driver)")
  endif()
  add_library(${name} MODULE ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE rave::robot $<$<BOOL:${ARG_VIRTUAL}>:rave::sim> ${ARG_DEPS})
  # Line tables, so that a message about a crash can name the line; and no symbols that keep the
  # plug-in from being unloaded.
  target_compile_options(${name} PRIVATE -g1 $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
  if(rave_SANITIZE)
    target_compile_options(${name} PRIVATE -fsanitize=${rave_SANITIZE})
    target_link_options(${name} PRIVATE -fsanitize=${rave_SANITIZE})
  endif()
  # Only the entry point and the stamp are visible; static libraries stay inside.
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
  target_link_options(${name} PRIVATE -Wl,--exclude-libs,ALL -Wl,--no-undefined -Wl,--as-needed)
endfunction()
