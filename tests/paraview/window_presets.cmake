# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_presets.cmake: plays SCRIPT, which chooses presets, in the ParaView
# window. The filters have to take that of the bundle, and one whose values are changed by hand is no preset.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
if (output MATCHES "error:")
  message(FATAL_ERROR "the window reported an error:\n${output}\n${notes}")
endif ()
foreach (wanted IN ITEMS
    "BundleInitializer [1-9][0-9]*\nBundleInitializer has Corpus callosum, in-vivo-like\n"
    "FibreRadialGrowth [1-9][0-9]*\nFibreRadialGrowth has Corpus callosum, in-vivo-like\n"
    "BundleInitializer [1-9][0-9]*\nBundleInitializer has None\n$")
  if (NOT notes MATCHES "${wanted}")
    message(FATAL_ERROR "this is missing: ${wanted}in\n${notes}\n${output}")
  endif ()
endforeach ()
