# SPDX-License-Identifier: BSD-3-Clause
# cactus_vtk_module(NAME): the sources of this folder as a VTK module. Every vtk*.cxx is a class that ParaView sees; what does not
# start with vtk is shared by them.
macro (cactus_vtk_module name)
  file(GLOB class_sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/vtk*.cxx")
  set(classes)
  foreach (source IN LISTS class_sources)
    get_filename_component(class "${source}" NAME_WE)
    list(APPEND classes "${class}")
  endforeach ()
  file(GLOB shared_sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cxx")
  list(REMOVE_ITEM shared_sources ${class_sources})
  file(GLOB shared_headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.h")
  list(FILTER shared_headers EXCLUDE REGEX "/vtk[^/]*$")

  vtk_module_add_module(${name}
    CLASSES ${classes}
    SOURCES ${shared_sources}
    PRIVATE_HEADERS ${shared_headers})
  vtk_module_compile_options(${name} PRIVATE ${CACTUS_WARNINGS} ${CACTUS_COLD_OPTIONS})
  if (CACTUS_QUICK_BUILD)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif ()
endmacro ()
