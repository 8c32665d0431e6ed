// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QWidget>

class QAction;
class pqPVApplicationCore;

namespace cactus
{

/// Lets ParaView's search (Ctrl+Space), which only reads the names of filters, also find those of this plugin by "CACTUS": each
/// has a second entry there, "CACTUS Bundle Initializer". An entry acts like that of the menu, and is enabled with it.
class QuickLaunch : public QObject
{
public:
  /// Lives as long as `core`.
  explicit QuickLaunch(pqPVApplicationCore* core);

private:
  /// Makes the entries anew from the menus' present ones: plugins and servers change them.
  void makeEntries();
  void addEntry(QAction* menuAction);

  QWidget entries; // never shown: the search takes the actions that are its children
};

} // namespace cactus
