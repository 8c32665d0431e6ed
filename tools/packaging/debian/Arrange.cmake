# SPDX-License-Identifier: BSD-3-Clause
# Run by CPack on what it has installed for the package: puts things where Debian has them. ParaView itself looks for plugins in two
# ways only: by variables of the environment, and by a list of configuration files, paraview.conf, beside its libraries or its
# programs (vtkPVPluginTracker::LoadPluginConfigurationXMLs). Debian 12's ParaView has no such list, so the package brings it; the
# list of Debian 13's names a file outside its folders, share/paraview/plugins, which is not there until a package brings it.
set(root "${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}")
set(doc "${root}/share/doc/${CPACK_PACKAGE_NAME}")

# The plugin, beside ParaView's own.
set(plugins "lib/${CPACK_CACTUS_TRIPLET}/${CPACK_CACTUS_PARAVIEW}/plugins")
if (NOT CPACK_CACTUS_LIBDIR STREQUAL "lib/${CPACK_CACTUS_TRIPLET}")
  file(MAKE_DIRECTORY "${root}/lib/${CPACK_CACTUS_TRIPLET}")
  file(RENAME "${root}/${CPACK_CACTUS_LIBDIR}/${CPACK_CACTUS_PARAVIEW}" "${root}/lib/${CPACK_CACTUS_TRIPLET}/${CPACK_CACTUS_PARAVIEW}")
endif ()
if (NOT EXISTS "${root}/${plugins}/cactus.plugins.xml")
  message(FATAL_ERROR "The plugin is not in ${root}/${plugins}")
endif ()
# What other builds would need of it, and nobody else.
file(GLOB archives "${root}/${CPACK_CACTUS_LIBDIR}/*.a")
file(REMOVE_RECURSE "${root}/${plugins}/CACTUS/vtk" ${archives})
set(prefix "${CPACK_PACKAGING_INSTALL_PREFIX}")
set(list "${prefix}/lib/${CPACK_CACTUS_TRIPLET}/${CPACK_CACTUS_PARAVIEW}/paraview.conf")
set(listed)
if (EXISTS "${list}")
  file(STRINGS "${list}" listed REGEX "^${prefix}/share/paraview/plugins$")
endif ()
if (listed)
  set(configuration "${root}/share/paraview/plugins")
  file(MAKE_DIRECTORY "${root}/share/paraview")
  configure_file("${root}/${plugins}/cactus.plugins.xml" "${configuration}" COPYONLY)
else ()
  set(configuration "${root}/bin/paraview.conf")
  file(WRITE "${configuration}" "${prefix}/${plugins}/cactus.plugins.xml\n")
endif ()

# Documents.
if (NOT "${root}/${CPACK_CACTUS_DOCDIR}" STREQUAL "${doc}")
  file(RENAME "${root}/${CPACK_CACTUS_DOCDIR}" "${doc}")
endif ()
file(REMOVE "${doc}/LICENSE") # it is in copyright
file(READ "${CPACK_CACTUS_SOURCE}/tools/packaging/debian/copyright" copyright)
file(WRITE "${doc}/copyright" "${copyright}")

# Debian's changelog has the date of the release, so that the same sources make the same package.
file(STRINGS "${CPACK_CACTUS_SOURCE}/CHANGELOG.md" release REGEX "^## \\[${CPACK_PACKAGE_VERSION}\\]")
string(REGEX REPLACE ".* - " "" date "${release}")
execute_process(COMMAND date --utc --rfc-email "--date=${date}" OUTPUT_VARIABLE day OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(WRITE "${doc}/changelog"
  "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * See CHANGELOG.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${day}
")
foreach (file IN ITEMS "${doc}/changelog" "${root}/${CPACK_CACTUS_MANDIR}/man1/cactus-grow.1")
  execute_process(COMMAND gzip -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
endforeach ()

# Lintian is told why that list is beside programs.
set(plain "${doc}/copyright" "${configuration}")
if (NOT listed)
  file(READ "${CPACK_CACTUS_SOURCE}/tools/packaging/debian/lintian-overrides" overrides)
  file(WRITE "${root}/share/lintian/overrides/${CPACK_PACKAGE_NAME}" "${overrides}")
  list(APPEND plain "${root}/share/lintian/overrides/${CPACK_PACKAGE_NAME}")
endif ()

# Whatever the umask is.
file(GLOB_RECURSE folders LIST_DIRECTORIES ON "${root}/*")
list(APPEND folders "${root}")
foreach (folder IN LISTS folders)
  if (IS_DIRECTORY "${folder}")
    file(CHMOD "${folder}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  endif ()
endforeach ()
foreach (file IN LISTS plain)
  file(CHMOD "${file}" PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endforeach ()
