// SPDX-License-Identifier: BSD-3-Clause
#include "LoadWindow.h"

#include <vtkObject.h>

#include <dlfcn.h>

#include <filesystem>

namespace cactus
{

void loadWindow()
{
  // The window's program links this ParaView library; pvpython, pvbatch and pvserver never load it.
  void* windowLibrary = dlopen(CACTUS_LIBRARY_OF_WINDOWS, RTLD_LAZY | RTLD_NOLOAD);
  if (windowLibrary == nullptr)
  {
    return;
  }
  dlclose(windowLibrary);

  Dl_info plugin;
  if (dladdr(reinterpret_cast<void*>(&loadWindow), &plugin) == 0)
  {
    return;
  }
  const std::filesystem::path path = std::filesystem::path(plugin.dli_fname).replace_filename(CACTUS_WINDOW_LIBRARY);
  void* library = dlopen(path.c_str(), RTLD_NOW);
  void* start = library != nullptr ? dlsym(library, "cactusStartWindow") : nullptr;
  if (start == nullptr)
  {
    vtkGenericWarningMacro("The window's search will not find CACTUS by name: " << dlerror());
    return;
  }
  reinterpret_cast<void (*)()>(start)();
}

} // namespace cactus
