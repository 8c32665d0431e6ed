// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QWidget>

class QAction;
class pqPVApplicationCore;

namespace cactus
{

/// Lets ParaView's search (Ctrl+Space), which looks at the names of filters alone, find those of this plugin by "CACTUS", too:
/// each has a second entry there, "CACTUS Bundle Initializer". An entry does what that of the menu does, and can be chosen when
/// that one can.
class QuickLaunch : public QObject
{
public:
  /// Lives as long as `core`.
  explicit QuickLaunch(pqPVApplicationCore* core);

private:
  /// Makes the entries anew out of those that the menus have now: plugins and servers change them.
  void makeEntries();
  void addEntry(QAction* menuAction);

  QWidget entries; // never shown: the search takes the actions that are its children
};

} // namespace cactus
