// SPDX-License-Identifier: BSD-3-Clause
#include "BarUnits.h"
#include "ChainButton.h"
#include "ChartButton.h"
#include "CodeChoices.h"
#include "ErrorColours.h"
#include "FirstLook.h"
#include "HelpMenu.h"
#include "IdleGrowth.h"
#include "ImageLook.h"
#include "InheritedLook.h"
#include "NarrowChoices.h"
#include "QuickLaunch.h"
#include "ReachedLine.h"
#include "ReplaceNotice.h"
#include "StopButton.h"
#include "ViewCentreButton.h"
#include "WholePanels.h"
#include "WriteButtons.h"

#include <pqInterfaceTracker.h>
#include <pqPVApplicationCore.h>

#include <QCoreApplication>
#include <QTimer>

/// Called by the plugin (Plugin/LoadWindow.cxx). ParaView may still be starting then, so the rest waits until it runs.
extern "C" Q_DECL_EXPORT void cactusStartWindow()
{
  QTimer::singleShot(0, QCoreApplication::instance(),
    []
    {
      if (pqPVApplicationCore* core = pqPVApplicationCore::instance())
      {
        new cactus::QuickLaunch(core);
        new cactus::FirstLook(core);
        new cactus::InheritedLook(core);
        new cactus::ErrorColours(core);
        new cactus::ImageLook(core); // once those are mended
        new cactus::WholePanels(core);
        new cactus::BarUnits(core);
        new cactus::StopButton(core);
        new cactus::ReachedLine(core);
        new cactus::ChartButton(core);
        new cactus::ChainButton(core);
        new cactus::HelpMenu(core);
        core->interfaceTracker()->addInterface(new cactus::CodeChoices(core));
        core->interfaceTracker()->addInterface(new cactus::NarrowChoices(core));
        core->interfaceTracker()->addInterface(new cactus::WriteButtons(core));
        core->interfaceTracker()->addInterface(new cactus::ReplaceNotice(core));
        core->interfaceTracker()->addInterface(new cactus::IdleGrowth(core));
        core->interfaceTracker()->addInterface(new cactus::ViewCentreButton(core));
      }
    });
}
