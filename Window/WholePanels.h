// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqPVApplicationCore;

namespace cactus
{

/// Makes the dock of the properties as wide as a panel of this plugin's filters needs, so that none has to be scrolled sideways:
/// what ParaView adds after Apply to colour what is shown is wider than the dock of its window's first size. A panel is given
/// room once; whoever makes the dock narrower after that keeps it so.
class WholePanels : public QObject
{
public:
  /// Lives as long as `core`.
  explicit WholePanels(pqPVApplicationCore* core);

private:
  void giveRoom();

  int widest = 0; ///< of the panels that were given room, pixels
};

} // namespace cactus
