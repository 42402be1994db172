# SPDX-License-Identifier: Apache-2.0
# The other implementation of DDS, for tests alone: eProsima Fast DDS and the generator of its types.
# RAVE_FAST_DDS says whether both are there; the tests that need them are left out otherwise.
set(RAVE_FAST_DDS FALSE)
# Its libraries are built without the thread sanitizer, which then sees races that are none.
if(RAVE_TESTS AND NOT RAVE_SANITIZE MATCHES "thread" AND NOT RAVE_FUZZERS)
  find_package(fastrtps QUIET)
  rave_find_tool(RAVE_FASTDDSGEN "the tests with Fast DDS" fastddsgen)
  if(NOT fastrtps_FOUND)
    rave_lacks("the tests with Fast DDS" /usr/lib/*/cmake/fastrtps)
  elseif(RAVE_FASTDDSGEN)
    set(RAVE_FAST_DDS TRUE)
  endif()
endif()

# rave_fast_dds_types(NAME file.idl): the static library NAME with the types of an IDL file, which
# sources include as "file.h" and "filePubSubTypes.h". Generated code is compiled as it comes.
function(rave_fast_dds_types name idl)
  cmake_path(GET idl STEM stem)
  set(into "${CMAKE_BINARY_DIR}/generated/fastdds/${name}")
  file(MAKE_DIRECTORY "${into}")
  set(sources "${into}/${stem}.cxx" "${into}/${stem}PubSubTypes.cxx")
  # It tells at length what it does; only a failure is worth reading.
  add_custom_command(OUTPUT ${sources}
    COMMAND timeout 300 ${RAVE_FASTDDSGEN} -replace -d "${into}"
      "${CMAKE_CURRENT_SOURCE_DIR}/${idl}" > "${into}/log" 2>&1 || (cat "${into}/log" && false)
    DEPENDS "${idl}" COMMENT "Fast DDS types of ${idl}")
  if(TARGET rave_generated)
    add_custom_target(${name}_generated DEPENDS ${sources})
    add_dependencies(rave_generated ${name}_generated)
  endif()
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} SYSTEM PUBLIC "${into}")
  target_link_libraries(${name} PUBLIC fastrtps fastcdr)
endfunction()
