// SPDX-License-Identifier: BSD-3-Clause
#include "program/Terminal.h"

#include "base/Numbers.h"
#include "base/Pace.h"

#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

namespace
{

/// Columns of the terminal.
std::size_t width()
{
  winsize size{};
  constexpr std::size_t usual = 80;
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

/// Returns the beginning of a text in UTF-8 with at most `most` characters.
std::string shortened(const std::string& text, std::size_t most)
{
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool isFirst = (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
    if (isFirst && characters++ == most)
    {
      return text.substr(0, i);
    }
  }
  return text;
}

} // namespace

Terminal::Terminal()
  : IsTerminal(::isatty(STDERR_FILENO) != 0)
  , Pause(std::chrono::milliseconds(this->IsTerminal ? 100 : 0))
  , LastTime(std::chrono::steady_clock::now())
{
}

Terminal::~Terminal()
{
  this->clear();
}

void Terminal::setPause(std::chrono::seconds pause)
{
  if (!this->IsTerminal)
  {
    this->Pause = pause;
  }
}

void Terminal::progress(double fraction, const std::string& message)
{
  const auto now = std::chrono::steady_clock::now();
  const bool isFirst = this->IsTerminal && !this->IsShown;
  if (this->Pause == this->Pause.zero() || (!isFirst && now - this->LastTime < this->Pause))
  {
    return;
  }
  this->LastTime = now;
  const std::string line = cactus::progressLine(fraction, message);
  if (!this->IsTerminal)
  {
    this->say(line);
    return;
  }
  this->IsShown = true;
  std::fprintf(stderr, "\r%s\033[K", shortened(line, width() - 1).c_str());
  std::fflush(stderr);
}

void Terminal::say(const std::string& message)
{
  this->clear();
  std::fprintf(stderr, "cactus-grow: %s\n", cactus::onOneLine(message).c_str());
}

void Terminal::clear()
{
  if (this->IsShown)
  {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    this->IsShown = false;
  }
}
