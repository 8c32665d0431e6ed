// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QStatusBar;
class pqProgressWidget;

namespace cactus
{

/// Returns the progress bar in the status bar of ParaView's window; null in an application without one.
pqProgressWidget* progressBar();

/// Returns the status bar that it is in; null in such an application.
QStatusBar* statusBar();

} // namespace cactus
