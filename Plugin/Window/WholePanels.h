// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqPVApplicationCore;

namespace cactus
{

/// Makes the dock of the properties as wide as the panels of this plugin's filters, so that none has to be scrolled sideways: the
/// colour settings that ParaView adds after Apply are wider than the dock in a window of initial size. A panel is widened once;
/// if the user makes the dock narrower afterwards, it stays so.
class WholePanels : public QObject
{
public:
  /// Lives as long as `core`.
  explicit WholePanels(pqPVApplicationCore* core);

private:
  void giveRoom();

  int widest = 0; ///< of the panels that were widened, pixels
};

} // namespace cactus
