# SPDX-License-Identifier: BSD-3-Clause
# ParaView's CMake files describe its Python modules as targets, which the plugin does not need. In Debian 13 they name files that
# do not exist (vtkCommonCore.so, where vtkCommonCore.cpython-313-x86_64-linux-gnu.so is installed), so that find_package fails.
# Such a file does nothing where all of its targets are there already: here they are made, as targets that stand for nothing.

# cactus_skip_python_targets(FILE): does so for an export file of CMake, if it names a module that is not there.
function (cactus_skip_python_targets file)
  string(REGEX REPLACE "\\.cmake$" "-*.cmake" locations "${file}")
  file(GLOB locations "${locations}")
  set(missing FALSE)
  foreach (location IN LISTS locations)
    file(STRINGS "${location}" modules REGEX "IMPORTED_LOCATION_.*_IMPORT_PREFIX}/.*\\.so\"")
    foreach (module IN LISTS modules)
      string(REGEX REPLACE ".*_IMPORT_PREFIX}(/.*)\"$" "\\1" module "${module}")
      # As CMake does, the prefix is taken from where the file is: above <prefix>/lib.
      string(REGEX REPLACE "/lib(64)?/.*$" "" prefix "${location}")
      if (NOT EXISTS "${prefix}${module}")
        set(missing TRUE)
      endif ()
    endforeach ()
  endforeach ()
  if (NOT missing)
    return ()
  endif ()
  file(STRINGS "${file}" expected REGEX "foreach *\\(_?_?cmake_expected_?[tT]arget IN ITEMS ")
  string(REGEX MATCHALL "[A-Za-z0-9_]+::[A-Za-z0-9_]+" targets "${expected}")
  foreach (target IN LISTS targets)
    add_library("${target}" INTERFACE IMPORTED)
  endforeach ()
  message(STATUS "Passed over ParaView's Python targets, whose files are not where ${file} says")
endfunction ()

# A version that no ParaView has: its files are found, and not read.
set(given_dir "${ParaView_DIR}")
find_package(ParaView 999999 QUIET CONFIG)
list(POP_FRONT ParaView_CONSIDERED_CONFIGS config)
if (given_dir)
  set(ParaView_DIR "${given_dir}" CACHE PATH "The directory containing a CMake configuration file for ParaView." FORCE)
else ()
  unset(ParaView_DIR CACHE)
endif ()
if (config)
  get_filename_component(folder "${config}" DIRECTORY)
  file(GLOB exports "${folder}/*Python*-targets.cmake" "${folder}/vtk/*Python*-targets.cmake")
  foreach (export IN LISTS exports)
    cactus_skip_python_targets("${export}")
  endforeach ()
endif ()
