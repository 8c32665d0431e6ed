// SPDX-License-Identifier: BSD-3-Clause
#include "program/CommandLine.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/WholeNumber.h"

#include <vector>

const char* const commandHelp =
  R"(Usage: cactus-grow RECIPE [--output FOLDER] [--threads N] [--progress SECONDS]

Grows a white-matter substrate and writes it as a folder of closed surfaces with a certificate, as the filters of
CACTUS for ParaView do, with the same bits, and without ParaView.

  RECIPE              the stages and their properties as JSON, e.g. {"BundleInitializer": {"Side": 20}}; what is left
                      out has its default. Or the manifest.json of a substrate, or its folder, to make it again
  -o, --output FOLDER the folder to write. Without it FolderName in the recipe or, where that is not given, the
                      recipe's name without .json; for a manifest its folder's name with -rerun
  -t, --threads N     on which no result depends; 0, the default: what the recipe says, else all
  -p, --progress SECONDS between lines of progress where standard error is no terminal, as in a job: 60; 0: none
  -h, --help          this
  -V, --version       the version

A substrate folder that is there already is replaced if nothing in it was changed. Ctrl-C leaves it as it was.
Ends with 0 for a certified substrate, 1 where the run failed, 2 where the command or the recipe is wrong (nothing has
run then), 3 where the folder is written and its certificate names faults, 128 and the signal's number where stopped.
)";

namespace
{

const std::string advice = ": cactus-grow --help tells more";

/// Reads the arguments one after the other.
class Reader
{
public:
  Reader(int count, char** arguments)
    : Arguments(arguments + 1, arguments + count)
  {
  }

  CommandLine read()
  {
    while (this->Next < this->Arguments.size())
    {
      this->take(this->Arguments[this->Next++]);
    }
    if (this->Found.recipe.empty() && !this->Found.wantsHelp && !this->Found.wantsVersion)
    {
      throw cactus::InvalidInput("no recipe is named" + advice);
    }
    return this->Found;
  }

private:
  void take(const std::string& argument)
  {
    const bool isOption = !this->IsPastOptions && argument.size() > 1 && argument[0] == '-';
    if (!isOption)
    {
      if (!this->Found.recipe.empty() || argument.empty())
      {
        throw cactus::InvalidInput("one recipe is wanted, and " + cactus::excerpt('"' + argument + '"') + " is another" + advice);
      }
      this->Found.recipe = argument;
      return;
    }
    if (argument == "--")
    {
      this->IsPastOptions = true;
      return;
    }
    const std::size_t sign = argument.compare(0, 2, "--") == 0 ? argument.find('=') : std::string::npos;
    this->takeOption(argument.substr(0, sign), sign);
  }

  void takeOption(const std::string& name, std::size_t sign)
  {
    if (name == "-o" || name == "--output")
    {
      this->Found.output = this->value(name, sign);
    }
    else if (name == "-t" || name == "--threads")
    {
      this->Found.threads = cactus::wholeNumber("--threads", this->value(name, sign), cactus::limits::threads);
    }
    else if (name == "-p" || name == "--progress")
    {
      this->Found.progress = cactus::wholeNumber("--progress", this->value(name, sign), cactus::progressPauses);
    }
    else if ((name == "-h" || name == "--help") && sign == std::string::npos)
    {
      this->Found.wantsHelp = true;
    }
    else if ((name == "-V" || name == "--version") && sign == std::string::npos)
    {
      this->Found.wantsVersion = true;
    }
    else
    {
      throw cactus::InvalidInput("there is no option " + cactus::excerpt(name) + advice);
    }
  }

  /// Returns the text behind the `=` at `sign`, or the next argument.
  std::string value(const std::string& name, std::size_t sign)
  {
    const bool isNext = sign == std::string::npos;
    if (isNext && this->Next == this->Arguments.size())
    {
      throw cactus::InvalidInput(name + " wants a value");
    }
    const std::string value = isNext ? this->Arguments[this->Next++] : this->Arguments[this->Next - 1].substr(sign + 1);
    if (value.empty())
    {
      throw cactus::InvalidInput(name + " is empty");
    }
    return value;
  }

  std::vector<std::string> Arguments;
  std::size_t Next = 0;
  bool IsPastOptions = false;
  CommandLine Found;
};

} // namespace

CommandLine parseCommandLine(int count, char** arguments)
{
  return Reader(count, arguments).read();
}
