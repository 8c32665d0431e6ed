# SPDX-License-Identifier: BSD-3-Clause
# ParaView's modules name libraries that they themselves are linked with, and Debian's paraview-dev does not bring the development files
# of all of them. This project calls none of these libraries: where one is not found, an empty target stands for it.
foreach (target IN ITEMS GLEW::GLEW Freetype::Freetype hdf5::hdf5 hdf5::hdf5_hl NetCDF::NetCDF)
  if (NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED GLOBAL)
  endif ()
endforeach ()
