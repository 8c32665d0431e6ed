# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DFOLDER=... -P window_save.cmake: plays SCRIPT in the ParaView window, which has to save the substrate of
# Seed 1 in two ways, and then makes that of Seed 2, which nobody has saved.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
foreach (name IN ITEMS saved.substrate written)
  if (NOT EXISTS "${FOLDER}/${name}/manifest.json")
    message(FATAL_ERROR "${name} was not saved:\n${output}")
  endif ()
  file(GLOB inner "${FOLDER}/${name}/inner/*.ply")
  file(READ "${FOLDER}/${name}/manifest.json" manifest)
  if (NOT inner OR manifest MATCHES "\"Seed\": *2")
    message(FATAL_ERROR "${name} is not as it was saved, with axons:\n${output}")
  endif ()
endforeach ()
if (NOT output MATCHES "has changed since .*written was written")
  message(FATAL_ERROR "nothing said that the folder is older than the surfaces:\n${output}")
endif ()
