# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where, and the package that find_package(rave) finds.
#   component runtime     bin/, the plug-ins, share/rave (scenarios, robots, worlds, data, ...), man
#                         pages, completion of bash
#   component host        what commands real robots, without the simulator: bin/ and the plug-ins that
#                         are not virtual, with a scenario to start from; the page is the component gui
#   component gui         share/rave/web: the page of the GUI Server, with declarations for panels; share/rave/foxglove: a layout;
#                         and bin/rave once more, so that it shows recordings without the runtime
#   component doc         share/doc/rave: all pages, with the files that they link to
#   component robot-dev   what a robot program is written with: no header of the simulator
#   component driver-dev  on top of it: world and sim, for virtual drivers, and line, for drivers of
#                         devices on serial lines and sockets
#   component config-dev  on top of it: the reader of configuration files
#   component run-dev     on top of these: from a scenario to an engine, for runs driven from C++
include(CMakePackageConfigHelpers)
set(RAVE_PACKAGE_DIR "lib/cmake/rave")

# rave_closure(OUT target...): the libraries of ours that the targets stand on, themselves included.
function(rave_closure out)
  set(queue ${ARGN})
  set(seen)
  while(queue)
    list(POP_FRONT queue target)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" target "${target}")
    string(REGEX REPLACE "^rave::" "rave_" target "${target}")
    if(NOT TARGET "${target}" OR NOT target MATCHES "^rave_" OR target IN_LIST seen)
      continue()
    endif()
    list(APPEND seen ${target})
    get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
    if(links)
      list(APPEND queue ${links})
    endif()
  endwhile()
  set(${out} ${seen} PARENT_SCOPE)
endfunction()

# rave_install_libraries(component target...): static libraries, headers and the export of a part.
function(rave_install_libraries component)
  set(names)
  foreach(target ${ARGN})
    list(APPEND names "${target}")
    get_target_property(folder ${target} SOURCE_DIR)
    install(DIRECTORY "${folder}/include/" DESTINATION include COMPONENT ${component}-dev
      FILES_MATCHING PATTERN "*.hpp")
  endforeach()
  if(names)
    install(TARGETS ${names} EXPORT rave-${component}
      ARCHIVE DESTINATION lib COMPONENT ${component}-dev)
    install(EXPORT rave-${component} NAMESPACE rave:: FILE rave-${component}-targets.cmake
      DESTINATION ${RAVE_PACKAGE_DIR} COMPONENT ${component}-dev)
  endif()
endfunction()

rave_closure(RAVE_ROBOT_PART rave_robot)
rave_closure(RAVE_DRIVER_PART rave_sim rave_world rave_line)
rave_closure(RAVE_CONFIG_PART rave_config)
rave_closure(RAVE_RUN_PART rave_assemble)
list(REMOVE_ITEM RAVE_DRIVER_PART ${RAVE_ROBOT_PART})
list(REMOVE_ITEM RAVE_CONFIG_PART ${RAVE_ROBOT_PART} ${RAVE_DRIVER_PART})
list(REMOVE_ITEM RAVE_RUN_PART ${RAVE_ROBOT_PART} ${RAVE_DRIVER_PART} ${RAVE_CONFIG_PART})
rave_install_libraries(robot ${RAVE_ROBOT_PART})
rave_install_libraries(driver ${RAVE_DRIVER_PART})
rave_install_libraries(config ${RAVE_CONFIG_PART})
rave_install_libraries(run ${RAVE_RUN_PART})

# Which part the reader of configuration files came into decides who must find its packages.
foreach(part ROBOT DRIVER CONFIG)
  if(rave_config IN_LIST RAVE_${part}_PART)
    string(TOLOWER ${part} RAVE_YAML_PART)
  endif()
endforeach()
configure_package_config_file("${CMAKE_SOURCE_DIR}/cmake/raveConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/cmake/raveConfig.cmake" INSTALL_DESTINATION ${RAVE_PACKAGE_DIR})
write_basic_package_version_file("${CMAKE_BINARY_DIR}/cmake/raveConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/cmake/raveConfig.cmake"
    "${CMAKE_BINARY_DIR}/cmake/raveConfigVersion.cmake"
    "${CMAKE_SOURCE_DIR}/cmake/RaveAddPlugin.cmake"
  DESTINATION ${RAVE_PACKAGE_DIR} COMPONENT robot-dev)

# The running part, by the names that the targets have in the build tree.
get_property(RAVE_PLUGINS GLOBAL PROPERTY RAVE_PLUGIN_TARGETS)
if(RAVE_PLUGINS)
  install(TARGETS ${RAVE_PLUGINS} LIBRARY DESTINATION ${RAVE_PLUGIN_DIR} COMPONENT runtime)
