# SPDX-License-Identifier: Apache-2.0
# Programs that parts of the build tree need and the rest does without. The file `lacking.txt` of the
# tree lists those that are missing, so that ./run and ./test configure it again when they have come.

# rave_find_tool(VARIABLE PART NAME...): as find_program(). PART says what is left out without it.
function(rave_find_tool variable part)
  find_program(${variable} NAMES ${ARGN})
  if(NOT ${variable})
    rave_lacks("${part}" ${ARGN})
  endif()
endfunction()

# rave_lacks(PART NAME...): what is left out until one of these programs or files is there.
function(rave_lacks part)
  list(JOIN ARGN " " names)
  set_property(GLOBAL APPEND PROPERTY RAVE_LACKING "${names}\t${part}\n")
endfunction()

# At the end of the outermost CMakeLists.txt.
function(rave_write_lacking)
  get_property(lines GLOBAL PROPERTY RAVE_LACKING)
  list(REMOVE_DUPLICATES lines)
  list(JOIN lines "" text)
  file(WRITE "${CMAKE_BINARY_DIR}/lacking.txt" "${text}")
endfunction()
