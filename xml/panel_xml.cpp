// SPDX-License-Identifier: BSD-3-Clause
// panel_xml FOLDER FILE...: writes ParaView's XML of each FILE of xml/ into FOLDER. The build runs it. What is there already
// stays as it is, so that nothing is built again after a change that panels do not show.
#include "PanelXml.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace
{

std::string contentOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

} // namespace

int main(int count, char** arguments)
{
  const std::vector<cactus::StageDescription> stages = cactus::describeStages();
  for (int i = 2; i < count; ++i)
  {
    try
    {
      const std::filesystem::path target = std::filesystem::path(arguments[1]) / std::filesystem::path(arguments[i]).filename();
      const std::string xml = cactus::panelXml(contentOf(arguments[i]), stages);
      if (contentOf(target) != xml && !(std::ofstream(target, std::ios::binary) << xml).flush())
      {
        throw std::runtime_error("cannot write " + target.string());
      }
    }
    catch (const std::exception& error)
    {
      std::cerr << arguments[i] << ": " << error.what() << '\n';
      return 1;
    }
  }
  return 0;
}