endif()
get_property(RAVE_HOST_PLUGINS GLOBAL PROPERTY RAVE_HOST_PLUGIN_TARGETS)
if(RAVE_HOST_PLUGINS)
  install(TARGETS ${RAVE_HOST_PLUGINS} LIBRARY DESTINATION ${RAVE_PLUGIN_DIR} COMPONENT host)
endif()
set(RAVE_RUNTIME_TARGETS ${RAVE_PLUGINS})
foreach(program rave rave-keeper rave-program-runner rave-carmen-map)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION bin COMPONENT runtime)
    install(TARGETS ${program} RUNTIME DESTINATION bin COMPONENT host)
    list(APPEND RAVE_RUNTIME_TARGETS ${program})
  endif()
endforeach()
foreach(folder scenarios experiments robots worlds data schemas)
  if(EXISTS "${CMAKE_SOURCE_DIR}/${folder}")
    # scenarios/demo needs the build tree.
    install(DIRECTORY "${CMAKE_SOURCE_DIR}/${folder}" DESTINATION share/rave COMPONENT runtime
      PATTERN demo EXCLUDE)
  endif()
endforeach()
install(DIRECTORY "${CMAKE_SOURCE_DIR}/share/templates" DESTINATION share/rave COMPONENT runtime)

install(DIRECTORY "${CMAKE_SOURCE_DIR}/scenarios/remote-create"
  DESTINATION share/rave/scenarios COMPONENT host)
install(DIRECTORY "${CMAKE_SOURCE_DIR}/schemas" DESTINATION share/rave COMPONENT host)

foreach(component runtime host)
  install(DIRECTORY "${CMAKE_BINARY_DIR}/share/man" "${CMAKE_BINARY_DIR}/share/bash-completion"
    DESTINATION share COMPONENT ${component})
endforeach()

install(DIRECTORY "${CMAKE_BINARY_DIR}/share/rave/web" DESTINATION share/rave COMPONENT gui OPTIONAL)
install(DIRECTORY "${CMAKE_SOURCE_DIR}/share/foxglove" DESTINATION share/rave COMPONENT gui)
if(TARGET rave)
  install(TARGETS rave RUNTIME DESTINATION bin COMPONENT gui)
endif()

# The pages at their places in the repository, because they link to each other.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(RAVE_DOC_DIR "${CMAKE_BINARY_DIR}/share/doc/rave")
file(GLOB RAVE_PAGES CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/*.md")
file(GLOB_RECURSE RAVE_PAGES_BELOW CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/docs/*"
  "${CMAKE_SOURCE_DIR}/drivers/*.md" "${CMAKE_SOURCE_DIR}/programs/*.md"
  "${CMAKE_SOURCE_DIR}/scenarios/*.md" "${CMAKE_SOURCE_DIR}/examples/*.md")
add_custom_command(OUTPUT "${CMAKE_BINARY_DIR}/pages.stamp"
  COMMAND ${Python3_EXECUTABLE} "${CMAKE_SOURCE_DIR}/tools/docs/site.py" --pages "${RAVE_DOC_DIR}"
  COMMAND ${CMAKE_COMMAND} -E touch "${CMAKE_BINARY_DIR}/pages.stamp"
  DEPENDS "${CMAKE_SOURCE_DIR}/tools/docs/site.py" ${RAVE_PAGES} ${RAVE_PAGES_BELOW}
  COMMENT "Pages of the documentation" VERBATIM)
add_custom_target(rave_pages ALL DEPENDS "${CMAKE_BINARY_DIR}/pages.stamp")
install(DIRECTORY "${RAVE_DOC_DIR}" DESTINATION share/doc COMPONENT doc)
# Beside their pages, to be copied.
install(DIRECTORY "${CMAKE_SOURCE_DIR}/examples" DESTINATION share/doc/rave COMPONENT doc
  PATTERN "*.md" EXCLUDE)

# All that ./run needs, and nothing that only tests need.
add_custom_target(rave_runtime)
if(RAVE_RUNTIME_TARGETS)
  add_dependencies(rave_runtime ${RAVE_RUNTIME_TARGETS} rave_command_docs)
endif()

# All that `cmake --install` needs.
add_custom_target(rave_installable)
add_dependencies(rave_installable rave_runtime rave_pages ${RAVE_ROBOT_PART} ${RAVE_DRIVER_PART}
  ${RAVE_CONFIG_PART} ${RAVE_RUN_PART})
