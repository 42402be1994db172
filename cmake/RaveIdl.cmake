# SPDX-License-Identifier: Apache-2.0
# Types of messages, written once as IDL and compiled to C by Cyclone DDS's idlc.

# rave_idl(NAME FOLDER path FILES a b ... [BY_NAME])
# The static library rave_NAME (alias rave::NAME) with the types of FOLDER/a.idl, FOLDER/b.idl, ...
# below schemas/idl; a source includes them as "idl/FOLDER/a.h". Generated code is compiled as it
# comes, without our warnings. Relative paths keep the folder of the clone out of what ccache hashes.
# BY_NAME leaves out the description of the types that DDS would otherwise exchange: then two ends
# match by the name of the type alone, as with ROS 2, whose other implementations describe the same
# types in other words or not at all.
function(rave_idl name)
  cmake_parse_arguments(ARG "BY_NAME" "FOLDER" "FILES" ${ARGN})
  set(options -x final)
  if(ARG_BY_NAME)
    list(APPEND options -t)
  endif()
  find_program(RAVE_IDLC idlc REQUIRED)
  set(from "${CMAKE_SOURCE_DIR}/schemas/idl/${ARG_FOLDER}")
  set(into "${CMAKE_BINARY_DIR}/generated/idl/${ARG_FOLDER}")
  file(MAKE_DIRECTORY "${into}")
  file(RELATIVE_PATH from_into "${into}" "${from}")
  list(TRANSFORM ARG_FILES PREPEND "${from}/" OUTPUT_VARIABLE inputs)
  list(TRANSFORM inputs APPEND ".idl")
  set(sources)
  foreach(file ${ARG_FILES})
    # idlc does not end on some faulty inputs, and never tells which.
    add_custom_command(OUTPUT "${into}/${file}.c" "${into}/${file}.h"
      COMMAND timeout 60 ${RAVE_IDLC} ${options} "${from_into}/${file}.idl"
      WORKING_DIRECTORY "${into}" DEPENDS ${inputs} COMMENT "IDL ${ARG_FOLDER}/${file}")
    list(APPEND sources "${into}/${file}.c")
  endforeach()
  add_library(rave_${name} STATIC ${sources})
  # For those who only read the sources, such as clang-tidy.
  add_custom_target(rave_${name}_types DEPENDS ${sources})
  if(NOT TARGET rave_generated)
    add_custom_target(rave_generated)
  endif()
  add_dependencies(rave_generated rave_${name}_types)
  add_dependencies(rave_${name} rave_${name}_types)
  add_library(rave::${name} ALIAS rave_${name})
  target_include_directories(rave_${name} SYSTEM PUBLIC "${CMAKE_BINARY_DIR}/generated")
  target_link_libraries(rave_${name} PUBLIC CycloneDDS::ddsc)
endfunction()
